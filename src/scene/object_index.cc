#include "clearway/scene/object_index.h"

#include <algorithm>
#include <numbers>

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

// From one pose to a later one the origin goes along a screw that turns by at most half a turn. The
// sine of half of the turn tells how much it strays:
double SineOfHalfTurn(const Pose& T_W_A, const Pose& T_W_B) {
  return std::min(1.0, (T_W_A.rotation.conjugate() * T_W_B.rotation).vec().norm());
}

// Along a screw that turns by `a` the origin's acceleration, by shares of the time, is a^2 times
// the radius, which is at most chord / (2 sin(a / 2)): it strays by an eighth of that in the
// middle. And a / 2 <= pi / 2 sin(a / 2).
double StraysBy(const Pose& T_W_A, const Pose& T_W_B) {
  constexpr double kPi = std::numbers::pi;
  const double chord_m = (T_W_B.translation - T_W_A.translation).norm();
  return kPi * kPi / 16 * SineOfHalfTurn(T_W_A, T_W_B) * chord_m;
}

// An arc of half a turn or less is longer than its chord by (a / 2) / sin(a / 2) at most, and that
// quotient is convex in the sine. Of an interval that is next to nothing, such as one from where a
// frame found the object to where it was stated to be by then, the speed is no speed.
double FastestBetween(const StampedPose& before, const StampedPose& after, double radius_m) {
  constexpr double kPi = std::numbers::pi;
  const double sine = SineOfHalfTurn(before.T_W_O, after.T_W_O);
  const double chord_m = (after.T_W_O.translation - before.T_W_O.translation).norm();
  const double way_m = (1 + (kPi / 2 - 1) * sine) * chord_m + kPi * sine * radius_m;
  constexpr double kShortest_s = 0.02;
  return way_m / std::max(kShortest_s, ToSeconds(after.stamp - before.stamp));
}

PositionBound Wider(const PositionBound& a, const PositionBound& b) {
  return {std::max(a.at_m, b.at_m), std::max(a.speed_mps, b.speed_mps),
          std::max(a.accel_mps2, b.accel_mps2)};
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
  const StampedPose& newest = object.LastPose();
  const Twist velocity_O = object.LastVelocity();
  Ball ball;
  ball.t_k = object.t_k();
  ball.last = newest.stamp;
  ball.origin_W = newest.T_W_O.translation;
  ball.velocity_W = newest.T_W_O.rotation * velocity_O.linear;
  ball.radius_m = RadiusOf(object);
  ball.horizon_s = ToSeconds(horizon);
  ball.bend_mps2 = 0.5 * velocity_O.angular.cross(velocity_O.linear).norm();
  ball.beyond_mps = velocity_O.linear.norm();
  ball.bound = object.bound;
  if (object.future.empty()) return ball;
  ball.way.reserve(object.future.size() + 1);
  const StampedPose* before = &object.history.back();
  for (const StampedPose& after : object.future) {
    const Eigen::Vector3d way_W = after.T_W_O.translation - before->T_W_O.translation;
    const Eigen::Vector3d velocity_W = way_W / ToSeconds(after.stamp - before->stamp);
    ball.way.push_back({before->stamp, before->T_W_O.translation,
                        StraysBy(before->T_W_O, after.T_W_O), velocity_W, velocity_W.norm()});
    before = &after;
  }
  ball.way.push_back({newest.stamp, newest.T_W_O.translation, 0, Eigen::Vector3d::Zero(), 0});
  return ball;
}

double ObjectIndex::FastestMps(const MovingObject& object, const Ball& ball) {
  const double radius_m = object.solid->radius_m;
  double fastest_mps = ball.beyond_mps + object.LastVelocity().angular.norm() * radius_m;
  const StampedPose* before = &object.history.back();
  for (const StampedPose& after : object.future) {
    fastest_mps = std::max(fastest_mps, FastestBetween(*before, after, radius_m));
    before = &after;
  }
  return fastest_mps;
}

