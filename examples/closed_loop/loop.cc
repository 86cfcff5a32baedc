#include "closed_loop/loop.h"

#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include "closed_loop/front_end.h"

namespace clearway::closed_loop {
namespace {

constexpr Duration kScanPeriod = std::chrono::milliseconds(100);
constexpr Duration kLookEvery = std::chrono::milliseconds(10);
// Beyond the speed of plans, for what SLAM's errors make the robot drift from its path.
constexpr double kCatchUp_mps = 0.3;
// The same loop ends alike whatever ran before.
constexpr std::uint_fast32_t kPlannerSeed = 1;

// A small LiDAR that sees as far as a robot of 1.5 m/s needs.
SpinningLidar RobotLidar() {
  return {.beams = 5,
          .azimuth_steps = 240,
          .lowest_rad = -0.25,
          .highest_rad = 0.25,
          .min_range_m = 0.1,
          .max_range_m = 10};
}

Simulation SimulationOf(const Course& course, const LoopOptions& options) {
  SimulationSpec spec;
  spec.name = "carrier";
  spec.world = course.world;
  spec.sensor = RobotLidar();
  spec.period = kScanPeriod;
  spec.frame_count = static_cast<std::size_t>(options.lasts / kScanPeriod);
  spec.seed = options.seed;
  if (options.slam_noise) spec.noise = SlamNoise::TableOne(kScanPeriod);
  spec.report_visible_only = true;
  return Simulation(std::move(spec));
}

// T_W_S of the LiDAR on the robot's axis, which does not turn.
Pose SensorPose(const Eigen::Vector2d& p_W) {
  constexpr double kSensorHeight_m = 0.8;
  return Pose::Translation(p_W.x(), p_W.y(), kSensorHeight_m);
}

Eigen::Vector2d Shortened(const Eigen::Vector2d& way_W, double most_m) {
  const double length_m = way_W.norm();
  return length_m > most_m ? Eigen::Vector2d(most_m / length_m * way_W) : way_W;
}

// Follows a path as the controller of a robot would, who knows where it is from SLAM alone. One
// thread.
class Follower {
 public:
  explicit Follower(const Eigen::Vector2d& p_W) : true_W_(p_W), path_(Time(), p_W) {}

  const Eigen::Vector2d& true_W() const { return true_W_; }

  // A scan says where the robot is. Returns where it will take itself to be one period later.
  TimedPath::Knot Localized(const Pose& T_W_S, Time time) {
    const Eigen::Vector2d believed_W = T_W_S.translation.head<2>();
    W_from_true_ = T_W_S.rotation;
    behind_W_ = Shortened(path_.At(time) - believed_W, kCatchUp_mps * ToSeconds(kScanPeriod));
    return {time + kScanPeriod,
            believed_W + behind_W_ + path_.At(time + kScanPeriod) - path_.At(time)};
  }

  // Goes on to the next scan; `look` sees where it truly is.
  void Drive(Time time, const std::function<void(const Eigen::Vector2d&, Time)>& look) {
    const Eigen::Vector2d from_W = true_W_;
    for (Duration after = kLookEvery; after <= kScanPeriod; after += kLookEvery) {
      const double share = ToSeconds(after) / ToSeconds(kScanPeriod);
      Eigen::Vector3d way_W = Eigen::Vector3d::Zero();
      way_W.head<2>() = path_.At(time + after) - path_.At(time) + share * behind_W_;
      // The sensor truly does not turn: what SLAM takes for W is turned by its error.
      true_W_ = from_W + (W_from_true_.conjugate() * way_W).head<2>();
      look(true_W_, time + after);
    }
  }

  void Follow(TimedPath path) { path_ = std::move(path); }

 private:
  Eigen::Vector2d true_W_;
  TimedPath path_;
  Eigen::Vector2d behind_W_ = Eigen::Vector2d::Zero();
  Eigen::Quaterniond W_from_true_ = Eigen::Quaterniond::Identity();
};

}  // namespace

LoopOptions MakeLoopOptions(bool slam_noise, bool inflation, std::uint64_t seed) {
  LoopOptions options;
  options.slam_noise = slam_noise;
  options.seed = seed;
  if (slam_noise) {
    options.navigator.padding_m = 0.4;
    options.navigator.inflation_mps = 1.0;
    options.motion_over = std::chrono::seconds(1);
  }
  if (!inflation) options.navigator.inflation_mps = 0;
  return options;
}

absl::StatusOr<LoopResult> RunLoop(const Course& course, const LoopOptions& options,
                                   SceneFeed& feed,
                                   const std::function<void(const LoopStep&)>& watch) {
  // OMPL complains of a second seed, for generators made before keep theirs; we have none.
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  ompl::RNG::setSeed(kPlannerSeed);
  FrontEnd front_end(SimulationOf(course, options), options.motion_over);
  Navigator navigator(course.errand, options.navigator);
  Follower robot(course.errand.start_W);
  Judge judge(course.world, course.errand.carrier);
  LoopResult result;
  const auto scans = static_cast<std::size_t>(options.lasts / kScanPeriod);
  for (std::size_t k = 0; k < scans; ++k) {
    const Frame frame = front_end.Scan(SensorPose(robot.true_W()), k);
    const Time now = frame.stamp;
    judge.Saw(frame.labels, now);
    const absl::StatusOr<ScenePtr> scene = feed.Push(frame);
    if (!scene.ok()) return scene.status();
    const double left_m = (frame.T_W_S.translation.head<2>() - course.errand.goal_W).norm();
    if (!result.arrival && left_m < kArrived_m) result.arrival = now;
    const TimedPath::Knot next = robot.Localized(frame.T_W_S, now);
    std::optional<Decision> decision;
    if (k % options.scans_per_decision == 0) decision = navigator.Decide(*scene, next);
    if (watch) watch({now, robot.true_W(), decision, *scene});
    result.driven.push_back({now, robot.true_W()});
    robot.Drive(now, [&](const Eigen::Vector2d& p_W, Time time) { judge.Look(p_W, time); });
    if (decision) robot.Follow(decision->path);
  }
  result.collisions = judge.collisions();
  return result;
}

}  // namespace clearway::closed_loop
