#include "demo/drive.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace clearway::demo {
namespace {

using closed_loop::Choice;
using closed_loop::Decision;
using closed_loop::TimedPath;

constexpr std::size_t kScansPerDecision = 5;
constexpr Duration kTakesEffectAfter = std::chrono::milliseconds(100);
constexpr double kArrivedM = 0.05;

// With the margin: what the robot is to keep clear of everything.
closed_loop::Errand ErrandOf(const Place& place, const PlanSettings& settings) {
  constexpr double kRoomM = 3;  // beside the straight way
  const Crossing& crossing = place.crossing;
  closed_loop::Errand errand;
  errand.carrier.body = crossing.RobotBody(place.margin_m);
  errand.carrier.yaw_rad = crossing.Yaw();
  errand.carrier.max_speed_mps = crossing.max_speed_mps;
  errand.carrier.ground = place.ground.Under(settings.ground_clearance_m);
  errand.start_W = crossing.start_W;
  errand.goal_W = crossing.goal_W;
  for (const Eigen::Vector2d& p_W : {crossing.start_W, crossing.goal_W}) {
    errand.area_W.Extend(Eigen::Vector3d(p_W.x(), p_W.y(), 0));
  }
  errand.area_W = errand.area_W.Padded(kRoomM);
  return errand;
}

closed_loop::NavigatorOptions NavigatorOptionsOf(const PlanSettings& settings) {
  closed_loop::NavigatorOptions options;
  options.inflation_mps = settings.inflations_mps.front();
  options.later_inflation_mps = settings.inflations_mps.back();
  options.inflate_moving_only = true;
  options.padding_m = 0;  // it is in the robot's model
  options.unknown = UnknownPolicy::kTolerated;
  options.max_unknown_fraction = settings.max_unknown_fraction;
  return options;
}

}  // namespace

Drive::Drive(PosedCase posed, const PlanSettings& settings)
    : posed_(std::move(posed)),
      errand_(ErrandOf(*posed_.place, settings)),
      navigator_(errand_, NavigatorOptionsOf(settings)),
      path_(posed_.place->crossing.now, errand_.start_W) {
  Append(posed_.place->crossing.now);
}

void Drive::Append(Time time) {
  driven_.push_back({time, errand_.carrier.LinkPose(path_.At(time))});
}

void Drive::GoOnTo(Time time) {
  if (Over()) return;
  const auto go_on = [&](Time until) {
    for (const TimedPath::Knot& knot : path_.knots()) {
      if (knot.time > driven_.back().time && knot.time < until) Append(knot.time);
    }
    if (until > driven_.back().time) Append(until);
  };
  if (decided_ && decided_->path.knots().front().time <= time) {
    go_on(decided_->path.knots().front().time);
    path_ = std::exchange(decided_, std::nullopt)->path;
  }
  go_on(time);
}

void Drive::Step(ScenePtr scene) {
  const Time now = scene->stamp;
  GoOnTo(now);
  if (Over()) return;
  const auto started = std::chrono::steady_clock::now();
  const Time then = now + kTakesEffectAfter;
  const bool in_turn = log_.scans++ % kScansPerDecision == 0;
  if (!in_turn && navigator_.StillGood(scene, {then, path_.At(then)})) return;
  decided_ = navigator_.Decide(std::move(scene), {then, path_.At(then)});
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - started;
  log_.slowest_decision_s = std::max(log_.slowest_decision_s, took.count());
  ++log_.decisions;
  log_.plans += decided_->choice == Choice::kPlanned;
  log_.evasions += decided_->choice == Choice::kEvaded;
}

bool Drive::Arrived() const {
  return (driven_.back().T_W_L.translation.head<2>() - errand_.goal_W).norm() < kArrivedM;
}

bool Drive::Over() const {
  const Crossing& crossing = posed_.place->crossing;
  return Arrived() || driven_.back().time >= crossing.now + crossing.time_limit;
}

CaseResult Drive::Result(const Truth& truth) const {
  CaseResult result = posed_.result;
  result.drive = log_;
  result.drive->arrived = Arrived();
  result.drive->cut_off = !Over();
  result.plan = Plan{.planner = "SafeInterval", .path = driven_};
  result.verdict = Judge(truth, *result.crossing, driven_);
  return result;
}

}  // namespace clearway::demo
