#include "closed_loop/navigator.h"

#include <algorithm>

#include "clearway/collision/scene_checker.h"
#include "closed_loop/evasion.h"
#include "closed_loop/path_proof.h"
#include "closed_loop/way_to_goal.h"

namespace clearway::closed_loop {
namespace {

// A new way has to arrive so much earlier to be taken instead of one that is still good.
constexpr Duration kWorthwhile = std::chrono::milliseconds(200);
constexpr double kAtGoal_m = 0.05;
// To be free for less than that is not to be safe.
constexpr Duration kShort = std::chrono::seconds(1);

}  // namespace

Navigator::Navigator(const Errand& errand, const NavigatorOptions& options)
    : errand_(errand),
      options_(options),
      robot_(std::make_shared<const PreparedRobot>(errand.carrier.Model())) {}

CheckOptions Navigator::Checks(double inflation_mps) const {
  CheckOptions checks;
  checks.unknown = options_.unknown;
  checks.max_unknown_fraction = options_.max_unknown_fraction;
  checks.padding_m = options_.padding_m;
  checks.inflation_mps = inflation_mps;
  checks.bound_multiple = options_.bound_multiple;
  checks.inflate_moving_only = options_.inflate_moving_only;
  return checks;
}

std::optional<Time> Navigator::Proved(const Way& way, Time from) const {
  const auto free_until = [&](Time until, double inflation_mps) {
    return FreeUntil(*checker_, errand_.carrier, {way.path}, from, until, Checks(inflation_mps))[0];
  };
  const Time until = std::max(from + options_.proved_for, way.path.end_time());
  const Time surely = from + options_.surely_for;
  const bool weaker = way.inflation_mps < options_.inflation_mps;
  if (weaker && free_until(surely, options_.inflation_mps) < surely) return std::nullopt;
  if (free_until(until, way.inflation_mps) < until) return std::nullopt;
  return until;
}

std::optional<Navigator::Way> Navigator::PlanWith(double inflation_mps,
                                                  const TimedPath::Knot& start) const {
  const WayQuestion question{.start = start, .errand = errand_};
  const bool there = (start.p_W - errand_.goal_W).norm() < kAtGoal_m;
  const std::optional<TimedPath> path =
      there ? TimedPath(start.time, start.p_W) : FindWay(checker_, question, Checks(inflation_mps));
  if (!path) return std::nullopt;
  const Way way{*path, inflation_mps};
  return Proved(way, start.time) ? std::optional(way) : std::nullopt;
}

std::optional<Navigator::Way> Navigator::Plan(const TimedPath::Knot& start) const {
  std::optional<Way> way;
  if (options_.later_inflation_mps) way = PlanWith(*options_.later_inflation_mps, start);
  return way ? way : PlanWith(options_.inflation_mps, start);
}

// With fewer and fewer margins, where nothing is free for long with them.
Decision Navigator::Evade(const TimedPath::Knot& start) const {
  const CheckOptions wanted = Checks(options_.inflation_mps), not_inflated = Checks(0);
  CheckOptions bare = not_inflated;
  bare.padding_m = 0;
  Decision decision{TimedPath(start.time, start.p_W), Choice::kEvaded, start.time};
  for (const CheckOptions& checks : {wanted, not_inflated, bare}) {
    const Evasion evasion =
        FindEvasion(*checker_, start, errand_, start.time + options_.proved_for, checks);
    decision.path = evasion.path;
    decision.free_until = evasion.free_until;
    if (evasion.free_until >= start.time + kShort) break;
  }
  return decision;
}

bool Navigator::StillGood(ScenePtr scene, const TimedPath::Knot& start) {
  checker_ = std::make_shared<SceneChecker>(std::move(scene), robot_);
  return way_ && Proved(*way_, start.time);
}

Decision Navigator::Decide(ScenePtr scene, const TimedPath::Knot& start) {
  checker_ = std::make_shared<SceneChecker>(std::move(scene), robot_);
  const std::optional<Time> kept_until = way_ ? Proved(*way_, start.time) : std::nullopt;
  const std::optional<Way> planned = Plan(start);
  if (planned && (!kept_until || planned->path.end_time() + kWorthwhile < way_->path.end_time())) {
    way_ = planned;
    return {way_->path, Choice::kPlanned, *Proved(*way_, start.time)};
  }
  if (kept_until) return {way_->path, Choice::kKept, *kept_until};
  way_.reset();
  return Evade(start);
}

}  // namespace clearway::closed_loop
