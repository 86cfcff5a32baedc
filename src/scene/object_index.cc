#include "clearway/scene/object_index.h"

#include <algorithm>

namespace clearway {
namespace {

double FarthestCorner_m(const Aabb& box_O) {
  if (box_O.Empty()) return 0;
  return box_O.min.cwiseAbs().cwiseMax(box_O.max.cwiseAbs()).norm();
}

// A box round the origin's way through the poses: from each to the next along a screw, on which no
// point is farther from both ends than half of its length.
Aabb OriginsOf(const std::vector<StampedPose>& history) {
  Aabb way_W{history[0].T_W_O.translation, history[0].T_W_O.translation};
  for (std::size_t i = 1; i < history.size(); ++i) {
    const Pose &from = history[i - 1].T_W_O, &to = history[i].T_W_O;
    Aabb ends_W{from.translation, from.translation};
    ends_W.Extend(to.translation);
    way_W.Extend(ends_W.Padded(0.5 * Log(Inverse(from) * to).linear.norm()));
  }
  return way_W;
}

constexpr double kRounding_m = 1e-6;

// A ball of this radius about the object's origin holds all of it.
double RadiusOf(const MovingObject& object) {
  return kRounding_m + std::max({FarthestCorner_m(object.observed_box_O),
                                 FarthestCorner_m(object.solid->box_O), object.solid->radius_m});
}

// A box round everything of the object from `first` to `last`. From t_k on the origin moves at a
// constant speed along a screw, before t_k between the poses of the history.
Aabb ReachOf(const MovingObject& object, Time first, Time last, double inflation_mps) {
  const StampedPose& newest = object.history.back();
  Aabb origins_W{newest.T_W_O.translation, newest.T_W_O.translation};
  if (first < newest.stamp) origins_W.Extend(OriginsOf(object.history));
  const double ahead_s = std::max(0.0, ToSeconds(last - newest.stamp));
  return origins_W.Padded(RadiusOf(object) + ahead_s * (object.SpeedMps() + inflation_mps));
}

}  // namespace

// Along a screw the origin's velocity turns: its acceleration is the angular velocity's cross
// product with it, of the same length at all times.
ObjectIndex::Ball ObjectIndex::BallOf(const MovingObject& object, Duration horizon,
                                      double inflation_mps) {
  const StampedPose& newest = object.history.back();
  const Twist velocity_O = object.velocity_O.value_or(Twist{});
  Ball ball;
  ball.t_k = newest.stamp;
  ball.origin_W = newest.T_W_O.translation;
  ball.velocity_W = newest.T_W_O.rotation * velocity_O.linear;
  ball.radius_m = RadiusOf(object);
  ball.horizon_s = ToSeconds(horizon);
  ball.bend_mps2 = 0.5 * velocity_O.angular.cross(velocity_O.linear).norm();
  ball.beyond_mps = object.SpeedMps();
  ball.inflation_mps = inflation_mps;
  return ball;
}

ObjectIndex::ObjectIndex(const SceneSnapshot& scene, Time first, Time last, double inflation_mps)
    : words_((scene.objects.size() + 63) / 64) {
  std::vector<Aabb> reaches_W;
  for (const auto& object : scene.objects) {
    balls_.push_back(BallOf(*object, scene.params.horizon, inflation_mps));
    reaches_W.push_back(ReachOf(*object, first, last, inflation_mps));
    box_W_.Extend(reaches_W.back());
  }
  if (reaches_W.empty()) return;
  low_ = box_W_.min;
  cells_per_m_ = kCells * (box_W_.max - box_W_.min).cwiseMax(1e-3).cwiseInverse();
  for (int axis = 0; axis < 3; ++axis) {
    cells_[axis].assign(kCells * words_, 0);
    for (std::size_t i = 0; i < reaches_W.size(); ++i) {
      const int to = CellOf(axis, reaches_W[i].max[axis]);
      for (int cell = CellOf(axis, reaches_W[i].min[axis]); cell <= to; ++cell) {
        cells_[axis][cell * words_ + i / 64] |= std::uint64_t{1} << i % 64;
      }
    }
  }
}

}  // namespace clearway
