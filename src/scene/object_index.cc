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

}  // namespace

// Along a screw the origin's velocity turns: its acceleration is the angular velocity's cross
// product with it, of the same length at all times.
ObjectIndex::Ball ObjectIndex::BallOf(const MovingObject& object, Duration horizon) {
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
  return ball;
}

// A box round everything of the object from `first` to `last`. Before t_k it moves between the
// poses of the history.
Aabb ObjectIndex::ReachOf(const MovingObject& object, const Ball& ball, Time first, Time last) {
  Aabb reach_W;
  if (first < ball.t_k) reach_W = OriginsOf(object.history).Padded(ball.radius_m);
  if (last >= ball.t_k) {
    const auto [center_W, radius_m] = ball.During(std::max(first, ball.t_k), last, 0);
    reach_W.Extend(Aabb{center_W, center_W}.Padded(radius_m));
  }
  return reach_W;
}

void ObjectIndex::Mark(std::size_t object, int slice, const Aabb& reach_W) {
  for (int axis = 0; axis < 3; ++axis) {
    const int to = CellOf(axis, reach_W.max[axis]);
    for (int cell = CellOf(axis, reach_W.min[axis]); cell <= to; ++cell) {
      cells_[axis][WordOf(slice, cell, object / 64)] |= std::uint64_t{1} << object % 64;
    }
  }
}

ObjectIndex::ObjectIndex(const SceneSnapshot& scene, Time first, Time last, int slices)
    : first_(first),
      last_(last),
      slice_(std::max(Duration(1), (last - first) / slices)),
      slices_(slices),
      words_((scene.objects.size() + 63) / 64) {
  if (words_ == 0) return;
  std::vector<Aabb> reaches_W;  // slice by slice
  for (const auto& object : scene.objects) {
    balls_.push_back(BallOf(*object, scene.params.horizon));
    oldest_t_k_ = std::min(oldest_t_k_, object->t_k());
  }
  for (int slice = 0; slice < slices; ++slice) {
    const Time from = first + slice * slice_;
    const Time until = slice + 1 < slices ? from + slice_ : last;
    for (std::size_t i = 0; i < balls_.size(); ++i) {
      reaches_W.push_back(ReachOf(*scene.objects[i], balls_[i], from, until));
      box_W_.Extend(reaches_W.back());
    }
  }
  low_ = box_W_.min;
  cells_per_m_ = kCells * (box_W_.max - box_W_.min).cwiseMax(1e-3).cwiseInverse();
  for (auto& axis : cells_) axis.assign(slices * kCells * words_, 0);
  for (std::size_t i = 0; i < reaches_W.size(); ++i) {
    Mark(i % balls_.size(), static_cast<int>(i / balls_.size()), reaches_W[i]);
  }
}

// Seen from the object, the ball's centre goes straight: on one side of the horizon its own does.
bool ObjectIndex::MayMeet(std::size_t object, const MovingBall& ball, double inflation_mps) const {
  const Ball& own = balls_[object];
  const double since_s = ToSeconds(ball.from - own.t_k), until_s = ToSeconds(ball.until - own.t_k);
  if (since_s < 0 || (since_s < own.horizon_s && until_s > own.horizon_s)) return true;
  const Ball::Reach begins = own.During(ball.from, ball.from, inflation_mps);
  const Ball::Reach ends = own.During(ball.until, ball.until, inflation_mps);
  const Eigen::Vector3d apart_W = ball.from_W - begins.center_W;
  const Eigen::Vector3d way_W = ball.until_W - ends.center_W - apart_W;
  const double squared = way_W.squaredNorm();
  const double share = squared > 0 ? std::clamp(-apart_W.dot(way_W) / squared, 0.0, 1.0) : 0;
  const double reach_m = ball.radius_m + std::max(begins.radius_m, ends.radius_m);
  return (apart_W + share * way_W).squaredNorm() <= reach_m * reach_m;
}

}  // namespace clearway
