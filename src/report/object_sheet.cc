#include "clearway/report/object_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "absl/status/statusor.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "report/voxel_views.h"

namespace clearway {
namespace {

using report::Align;
using report::Canvas;
using report::ViewKind;
using report::VoxelViews;
namespace palette = report::palette;

constexpr std::array kKinds{ViewKind::kOblique, ViewKind::kTop, ViewKind::kSide, ViewKind::kFront};
constexpr double kMarginPx = 32;
constexpr double kHeaderPx = 72;
constexpr double kMorePx = 48;         // a line below all rows
constexpr double kMostHeightPx = 3e4;  // Cairo's pictures reach to 32,767
constexpr double kGapPx = 48;          // between the views of a row, at least
constexpr double kWidestGapPx = 140;
constexpr double kCaptionPx = 56;  // above the views of a row
constexpr double kFooterPx = 56;   // below them
constexpr double kTallestRowPx = 320;
constexpr double kFinestPxPerM = 170;  // of small objects

// One object's place on the sheet.
struct Row {
  const MovingObject* object;
  std::unique_ptr<VoxelViews> views;
  double px_per_m = 1;
  double view_height_px = 0;
  double gap_px = kGapPx;
  double height_px() const { return kCaptionPx + view_height_px + kFooterPx; }
};

Row RowOf(const MovingObject& object, double width_px) {
  Row row{&object, std::make_unique<VoxelViews>(object)};
  double width_m = 0, height_m = 0;
  for (const ViewKind kind : kKinds) {
    const Eigen::Vector2d size_m = row.views->SizeOf(kind);
    width_m += size_m.x();
    height_m = std::max(height_m, size_m.y());
  }
  if (row.views->Empty()) return row;
  row.px_per_m = std::min({(width_px - (kKinds.size() - 1) * kGapPx) / width_m,
                           kTallestRowPx / height_m, kFinestPxPerM});
  row.view_height_px = row.px_per_m * height_m;
  row.gap_px = std::min((width_px - row.px_per_m * width_m) / (kKinds.size() - 1), kWidestGapPx);
  return row;
}

// 12345 -> "12,345".
std::string Grouped(std::size_t number) {
  if (number < 1000) return absl::StrCat(number);
  return absl::StrCat(Grouped(number / 1000), ",", absl::Dec(number % 1000, absl::kZeroPad3));
}

std::string CaptionOf(const Row& row) {
  const Eigen::Vector3d size = row.views->extent().size_m;
  if (row.object->given()) {
    return absl::StrFormat("%.1f x %.1f x %.1f m   \u00b7   given, not seen   \u00b7   %.1f m/s",
                           size.x(), size.y(), size.z(), row.object->SpeedMps());
  }
  return absl::StrFormat(
      "%.1f x %.1f x %.1f m   \u00b7   %s voxels of %g m   \u00b7   seen in %d frames   \u00b7   "
      "%.1f m/s",
      size.x(), size.y(), size.z(), Grouped(row.views->voxel_count()),
      row.object->map_O.grid().resolution_m(), row.object->frames_seen, row.object->SpeedMps());
}

void DrawScale(Canvas& canvas, const Eigen::Vector2d& right, double px_per_m) {
  const Eigen::Vector2d left = right - Eigen::Vector2d(px_per_m, 0), tick(0, 5);
  canvas.Line(std::array{left, right}, {palette::kInk, 2.5});
  canvas.Line(std::array<Eigen::Vector2d, 2>{left - tick, left + tick}, {palette::kInk, 2.5});
  canvas.Line(std::array<Eigen::Vector2d, 2>{right - tick, right + tick}, {palette::kInk, 2.5});
  canvas.Text(0.5 * (left + right) - Eigen::Vector2d(0, 10), "1 m",
              {.size_px = 15, .align = Align::kCenter});
}

void DrawRow(Canvas& canvas, const Row& row, const std::string& name, double y, double width_px) {
  const double right = kMarginPx + width_px;
  canvas.Line(std::array<Eigen::Vector2d, 2>{{{kMarginPx, y}, {right, y}}}, {palette::kRule, 1});
  const report::TextStyle bold{.size_px = 20, .bold = true};
  canvas.Text({kMarginPx, y + 34}, name, bold);
  canvas.Text({kMarginPx + canvas.TextWidth(name, bold) + 24, y + 34}, CaptionOf(row),
              {.size_px = 17, .color = palette::kMuted});
  if (row.views->Empty()) return;

  double x = kMarginPx;
  const double bottom = y + kCaptionPx + row.view_height_px;
  for (const ViewKind kind : kKinds) {
    const Eigen::Vector2d size_px = row.px_per_m * row.views->SizeOf(kind);
    row.views->Draw(canvas, kind, {x, bottom - (row.view_height_px - size_px.y()) / 2},
                    row.px_per_m);
    canvas.Text({x + size_px.x() / 2, bottom + 32}, report::NameOf(kind),
                {.size_px = 15, .color = palette::kMuted, .align = Align::kCenter});
    x += size_px.x() + row.gap_px;
  }
  DrawScale(canvas, {right, y + 34}, row.px_per_m);
}

absl::StatusOr<std::vector<const MovingObject*>> ObjectsOf(const SceneSnapshot& scene,
                                                           const std::vector<ObjectId>& ids) {
  std::vector<const MovingObject*> objects;
  for (const ObjectId id : ids) {
    objects.push_back(scene.FindObject(id));
    if (objects.back() == nullptr) {
      return absl::NotFoundError(absl::StrCat("objects: the scene has no object ", id));
    }
  }
  if (ids.empty()) {
    for (const auto& object : scene.objects) objects.push_back(object.get());
  }
  return objects;
}

}  // namespace

absl::Status WriteObjectSheet(const SceneSnapshot& scene, const ObjectSheetOptions& options,
                              const std::string& png_file) {
  const auto objects = ObjectsOf(scene, options.objects);
  if (!objects.ok()) return objects.status();
  const double width_px = options.width_px - 2 * kMarginPx;
  std::vector<Row> rows;
  double height_px = kHeaderPx;
  for (const MovingObject* object : *objects) {
    Row row = RowOf(*object, width_px);
    if (height_px + row.height_px() + kMorePx > kMostHeightPx) break;
    height_px += row.height_px();
    rows.push_back(std::move(row));
  }
  const std::size_t more = objects->size() - rows.size();
  if (more > 0) height_px += kMorePx;
  Canvas canvas(options.width_px, static_cast<int>(std::ceil(height_px)));
  canvas.Text({kMarginPx, 46}, options.title, {.size_px = 27, .bold = true});
  if (std::ranges::any_of(rows, [](const Row& row) { return row.views->HasPale(); })) {
    canvas.Text({kMarginPx + width_px, 46}, "pale, and not in the oblique view: hit by few scans",
                {.size_px = 15, .color = palette::kMuted, .align = Align::kRight});
  }
  double y = kHeaderPx;
  for (const Row& row : rows) {
    const auto name = options.names.find(row.object->id);
    DrawRow(canvas, row,
            name != options.names.end() ? name->second : absl::StrCat("object ", row.object->id), y,
            width_px);
    y += row.height_px();
  }
  if (more > 0) {
    canvas.Text({kMarginPx, y + 30}, absl::StrCat("and ", more, " more"), {.size_px = 20});
  }
  return canvas.WritePng(png_file);
}

}  // namespace clearway
