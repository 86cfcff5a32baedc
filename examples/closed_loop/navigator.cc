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

Navigator::Navigator(const Course& course, const NavigatorOptions& options)
    : course_(course),
      options_(options),
      robot_(std::make_shared<const PreparedRobot>(MakeRobot())) {}

CheckOptions Navigator::Checks() const {
  CheckOptions checks;
  checks.unknown = options_.unknown;
  checks.max_unknown_fraction = options_.max_unknown_fraction;
  checks.padding_m = options_.padding_m;
  checks.inflation_mps = options_.inflation_mps;
  return checks;
}

std::optional<Time> Navigator::Proved(const TimedPath& way, Time from) const {
  const Time until = std::max(from + options_.proved_for, way.end_time());
  if (FreeUntil(*checker_, {way}, from, until, Checks())[0] < until) return std::nullopt;
  return until;
}

std::optional<TimedPath> Navigator::Plan(const TimedPath::Knot& start) const {
  const WayQuestion question{.start = start, .goal_W = course_.goal_W, .area_W = course_.area_W};
  const bool there = (start.p_W - course_.goal_W).norm() < kAtGoal_m;
  const std::optional<TimedPath> way =
      there ? TimedPath(start.time, start.p_W) : FindWay(checker_, question, Checks());
  return way && Proved(*way, start.time) ? way : std::nullopt;
}

// With fewer and fewer margins, where nothing is free for long with them.
Decision Navigator::Evade(const TimedPath::Knot& start) const {
  const CheckOptions wanted = Checks();
  CheckOptions not_inflated = wanted, bare = wanted;
  not_inflated.inflation_mps = bare.inflation_mps = 0;
  bare.padding_m = 0;
  Decision decision{TimedPath(start.time, start.p_W), Choice::kEvaded, start.time};
  for (const CheckOptions& checks : {wanted, not_inflated, bare}) {
    const Evasion evasion = FindEvasion(*checker_, start, course_.goal_W, course_.area_W,
                                        start.time + options_.proved_for, checks);
    decision.path = evasion.path;
    decision.free_until = evasion.free_until;
    if (evasion.free_until >= start.time + kShort) break;
  }
  return decision;
}

Decision Navigator::Decide(ScenePtr scene, const TimedPath::Knot& start) {
  checker_ = std::make_shared<SceneChecker>(std::move(scene), robot_);
  const std::optional<Time> kept_until = way_ ? Proved(*way_, start.time) : std::nullopt;
  const std::optional<TimedPath> planned = Plan(start);
  if (planned && (!kept_until || planned->end_time() + kWorthwhile < way_->end_time())) {
    way_ = planned;
    return {*way_, Choice::kPlanned, *Proved(*way_, start.time)};
  }
  if (kept_until) return {*way_, Choice::kKept, *kept_until};
  way_.reset();
  return Evade(start);
}

}  // namespace clearway::closed_loop