std::size_t ObjectIndex::Ball::WaypointAt(Time t) const {
  const auto next = std::upper_bound(way.begin(), way.end(), t,
                                     [](Time a, const Waypoint& b) { return a < b.stamp; });
  return static_cast<std::size_t>(next - way.begin()) - 1;
}

ObjectIndex::Ball::Reach ObjectIndex::Ball::DuringWay(std::size_t i, Time from, Time until,
                                                      const ObjectGrowth& growth) const {
  const Waypoint &before = way[i], &after = way[i + 1];
  const double begins_s = ToSeconds(std::max(from, before.stamp) - before.stamp);
  const double ends_s = ToSeconds(std::min(until, after.stamp) - before.stamp);
  return {before.origin_W + 0.5 * (begins_s + ends_s) * before.velocity_W,
          radius_m + before.strays_m + 0.5 * (ends_s - begins_s) * before.speed_mps +
              Grown(until, growth)};
}

bool ObjectIndex::Ball::MeetsOnWay(const Aabb& box_W, Time from, Time until,
                                   const ObjectGrowth& growth) const {
  for (std::size_t i = WaypointAt(from); i + 1 < way.size() && way[i].stamp <= until; ++i) {
    if (DuringWay(i, from, until, growth).Meets(box_W)) return true;
  }
  return until > last && During(last, until, growth).Meets(box_W);
}

std::optional<std::array<ObjectIndex::Ball::Reach, 2>> ObjectIndex::Ball::Straight(
    Time from, Time until, const ObjectGrowth& growth) const {
  if (from < t_k) return std::nullopt;
  if (from < last) {
    const std::size_t i = WaypointAt(from);
    if (until > way[i + 1].stamp) return std::nullopt;
    return {{DuringWay(i, from, from, growth), DuringWay(i, until, until, growth)}};
  }
  if (ToSeconds(from - last) < horizon_s && ToSeconds(until - last) > horizon_s) {
    return std::nullopt;
  }
  return {{During(from, from, growth), During(until, until, growth)}};
}

// A box round everything of the object from `first` to `last`. Before t_k it moves between the
// poses of the history.
Aabb ObjectIndex::ReachOf(const MovingObject& object, const Ball& ball, Time first, Time last) {
  Aabb reach_W;
  if (first < ball.t_k) reach_W = OriginsOf(object.history).Padded(ball.radius_m);
  const auto extend = [&reach_W](const Ball::Reach& reach) {
    reach_W.Extend(Aabb{reach.center_W, reach.center_W}.Padded(reach.radius_m));
  };
  if (!ball.way.empty() && first < ball.last && last >= ball.t_k) {
    const Time from = std::max(first, ball.t_k);
    for (std::size_t i = ball.WaypointAt(from);
         i + 1 < ball.way.size() && ball.way[i].stamp <= last; ++i) {
      extend(ball.DuringWay(i, from, last, {}));
    }
  }
  if (last >= ball.last) extend(ball.During(std::max(first, ball.last), last, {}));
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
    fastest_mps_ = std::max(fastest_mps_, FastestMps(*object, balls_.back()));
    oldest_t_k_ = std::min(oldest_t_k_, object->t_k());
    widest_ = Wider(widest_, balls_.back().bound);
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

// Seen from the object, the ball's centre goes straight: where its own does.
bool ObjectIndex::MayMeet(std::size_t object, const MovingBall& ball,
                          const ObjectGrowth& growth) const {
  const auto straight = balls_[object].Straight(ball.from, ball.until, growth);
  if (!straight) return true;
  const auto& [begins, ends] = *straight;
  const Eigen::Vector3d apart_W = ball.from_W - begins.center_W;
  const Eigen::Vector3d way_W = ball.until_W - ends.center_W - apart_W;
  const double squared = way_W.squaredNorm();
  const double share = squared > 0 ? std::clamp(-apart_W.dot(way_W) / squared, 0.0, 1.0) : 0;
  const double reach_m = ball.radius_m + std::max(begins.radius_m, ends.radius_m);
  return (apart_W + share * way_W).squaredNorm() <= reach_m * reach_m;
}

}  // namespace clearway
