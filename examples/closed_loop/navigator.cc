#include "closed_loop/navigator.h"

#include <algorithm>

#include "clearway/collision/scene_checker.h"
#include "closed_loop/evasion.h"
#include "closed_loop/path_proof.h"
#include "closed_loop/way_to_goal.h"

namespace clearway::closed_loop {
namespace {

// A new way has to arrive so much earlier to be taken instead of one that is still good.
constexpr double kWorthwhile_s = 0.2;
constexpr double kAtGoal_m = 0.05;
// Where nothing is free for so long with all margins, fewer are tried.
constexpr Duration kShort = std::chrono::seconds(1);

}  // namespace

Navigator::Navigator(const Course& course, const NavigatorOptions& options)
    : course_(course),
      options_(options),
      robot_(std::make_shared<const PreparedRobot>(MakeRobot())) {}

CheckOptions Navigator::Checks(double inflation_mps) const {
  CheckOptions checks;
  checks.unknown = options_.unknown;
  checks.max_unknown_fraction = options_.max_unknown_fraction;
  checks.padding_m = options_.padding_m;
  checks.inflation_mps = inflation_mps;
  checks.inflate_moving_only = false;
  return checks;
}

// Free up to the time returned; none if that is not enough to follow it.
std::optional<Time> Navigator::Proved(const Way& way, Time from) const {
  const Time until = std::max(from + options_.proved_for, way.to_goal ? way.path.end_time() : from);
  const CheckOptions checks = Checks(options_.inflations_mps[way.level]);
  if (FreeUntil(*checker_, {way.path}, from, until, checks)[0] < until) return std::nullopt;
  return until;
}

std::optional<Navigator::Way> Navigator::Plan(const TimedPath::Knot& start) const {
  const WayQuestion question{.start = start, .goal_W = course_.goal_W, .area_W = course_.area_W};
  const bool there = (start.p_W - course_.goal_W).norm() < kAtGoal_m;
  for (std::size_t level = 0; level < options_.inflations_mps.size(); ++level) {
    const auto path = there ? TimedPath(start.time, start.p_W)
                            : FindWay(checker_, question, Checks(options_.inflations_mps[level]));
    if (!path) continue;
    const Way way{*path, level, true};
    if (Proved(way, start.time)) return way;
  }
  return std::nullopt;
}

Decision Navigator::Evade(const TimedPath::Knot& start) {
  const Time until = start.time + options_.proved_for;
  CheckOptions checks = Checks(options_.inflations_mps[0]);
  const auto find = [&] {
    return FindEvasion(*checker_, start, course_.goal_W, course_.area_W, until, checks);
  };
  Evasion evasion = find();
  if (evasion.free_until < start.time + kShort) {
    checks.inflation_mps = 0;
    evasion = find();
  }
  if (evasion.free_until < start.time + kShort) {
    checks.padding_m = 0;
    evasion = find();
  }
  way_ = Way{evasion.path, 0, false};
  return {evasion.path, Choice::kEvaded, checks.inflation_mps, evasion.free_until};
}

Decision Navigator::Decide(ScenePtr scene, const TimedPath::Knot& start) {
  checker_ = std::make_shared<SceneChecker>(std::move(scene), robot_);
  const std::optional<Time> kept = way_ ? Proved(*way_, start.time) : std::nullopt;
  const bool due = !planned_at_ || start.time - *planned_at_ >= options_.replan_every;
  if (kept && !due) {
    return {way_->path, Choice::kKept, options_.inflations_mps[way_->level], *kept};
  }
  planned_at_ = start.time;
  if (const std::optional<Way> planned = Plan(start)) {
    const bool earlier =
        !way_ || planned->path.end_time() + FromSeconds(kWorthwhile_s) < way_->path.end_time();
    const bool better = !kept || !way_->to_goal || planned->level < way_->level ||
                        (planned->level == way_->level && earlier);
    if (better) {
      way_ = planned;
      return {way_->path, Choice::kPlanned, options_.inflations_mps[way_->level],
              *Proved(*way_, start.time)};
    }
  }
  if (kept && way_->to_goal) {
    return {way_->path, Choice::kKept, options_.inflations_mps[way_->level], *kept};
  }
  return Evade(start);
}

}  // namespace clearway::closed_loop
