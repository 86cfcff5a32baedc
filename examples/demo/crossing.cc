#include "demo/crossing.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "absl/strings/str_format.h"

namespace clearway::demo {
namespace {

constexpr Duration kAhead = std::chrono::milliseconds(1500);
constexpr double kSideM = 4;  // from the object's path to the start, and to the goal
constexpr Duration kJudgeStep = std::chrono::milliseconds(10);
constexpr double kFarM = 3;  // closest distances beyond do not matter

TimedPose PoseAt(const std::vector<TimedPose>& path, Time t) {
  const auto after = std::upper_bound(path.begin(), path.end(), t,
                                      [](Time time, const TimedPose& p) { return time < p.time; });
  if (after == path.begin()) return path.front();
  if (after == path.end()) return path.back();
  const TimedPose &a = *std::prev(after), &b = *after;
  return {t, Interpolate(a.T_W_L, b.T_W_L, ToSeconds(t - a.time) / ToSeconds(b.time - a.time))};
}

// Lowest occupied voxel of each column, as points.
std::vector<Eigen::Vector3d> LowestPoints(const VoxelMap& map, const Aabb& area_W) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> lowest;
  const BlockKey low = BlockOf(map.grid().KeyOf(area_W.min));
  const BlockKey high = BlockOf(map.grid().KeyOf(area_W.max));
  map.blocks().ForEachIn(low, high, [&](BlockKey block_key, const VoxelBlock& block) {
    block.occupied.ForEach([&](int index) {
      const VoxelKey key = VoxelAt(block_key, index);
      const auto [at, fresh] = lowest.try_emplace({key.x, key.y}, key.z);
      if (!fresh) at->second = std::min(at->second, key.z);
    });
  });
  std::vector<Eigen::Vector3d> points;
  for (const auto& [xy, z] : lowest) {
    points.push_back(map.grid().CenterOf({xy.first, xy.second, z}));
  }
  return points;
}

// Least squares over the points whose distance from `plane` is at most `tolerance_m`.
GroundPlane Refitted(const GroundPlane& plane, const std::vector<Eigen::Vector3d>& points,
                     double tolerance_m) {
  Eigen::Matrix3d normal = 1e-6 * Eigen::Matrix3d::Identity();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) {
    if (std::abs(p.z() - plane.HeightM(p.x(), p.y())) > tolerance_m) continue;
    const Eigen::Vector3d row(1, p.x() - plane.center_W.x(), p.y() - plane.center_W.y());
    normal += row * row.transpose();
    right += row * p.z();
  }
  return {plane.center_W, normal.ldlt().solve(right)};
}

}  // namespace

double Crossing::Yaw() const {
  const Eigen::Vector2d way = goal_W - start_W;
  return std::atan2(way.y(), way.x());
}

Ground GroundPlane::Under(double clearance_m) const {
  return {.height_m = [plane = *this](double x_m, double y_m) { return plane.HeightM(x_m, y_m); },
          .clearance_m = clearance_m,
          .max_slope = Slope()};
}

absl::StatusOr<Crossing> MakeCrossing(const Truth& truth, ObjectId blocker, Time now,
                                      double shift_m, bool from_right) {
  constexpr Duration kEither = std::chrono::milliseconds(200);
  const auto there = BoxOf(truth, blocker, now + kAhead);
  const auto before = BoxOf(truth, blocker, now + kAhead - kEither);
  const auto after = BoxOf(truth, blocker, now + kAhead + kEither);
  if (!there || !before || !after) {
    return absl::NotFoundError(absl::StrFormat("object %d is not recorded %g s after %g s", blocker,
                                               ToSeconds(kAhead),
                                               ToSeconds(now.time_since_epoch())));
  }
  const Eigen::Vector2d way =
      (after->T_W_B.translation - before->T_W_B.translation).head<2>().normalized();
  const Eigen::Vector2d left(-way.y(), way.x());
  const Eigen::Vector2d middle = there->T_W_B.translation.head<2>() + shift_m * way;
  const double side_m = from_right ? -kSideM : kSideM;
  Crossing crossing;
  crossing.blocker = blocker;
  crossing.now = now;
  crossing.start_W = middle + side_m * left;
  crossing.goal_W = middle - side_m * left;
  crossing.shift_m = shift_m;
  return crossing;
}

absl::StatusOr<GroundPlane> FitGround(const VoxelMap& static_map_W, const Crossing& crossing,
                                      double radius_m) {
  constexpr std::size_t kFewest = 50;
  Aabb area_W;
  for (const Eigen::Vector2d& p : {crossing.start_W, crossing.goal_W}) {
    area_W.Extend(Eigen::Vector3d(p.x(), p.y(), 0));
  }
  area_W = area_W.Padded(radius_m);
  area_W.min.z() = -static_map_W.grid().limit_m();
  area_W.max.z() = static_map_W.grid().limit_m();
  const std::vector<Eigen::Vector3d> points = LowestPoints(static_map_W, area_W);
  if (points.size() < kFewest) {
    return absl::FailedPreconditionError(
        absl::StrFormat("only %d columns of the map show the ground", points.size()));
  }
  std::vector<double> heights;
  for (const Eigen::Vector3d& p : points) heights.push_back(p.z());
  const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 3);
  std::nth_element(heights.begin(), middle, heights.end());
  GroundPlane plane{0.5 * (crossing.start_W + crossing.goal_W), {*middle, 0, 0}};
  for (const double tolerance_m : {0.5, 0.4, 0.3, 0.2, 0.15, 0.15}) {
    plane = Refitted(plane, points, tolerance_m);
  }
  return plane;
}

std::vector<TimedPose> StraightWay(const Crossing& crossing, const GroundPlane& ground,
                                   double clearance_m) {
  const double length_m = (crossing.goal_W - crossing.start_W).norm();
  const auto pose = [&](const Eigen::Vector2d& p_W) {
    Pose T_W_L;
    T_W_L.rotation = Eigen::AngleAxisd(crossing.Yaw(), Eigen::Vector3d::UnitZ());
    T_W_L.translation << p_W,
        ground.HeightM(p_W.x(), p_W.y()) + clearance_m + crossing.robot_size_m.z() / 2;
    return T_W_L;
  };
  return {{crossing.now, pose(crossing.start_W)},
          {crossing.now + FromSeconds(length_m / crossing.max_speed_mps), pose(crossing.goal_W)}};
}

Verdict Judge(const Truth& truth, const Crossing& crossing, const std::vector<TimedPose>& path) {
  Verdict verdict;
  verdict.closest_m = kFarM;
  verdict.checked_until = std::min(path.back().time, truth.end);
  const auto touched = [&](const TimedPose& pose, double padding_m) {
    const Eigen::Vector3d size = crossing.robot_size_m.array() + 2 * padding_m;
    return truth.touched(Box{size}, pose.T_W_L, pose.time);
  };
  for (Time t = path.front().time; t <= verdict.checked_until; t += kJudgeStep) {
    const TimedPose pose = PoseAt(path, t);
    if (const auto contact = touched(pose, 0); contact && !verdict.contact) {
      verdict.contact = t;
      verdict.touched = *contact;
    }
    // Objects come before the static world, so a padded robot that reaches one says so.
    const auto reaches = [&](double padding_m) { return touched(pose, padding_m).value_or(0) > 0; };
    if (!reaches(verdict.closest_m)) continue;
    for (double low_m = 0; verdict.closest_m - low_m > 0.005;) {
      const double middle_m = (low_m + verdict.closest_m) / 2;
      (reaches(middle_m) ? verdict.closest_m : low_m) = middle_m;
    }
  }
  return verdict;
}

}  // namespace clearway::demo
