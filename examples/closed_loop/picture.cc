#include "closed_loop/picture.h"

#include <cmath>
#include <memory>
#include <numbers>

#include "absl/strings/str_format.h"
#include "clearway/report/top_view.h"
#include "clearway/report/truth.h"

namespace clearway::closed_loop {
namespace {

constexpr Duration kShownEvery = std::chrono::seconds(2);

std::vector<Eigen::Vector2d> RobotOutline(double radius_m) {
  constexpr int kCorners = 24;
  std::vector<Eigen::Vector2d> outline;
  for (int i = 0; i < kCorners; ++i) {
    const double angle_rad = 2 * std::numbers::pi * i / kCorners;
    outline.push_back(radius_m * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad)));
  }
  return outline;
}

}  // namespace

absl::Status WritePicture(const Course& course, const LoopResult& result,
                          const SceneSnapshot& scene, Time until, const std::string& png_file) {
  TopViewOptions options;
  options.title = "Closed loop: the robot's way, and what moved, in the colours of their times";
  options.subtitle = absl::StrFormat(
      "%s, %d collisions",
      result.arrival
          ? absl::StrFormat("at the goal after %.1f s", ToSeconds(*result.arrival - Time()))
          : std::string("never at the goal"),
      result.collisions.size());
  options.area_W = course.errand.area_W;
  options.footprint_L = RobotOutline(std::get<Cylinder>(course.errand.carrier.body).radius_m);
  options.footprint_every = kShownEvery;
  // The picture's colours are of what is still to come; here it is the past, counted from its
  // start.
  const Duration shift = scene.stamp - Time();
  TopViewPath& driven = options.paths.emplace_back();
  driven.name = "robot";
  for (const TimedPath::Knot& knot : result.driven) {
    if (knot.time <= until)
      driven.poses.push_back({knot.time + shift, course.errand.carrier.LinkPose(knot.p_W)});
  }
  const Truth truth = TruthOf(std::make_shared<const World>(course.world), until);
  for (Time time; time <= until; time += kShownEvery) {
    for (TopViewOutline& outline : OutlinesAt(truth, time)) {
      outline.time += shift;
      options.recorded.push_back(std::move(outline));
    }
  }
  return WriteTopView(scene, options, png_file);
}

}  // namespace clearway::closed_loop
