#include "report/path_painter.h"

#include <algorithm>
#include <array>

#include "absl/strings/str_format.h"

namespace clearway::report {
namespace {

TimedPose Between(const TimedPose& from, const TimedPose& to, double fraction) {
  return {from.time + FromSeconds(ToSeconds(to.time - from.time) * fraction),
          Interpolate(from.T_W_L, to.T_W_L, fraction)};
}

// The path's poses every `step`, and its last one.
std::vector<TimedPose> AtSteps(const std::vector<TimedPose>& poses, Duration step) {
  std::vector<TimedPose> steps;
  Time next = poses.front().time;
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
    const Duration span = poses[i + 1].time - poses[i].time;
    for (; next < poses[i + 1].time; next += step) {
      steps.push_back(
          Between(poses[i], poses[i + 1], ToSeconds(next - poses[i].time) / ToSeconds(span)));
    }
  }
  steps.push_back(poses.back());
  return steps;
}

class PathPainter {
 public:
  PathPainter(Canvas& canvas, const MapView& view, const TimeScale& times)
      : canvas_(canvas), view_(view), times_(times) {}

  void Reference(const TopViewPath& path) {
    Line(path, {palette::kPaper.WithAlpha(0.7), 5});
    Line(path, {palette::kInk, 2, 8});
  }

  void Footprints(const TopViewPath& path, const Polygon& footprint_L, Duration step) {
    for (const TimedPose& pose : AtSteps(path.poses, step)) {
      const Polygon outline = view_.ToPixels(Moved(footprint_L, pose.T_W_L));
      canvas_.Fill(outline, times_.At(pose.time).WithAlpha(0.13));
      canvas_.Outline(outline, {times_.At(pose.time), 2});
    }
  }

  void Way(const TopViewPath& path) {
    Line(path, {palette::kPaper, 9});
    for (std::size_t i = 0; i + 1 < path.poses.size(); ++i) {
      Segment(path.poses[i], path.poses[i + 1]);
    }
    End(path.poses.front(), "start");
    End(path.poses.back(), "goal");
  }

 private:
  void Line(const TopViewPath& path, const Stroke& stroke) {
    Polygon line;
    for (const TimedPose& pose : path.poses) line.push_back(ToPixels(pose));
    canvas_.Line(line, stroke);
  }

  // In pieces short enough for the colour to run smoothly.
  void Segment(const TimedPose& from, const TimedPose& to) {
    const int pieces = std::clamp(static_cast<int>(ToSeconds(to.time - from.time) / 0.05), 1, 400);
    for (int i = 0; i < pieces; ++i) {
      const TimedPose a = Between(from, to, static_cast<double>(i) / pieces);
      const TimedPose b = Between(from, to, (i + 1.0) / pieces);
      canvas_.Line(std::array{ToPixels(a), ToPixels(b)}, {times_.At(a.time), 5});
    }
  }

  void End(const TimedPose& pose, const std::string& name) {
    const Eigen::Vector2d at = ToPixels(pose);
    canvas_.Circle(at, 7, palette::kPaper, {times_.At(pose.time), 4});
    const std::string text =
        absl::StrFormat("%s, %.1f s", name, ToSeconds(pose.time - times_.start));
    canvas_.Text(at + Eigen::Vector2d(16, 6), text,
                 {.size_px = 18, .align = Align::kLeft, .bold = true, .halo_px = 5});
  }

  Eigen::Vector2d ToPixels(const TimedPose& pose) const {
    return view_.ToPixels(Eigen::Vector2d(pose.T_W_L.translation.head<2>()));
  }

  Canvas& canvas_;
  const MapView& view_;
  const TimeScale& times_;
};

}  // namespace

void DrawPath(Canvas& canvas, const MapView& view, const TimeScale& times,
              const TopViewOptions& options, const TopViewPath& path) {
  if (path.poses.empty()) return;
  PathPainter painter(canvas, view, times);
  if (path.reference) return painter.Reference(path);
  if (!options.footprint_L.empty()) {
    painter.Footprints(path, options.footprint_L, options.footprint_every);
  }
  painter.Way(path);
}

}  // namespace clearway::report
