#include "clearway/report/top_view.h"

#include <algorithm>
#include <array>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "clearway/scene/occupancy.h"
#include "report/legend.h"
#include "report/map_view.h"
#include "report/name_painter.h"
#include "report/path_painter.h"

namespace clearway {
namespace {

using report::Canvas;
using report::Color;
using report::MapView;
namespace palette = report::palette;

constexpr double kMarginPx = 32;
constexpr double kHeaderPx = 92;
constexpr double kLegendPx = 300;
constexpr double kMovingMps = 0.5;  // slower objects are drawn as resting

// The part of the scene that nobody asked for in particular: what the paths need, else the objects.
Aabb DefaultArea(const SceneSnapshot& scene, const TopViewOptions& options) {
  constexpr double kPathMarginM = 9, kObjectMarginM = 6;
  Aabb area_W;
  for (const TopViewPath& path : options.paths) {
    for (const TimedPose& pose : path.poses) area_W.Extend(pose.T_W_L.translation);
  }
  if (!area_W.Empty()) return area_W.Padded(kPathMarginM);
  const SceneAtTime now(scene, scene.stamp);
  for (const SceneAtTime::Placed& placed : now.objects()) {
    area_W.Extend(placed.box_W);
  }
  if (!area_W.Empty()) return area_W.Padded(kObjectMarginM);
  area_W = scene.static_map_W.ObservedBox();
  return area_W.Empty() ? Aabb{{-5, -5, 0}, {5, 5, 0}} : area_W;
}

// The area grown until it is neither flatter nor taller than a picture should be.
Aabb WithinAspect(Aabb area_W) {
  constexpr double kFlattest = 0.6, kTallest = 1.0;
  const Eigen::Vector3d size = area_W.Size();
  const auto grow = [&area_W](int axis, double missing) {
    if (missing <= 0) return;
    area_W.min[axis] -= missing / 2;
    area_W.max[axis] += missing / 2;
  };
  grow(1, kFlattest * size.x() - size.y());
  grow(0, size.y() / kTallest - size.x());
  return area_W;
}

// One picture in the making.
class TopViewPainter {
 public:
  TopViewPainter(const SceneSnapshot& scene, const TopViewOptions& options)
      : scene_(scene),
        options_(options),
        now_(scene, scene.stamp),
        view_(WithinAspect(options.area_W.value_or(DefaultArea(scene, options))),
              {kMarginPx, kHeaderPx}, options.width_px - 3 * kMarginPx - kLegendPx),
        canvas_(options.width_px,
                static_cast<int>(kHeaderPx + std::max(view_.size_px().y(), 640.0) + kMarginPx)),
        times_{scene.stamp, LastSecond()} {}

  Canvas& Paint() {
    PaintHeader();
    const Eigen::Vector2d corner = view_.top_left(), size = view_.size_px();
    canvas_.Clip(corner.x(), corner.y(), size.x(), size.y());
    report::DrawColumns(
        canvas_, view_,
        report::ColumnsOf(scene_.static_map_W, view_.area_W(), options_.max_height_m),
        options_.max_height_m);
    report::DrawDynamic(canvas_, view_, scene_);
    PaintObjects();
    PaintPredictions();
    PaintRecorded();
    for (const TopViewPath& path : options_.paths) {
      report::DrawPath(canvas_, view_, times_, options_, path);
    }
    PaintNames();
    report::DrawScale(canvas_, view_);
    canvas_.ResetClip();
    canvas_.Outline(
        std::array<Eigen::Vector2d, 4>{{corner, corner + Eigen::Vector2d(size.x(), 0),
                                        corner + size, corner + Eigen::Vector2d(0, size.y())}},
        {palette::kRule, 1.5});
    PaintLegend();
    return canvas_;
  }

 private:
  // From the scene's stamp to the last time shown, in seconds.
  double LastSecond() const {
    Duration last = FromSeconds(1);
    for (const Duration after : options_.predicted_after) last = std::max(last, after);
    for (const TopViewPath& path : options_.paths) {
      if (!path.poses.empty()) last = std::max(last, path.poses.back().time - scene_.stamp);
    }
    for (const TopViewOutline& outline : options_.recorded) {
      last = std::max(last, outline.time - scene_.stamp);
    }
    return ToSeconds(last);
  }

  bool ShowsTimes() const {
    return !(options_.predicted_after.empty() && options_.paths.empty() &&
             options_.recorded.empty());
  }

  void PaintHeader() {
    canvas_.Text({kMarginPx, 46}, options_.title, {.size_px = 27, .bold = true});
    canvas_.Text({kMarginPx, 75}, options_.subtitle, {.size_px = 17, .color = palette::kMuted});
  }

  // In pixels, without the room of its bound.
  Polygon OutlineOf(const SceneAtTime::Placed& placed) const {
    return view_.ToPixels(report::OutlineOf(*placed.object->solid, placed.T_W_O));
  }

