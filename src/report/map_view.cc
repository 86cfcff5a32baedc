#include "report/map_view.h"

#include <array>
#include <cmath>

#include "absl/strings/str_cat.h"

namespace clearway::report {
namespace {

// The largest of 1, 2 or 5 times a power of ten that is at most `length`.
double RoundLength(double length) {
  const double power = std::pow(10, std::floor(std::log10(length)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * power <= length) return factor * power;
  }
  return power;
}

double ScaleLength_m(const MapView& view) { return RoundLength(view.area_W().Size().x() / 5); }

void DrawArrow(Canvas& canvas, const Eigen::Vector2d& from, const Eigen::Vector2d& direction,
               const std::string& name) {
  constexpr double kLengthPx = 34, kHeadPx = 8;
  const Eigen::Vector2d to = from + kLengthPx * direction;
  const Eigen::Vector2d back = to - kHeadPx * direction;
  const Eigen::Vector2d side(-0.45 * kHeadPx * direction.y(), 0.45 * kHeadPx * direction.x());
  canvas.Line(std::array{from, back}, {palette::kInk, 2});
  canvas.Fill(std::array<Eigen::Vector2d, 3>{to, back + side, back - side}, palette::kInk);
  canvas.Text(to + 12 * direction + Eigen::Vector2d(0, 5), name,
              {.size_px = 15, .align = Align::kCenter, .halo_px = 3});
}

}  // namespace

Polygon MapView::ToPixels(const Polygon& polygon_W) const {
  Polygon result;
  result.reserve(polygon_W.size());
  for (const Eigen::Vector2d& p_W : polygon_W) result.push_back(ToPixels(p_W));
  return result;
}

void DrawColumns(Canvas& canvas, const MapView& view, const ColumnMap& columns,
                 double max_height_m) {
  std::vector<std::uint32_t> pixels;
  pixels.reserve(columns.columns.size());
  for (int y = columns.height - 1; y >= 0; --y) {  // the image's rows run against W's y
    for (int x = 0; x < columns.width; ++x) {
      const Column& column = columns.At(x, y);
      const Color color = column.state == VoxelState::kUnknown ? palette::kUnknown
                          : column.state == VoxelState::kFree
                              ? palette::kFree
                              : HeightColor(column.height_m, max_height_m);
      pixels.push_back(color.Rgb24());
    }
  }
  const Eigen::Vector2d top_left_W(columns.x0 * columns.resolution_m,
                                   (columns.y0 + columns.height) * columns.resolution_m);
  canvas.Image(view.ToPixels(top_left_W), columns.resolution_m * view.px_per_m(), columns.width,
               columns.height, pixels);
}

void DrawDynamic(Canvas& canvas, const MapView& view, const SceneSnapshot& scene) {
  const VoxelGrid& grid = scene.static_map_W.grid();
  const double size_px = grid.resolution_m() * view.px_per_m();
  for (const DynamicVoxel& voxel : scene.dynamic_W.voxels()) {
    const Aabb box_W = grid.BoxOf(voxel.key);
    const Eigen::Vector2d corner = view.ToPixels(Eigen::Vector2d(box_W.min.x(), box_W.max.y()));
    canvas.FillRect(corner.x(), corner.y(), size_px, size_px, palette::kDynamic);
  }
}

Eigen::AlignedBox2d ScaleArea(const MapView& view) {
  const Eigen::Vector2d corner = view.top_left() + Eigen::Vector2d(14, view.size_px().y() - 88);
  return {corner, corner + Eigen::Vector2d(ScaleLength_m(view) * view.px_per_m() + 120, 74)};
}

void DrawScale(Canvas& canvas, const MapView& view) {
  const double length_m = ScaleLength_m(view);
  const double length_px = length_m * view.px_per_m();
  const Eigen::AlignedBox2d area = ScaleArea(view);
  canvas.FillRect(area.min().x(), area.min().y(), area.sizes().x(), area.sizes().y(),
                  palette::kPaper.WithAlpha(0.85));

  const Eigen::Vector2d origin(area.min().x() + 16, area.max().y() - 16);
  DrawArrow(canvas, origin, {1, 0}, "x");
  DrawArrow(canvas, origin, {0, -1}, "y");

  const Eigen::Vector2d left = origin + Eigen::Vector2d(76, -2);
  const Eigen::Vector2d right = left + Eigen::Vector2d(length_px, 0);
  const Eigen::Vector2d tick(0, 6);
  canvas.Line(std::array{left, right}, {palette::kInk, 3});
  canvas.Line(std::array<Eigen::Vector2d, 2>{left - tick, left + tick}, {palette::kInk, 3});
  canvas.Line(std::array<Eigen::Vector2d, 2>{right - tick, right + tick}, {palette::kInk, 3});
  canvas.Text(0.5 * (left + right) - Eigen::Vector2d(0, 14), absl::StrCat(length_m, " m"),
              {.size_px = 17, .align = Align::kCenter});
}

}  // namespace clearway::report
