#include "scene/completion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace clearway {
namespace {

// Over what time a course is taken: about so long, and not less or more than these.
constexpr Duration kCourse = std::chrono::seconds(1), kLeast = kCourse / 2, kMost = 3 * kCourse;
constexpr double kFarEnough_m = 1;  // in that time
constexpr double kFast_mps = 3;     // people who walk are slower
constexpr double kLeastLength = 2;  // of a vehicle, in widths

// Horizontal, in O.
struct Axes {
  Eigen::Vector3d ahead, aside;
};
Axes AxesAt(double yaw_rad) {
  const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
  return {{c, s, 0}, {-s, c, 0}};
}

// From where to where points reach along an axis.
struct Reach {
  double least = std::numeric_limits<double>::max();
  double most = std::numeric_limits<double>::lowest();
  double Length() const { return most - least; }
  double Middle() const { return 0.5 * (least + most); }
  double OutsideOf(double at) const { return std::max({least - at, at - most, 0.0}); }
};
Reach ReachOf(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& axis) {
  Reach reach;
  for (const Eigen::Vector3d& p : points) {
    reach.least = std::min(reach.least, axis.dot(p));
    reach.most = std::max(reach.most, axis.dot(p));
  }
  return reach;
}

// The velocity of the object's middle over the last second, in O; none if that does not tell which
// way its length lies: it hardly went anywhere, or it swings rather than drives (a boom, about its
// end).
std::optional<Eigen::Vector2d> CourseOf(const MovingObject& object) {
  const StampedPose& now = object.history.back();
  const auto later = std::ranges::find_if(
      object.history, [&](const StampedPose& pose) { return pose.stamp > now.stamp - kCourse; });
  const StampedPose& before = later == object.history.begin() ? *later : *(later - 1);
  const Duration passed = now.stamp - before.stamp;
  if (passed < kLeast || passed > kMost) return std::nullopt;
  const Twist velocity_O = VelocityBetween(before, now);
  const Aabb& box_O = object.solid->box_O;
  const Eigen::Vector2d course_mps =
      (velocity_O.linear + velocity_O.angular.cross(box_O.Center())).head<2>();
  const double turned_mps = 0.5 * box_O.Size().head<2>().norm() * std::abs(velocity_O.angular.z());
  const bool far = course_mps.norm() * ToSeconds(passed) >= kFarEnough_m;
  if (!far || turned_mps > 0.5 * course_mps.norm()) return std::nullopt;
  return course_mps;
}

// Whether the sensor is so far beside (or above) it that rays under ten degrees or more tell where
// its flank (or its roof) ends, if nothing hides that.
bool FlankIsSeen(const Reach& along, const Reach& across, double sensor_along,
                 double sensor_across) {
  const double before_m = along.OutsideOf(sensor_along);
  const double beside_m = across.OutsideOf(sensor_across);
  return beside_m >= before_m * std::tan(10 * std::numbers::pi / 180);
}

}  // namespace

std::optional<Completion> CompletionOf(const MovingObject& object,
                                       const Eigen::Vector3d& sensor_W) {
  if (object.solid == nullptr || object.solid->hull->vertices.empty()) return object.completion;
  const std::optional<Eigen::Vector2d> course_mps = CourseOf(object);
  if (!course_mps && !object.completion) return std::nullopt;
  Completion completion = object.completion.value_or(Completion());
  if (course_mps) {
    // In steps: what goes straight keeps its hull.
    constexpr double kPerRad = 1000;
    completion.yaw_rad =
        std::round(kPerRad * std::atan2(course_mps->y(), course_mps->x())) / kPerRad;
  }

  const auto [ahead, aside] = AxesAt(completion.yaw_rad);
  const Reach along = ReachOf(object.solid->hull->vertices, ahead);
  const Reach across = ReachOf(object.solid->hull->vertices, aside);
  const Eigen::Vector3d sensor_O = Inverse(object.history.back().T_W_O) * sensor_W;
  const double sensor_along = ahead.dot(sensor_O);
  completion.length_seen |= FlankIsSeen(along, across, sensor_along, aside.dot(sensor_O));
  const bool vehicle =
      completion.unseen_end != 0 || (course_mps && course_mps->norm() >= kFast_mps);
  const bool whole = object.part_of == kStaticLabel;
  const int far_end = sensor_along < along.Middle() ? 1 : -1;
  completion.unseen_end = vehicle && whole && !completion.length_seen ? far_end : 0;
  return completion;
}

std::optional<Completion> JoinedCompletion(const std::optional<Completion>& lost,
                                           const std::optional<Completion>& young,
                                           const Pose& T_Y_L) {
  if (!young) return lost;
  Completion joined = *young;
  const Eigen::Vector3d ahead_L = T_Y_L.rotation.conjugate() * AxesAt(young->yaw_rad).ahead;
  joined.yaw_rad = std::atan2(ahead_L.y(), ahead_L.x());
  joined.length_seen |= lost && lost->length_seen;
  if (joined.length_seen) joined.unseen_end = 0;
  return joined;
}

void AddUnseen(const Completion& completion, std::vector<Eigen::Vector3d>& points) {
  const Axes axes = AxesAt(completion.yaw_rad);
  const Reach along = ReachOf(points, axes.ahead), across = ReachOf(points, axes.aside);
  // Whole parts of a unit: what is the same, or lies in one plane, would not for rounding.
  const auto add = [&](const Eigen::Vector3d& p) {
    constexpr double kPerUnit = 1024;
    points.push_back((kPerUnit * p).array().round() / kPerUnit);
  };
  const auto repeat = [&](auto moved) {
    const std::size_t count = points.size();
    points.reserve(2 * count);
    for (std::size_t i = 0; i < count; ++i) add(moved(points[i]));
  };
  repeat([&](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    return p + 2 * (across.Middle() - axes.aside.dot(p)) * axes.aside;
  });
  const double unseen = kLeastLength * across.Length() - along.Length();
  if (completion.unseen_end == 0 || unseen <= 0) return;
  repeat([&](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    return p + completion.unseen_end * unseen * axes.ahead;
  });
}

}  // namespace clearway