  static bool IsMoving(const SceneAtTime::Placed& placed) {
    return placed.object->SpeedMps() >= kMovingMps;
  }

  void PaintObjects() {
    for (const SceneAtTime::Placed& placed : now_.objects()) {
      const Polygon outline = OutlineOf(placed);
      const Color color = IsMoving(placed) ? palette::kMoving : palette::kResting;
      canvas_.Fill(outline, color.WithAlpha(0.9));
      canvas_.Outline(outline, {palette::kInk, 1.2});
    }
  }

  void PaintPredictions() {
    for (const Duration after : options_.predicted_after) {
      const Time time = scene_.stamp + after;
      const double fraction = ToSeconds(after) / times_.last_s;
      const Color color = times_.At(time).WithAlpha(0.95 - 0.35 * fraction);
      const SceneAtTime then(scene_, time);
      for (const SceneAtTime::Placed& placed : then.objects()) {
        if (!IsMoving(placed)) continue;
        const Polygon outline = OutlineOf(placed);
        canvas_.Fill(outline, color.WithAlpha(0.08));
        canvas_.Outline(outline, {color, 2.2});
        if (placed.beyond_horizon_radius_m) {
          canvas_.Circle(view_.ToPixels(Eigen::Vector2d(placed.T_W_O.translation.head<2>())),
                         *placed.beyond_horizon_radius_m * view_.px_per_m(), color.WithAlpha(0.03),
                         {color, 1.5, 6});
        }
      }
    }
  }

  void PaintRecorded() {
    for (const TopViewOutline& outline : options_.recorded) {
      canvas_.Outline(view_.ToPixels(outline.polygon_W), {times_.At(outline.time), 2, 4});
    }
  }

  std::string LabelOf(const MovingObject& object) const {
    const auto name = options_.names.find(object.id);
    std::string text = name != options_.names.end() ? name->second : absl::StrCat(object.id);
    if (object.SpeedMps() >= kMovingMps) {
      absl::StrAppendFormat(&text, ", %.1f m/s", object.SpeedMps());
    }
    return text;
  }

  void PaintNames() {
    std::vector<report::NamedOutline> outlines;
    for (const SceneAtTime::Placed& placed : now_.objects()) {
      outlines.push_back({OutlineOf(placed), LabelOf(*placed.object)});
    }
    report::DrawNames(canvas_, view_, outlines);
  }

  void PaintLegend() {
    report::Legend legend(canvas_, {options_.width_px - kMarginPx - kLegendPx, kHeaderPx},
                          kLegendPx);
    if (ShowsTimes()) {
      legend.Heading("Time after now");
      legend.TimeBar(times_.last_s);
    }
    legend.Heading("Moving objects");
    legend.Swatch(palette::kMoving, {palette::kInk, 1.2}, "now");
    if (!std::ranges::all_of(now_.objects(), IsMoving)) {
      legend.Swatch(palette::kResting, {palette::kInk, 1.2}, "labelled, at rest");
    }
    const Color later = report::TimeColor(0.6);
    if (!options_.predicted_after.empty()) {
      legend.Swatch(later.WithAlpha(0.08), {later, 2.2}, "predicted, at its time");
    }
    if (!options_.recorded.empty()) {
      legend.Swatch(palette::kPaper, {later, 2, 4}, "recorded afterwards");
    }
    if (!options_.paths.empty()) PaintPathLegend(legend);
    legend.Heading("Static map");
    legend.Swatch(palette::kFree, {palette::kRule, 1.2}, "free");
    legend.Swatch(palette::kUnknown, {palette::kRule, 1.2}, "unknown");
    if (!scene_.dynamic_W.voxels().empty()) {
      legend.Swatch(palette::kDynamic, {palette::kInk, 1.2}, "dynamic space");
    }
    legend.Heading("Occupied, over ground");
    legend.HeightBar(options_.max_height_m);
  }

  void PaintPathLegend(report::Legend& legend) {
    legend.Heading("Robot");
    for (const TopViewPath& path : options_.paths) {
      const report::Stroke dashed{palette::kInk, 2, 8}, solid{report::TimeColor(0.4), 5};
      legend.LineSample(path.reference ? dashed : solid, path.name);
    }
    if (options_.footprint_L.empty()) return;
    const Color color = report::TimeColor(0.4);
    legend.Swatch(color.WithAlpha(0.13), {color, 2},
                  absl::StrFormat("footprint every %g s", ToSeconds(options_.footprint_every)));
  }

  const SceneSnapshot& scene_;
  const TopViewOptions& options_;
  SceneAtTime now_;
  MapView view_;
  Canvas canvas_;
  report::TimeScale times_;
};

}  // namespace

absl::Status WriteTopView(const SceneSnapshot& scene, const TopViewOptions& options,
                          const std::string& png_file) {
  return TopViewPainter(scene, options).Paint().WritePng(png_file);
}

}  // namespace clearway
