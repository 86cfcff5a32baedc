#include "clearway/scene/moving_object.h"

#include <algorithm>
#include <utility>

#include "clearway/geometry/hull.h"
#include "scene/completion.h"
#include "scene/voxel_hull.h"

namespace clearway {
namespace {

// `shape`: none if it is the hull itself.
std::shared_ptr<const Solid> SolidWith(Mesh hull, const std::optional<Shape>& shape) {
  auto solid = std::make_shared<Solid>();
  for (const Eigen::Vector3d& vertex : hull.vertices) {
    solid->box_O.Extend(vertex);
    solid->radius_m = std::max(solid->radius_m, vertex.norm());
  }
  solid->hull = std::make_shared<const Mesh>(std::move(hull));
  solid->shape = shape.value_or(ConvexPolytope{solid->hull});
  return solid;
}

// Whether the step is nothing but rounding: it moves no point within 10 m of O by more than 1e-8 m.
// (Coordinates of 100 km are rounded to 1.5e-11 m, and a motion about the world's origin to more.)
bool IsRounding(const Twist& step) {
  constexpr double kReach_m = 10, kRounding_m = 1e-8;
  return step.linear.norm() + kReach_m * step.angular.norm() < kRounding_m;
}

}  // namespace

std::vector<ObjectId> MovingObject::Ids() const {
  std::vector<ObjectId> ids = also;
  ids.insert(ids.begin(), id);
  return ids;
}

PositionBound Saturated(const PositionBound& bound) {
  return {std::min(bound.at_m, kMaxBoundTerm), std::min(bound.speed_mps, kMaxBoundTerm),
          std::min(bound.accel_mps2, kMaxBoundTerm)};
}

Twist VelocityBetween(const StampedPose& before, const StampedPose& after) {
  Twist step = Log(Inverse(before.T_W_O) * after.T_W_O);
  if (IsRounding(step)) return {};
  if (step.angular.norm() > kMaxTurn_rad) {
    step = {Eigen::Vector3d::Zero(), before.T_W_O.rotation.conjugate() *
                                         (after.T_W_O.translation - before.T_W_O.translation)};
  }
  return (1.0 / ToSeconds(after.stamp - before.stamp)) * step;
}

std::vector<StampedPose> FutureAfter(const std::vector<StampedPose>& future, Time t_k) {
  const auto first = std::find_if(future.begin(), future.end(),
                                  [&](const StampedPose& pose) { return pose.stamp > t_k; });
  return {first, future.end()};
}

std::shared_ptr<const Solid> SolidOf(const VoxelMap& map_O,
                                     const std::optional<Completion>& completion) {
  std::vector<Eigen::Vector3d> points = HullCandidates(map_O);
  if (completion && !points.empty()) {
    AddUnseen(*completion, points);
    KeepOutlines(points);
  }
  Mesh hull = ConvexHullOf(points);
  for (Eigen::Vector3d& vertex : hull.vertices) vertex *= map_O.grid().resolution_m();
  return SolidWith(std::move(hull), std::nullopt);
}

std::shared_ptr<const Solid> SolidOf(const Shape& shape) {
  return SolidWith(HullAround(shape), shape);
}

MovingObject WithMap(MovingObject object, VoxelMap map_O) {
  object.solid = SolidOf(map_O, object.completion);
  object.observed_box_O = map_O.ObservedBox();
  object.map_O = std::move(map_O);
  return object;
}

MovingObject WithFuture(MovingObject object, std::vector<StampedPose> future) {
  object.future_velocity_O = {};
  if (!future.empty()) {
    const std::size_t size = future.size();
    object.future_velocity_O =
        VelocityBetween(size > 1 ? future[size - 2] : object.history.back(), future.back());
  }
  object.future = std::move(future);
  return object;
}

bool MovingObject::AtRest() const {
  return future.empty() && (!velocity_O.has_value() || *velocity_O == Twist{});
}

double MovingObject::SpeedMps() const {
  if (!future.empty()) return VelocityBetween(history.back(), future.front()).linear.norm();
  return velocity_O ? velocity_O->linear.norm() : 0.0;
}

MovingObject::Interval MovingObject::IntervalAt(Time t) const {
  const std::vector<StampedPose>& poses = t < t_k() ? history : future;
  const auto after = std::upper_bound(poses.begin(), poses.end(), t,
                                      [](Time a, const StampedPose& b) { return a < b.stamp; });
  return {after == poses.begin() ? &history.back() : &*(after - 1), &*after};
}

PredictedPose PredictPose(const MovingObject& object, Time t, Duration horizon) {
  const StampedPose &first = object.history.front(), &last = object.LastPose();
  if (t <= first.stamp) return {first.T_W_O, {}};
  if (t < last.stamp) {
    const auto [before, after] = object.IntervalAt(t);
    const double fraction = ToSeconds(t - before->stamp) / ToSeconds(after->stamp - before->stamp);
    return {Interpolate(before->T_W_O, after->T_W_O, fraction), {}};
  }
  if (t == last.stamp) return {last.T_W_O, {}};
  const Twist velocity_O = object.LastVelocity();
  if (velocity_O == Twist{}) return {last.T_W_O, {}};
  const Duration ahead = std::min(t - last.stamp, horizon);
  const Pose T_W_O = last.T_W_O * Exp(ToSeconds(ahead) * velocity_O);
  const Duration beyond = t - last.stamp - ahead;
  if (beyond == Duration::zero()) return {T_W_O, {}};
  return {T_W_O, object.solid->radius_m + velocity_O.linear.norm() * ToSeconds(beyond)};
}

}  // namespace clearway
