#include "demo/case.h"

#include <chrono>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "clearway/client/remote_checker.h"
#include "clearway/report/top_view.h"

namespace clearway::demo {
namespace {

std::vector<ObjectId> IdsOf(const SceneSnapshot& scene) {
  std::vector<ObjectId> ids;
  for (const auto& object : scene.objects) ids.push_back(object->id);
  return ids;
}

// A place that has been looked at: a case, or the reason why it is none.
struct Place {
  double margin_m = 0;
  Crossing crossing;
  GroundPlane ground;
  std::vector<TimedPose> straight_way;
  Verdict straight;
  std::shared_ptr<const StateChecker> checker;
};

// What the straight way has to touch, for a place to pose the problem.
enum class Obstacle { kBlocker, kAnythingThatMoves };

// FAILED_PRECONDITION or NOT_FOUND: the place is void.
absl::StatusOr<Place> Examine(const std::shared_ptr<Connection>& connection,
                              const SceneSnapshot& scene, const Candidate& candidate,
                              Obstacle obstacle, double margin_m, const Truth& truth,
                              PlanSettings settings) {
  const auto crossing = candidate();
  if (!crossing.ok()) return crossing.status();
  constexpr double kGroundRadiusM = 4;
  const auto ground = FitGround(scene.static_map_W, *crossing, kGroundRadiusM);
  if (!ground.ok()) return ground.status();
  Place place{margin_m, *crossing,
              *ground,  StraightWay(*crossing, *ground, settings.ground_clearance_m),
              {},       nullptr};
  place.straight = Judge(truth, *crossing, place.straight_way);
  if (!place.straight.contact || place.straight.touched == kStaticLabel) {
    return absl::FailedPreconditionError("the straight way touches nothing that moves");
  }
  if (obstacle == Obstacle::kBlocker && place.straight.touched != crossing->blocker) {
    return absl::FailedPreconditionError(
        absl::StrCat("the straight way touches object ", place.straight.touched));
  }
  auto checker = RemoteChecker::Pin(connection, crossing->RobotModel(margin_m),
                                    {.min_version = scene.version});
  if (!checker.ok()) return checker.status();
  place.checker = *std::move(checker);
  settings.ignored_objects = IdsOf(scene);
  if (auto room = CheckRoom(place.checker, *crossing, *ground, settings); !room.ok()) return room;
  return place;
}

bool IsVoid(const absl::Status& status) {
  return absl::IsFailedPrecondition(status) || absl::IsNotFound(status);
}

// The nearest place that poses the problem, if need be before another moving object than the one
// whose way is crossed. NOT_FOUND if there is none; `void_places` gets the reasons.
absl::StatusOr<Place> ChoosePlace(const std::shared_ptr<Connection>& connection,
                                  const SceneSnapshot& scene, const Problem& problem,
                                  const Truth& truth, const PlanSettings& settings,
                                  std::vector<std::string>& void_places) {
  for (const Obstacle obstacle : {Obstacle::kBlocker, Obstacle::kAnythingThatMoves}) {
    for (const double margin_m : settings.margins_m) {
      void_places.clear();
      for (const Candidate& candidate : problem.candidates) {
        auto place = Examine(connection, scene, candidate, obstacle, margin_m, truth, settings);
        if (place.ok() || !IsVoid(place.status())) return place;
        void_places.emplace_back(place.status().message());
      }
    }
  }
  return absl::NotFoundError("void: no place along the object's path poses the problem");
}

std::string NameOf(const Sequence& sequence, ObjectId id) {
  const auto name = sequence.object_names.find(id);
  if (name != sequence.object_names.end()) return name->second;
  return id == kStaticLabel ? "the static world" : absl::StrCat("object ", id);
}

}  // namespace

double CaseResult::ArrivalSeconds() const {
  return plan ? ToSeconds(plan->path.back().time - crossing->now) : 0;
}

bool CaseResult::Passed() const {
  return plan && !verdict.contact && ArrivalSeconds() <= ToSeconds(crossing->time_limit);
}

bool CaseResult::KnownToTheEnd() const {
  return plan && verdict.checked_until >= plan->path.back().time;
}

std::string CaseResult::Conclusion() const {
  if (!plan) return problem;
  if (verdict.contact) {
    return absl::StrFormat("touches object %d after %.2f s", verdict.touched,
                           ToSeconds(*verdict.contact - crossing->now));
  }
  std::string text = absl::StrFormat("touches nothing, arrives after %.1f s", ArrivalSeconds());
  if (!KnownToTheEnd()) {
    absl::StrAppendFormat(&text, " (recorded for %.1f s of them)",
                          ToSeconds(verdict.checked_until - crossing->now));
  }
  return text;
}

absl::StatusOr<CaseResult> RunCase(std::shared_ptr<Connection> connection,
                                   const SceneSnapshot& scene, const Problem& problem,
                                   const Truth& truth, const PlanSettings& settings) {
  CaseResult result;
  result.name = problem.name;
  auto place = ChoosePlace(connection, scene, problem, truth, settings, result.void_places);
  if (absl::IsNotFound(place.status())) {
    result.problem = std::string(place.status().message());
    return result;
  }
  if (!place.ok()) return place.status();
  result.margin_m = place->margin_m;
  result.crossing = place->crossing;
  result.straight = place->straight;
  result.straight_way = place->straight_way;
  const auto started = std::chrono::steady_clock::now();
  auto plan = PlanCrossing(place->checker, place->crossing, place->ground, settings);
  result.planning_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  if (absl::IsNotFound(plan.status())) {
    result.problem = std::string(plan.status().message());
    return result;
  }
  if (!plan.ok()) return plan.status();
  result.plan = *std::move(plan);
  result.verdict = Judge(truth, place->crossing, result.plan->path);
  return result;
}

absl::Status DrawCase(const SceneSnapshot& scene, const CaseResult& result,
                      const Sequence& sequence, const std::string& file) {
  TopViewOptions options;
  options.title = absl::StrCat(sequence.name, ": ", result.name);
  options.names = sequence.object_names;
  if (result.crossing) {
    const Crossing& crossing = *result.crossing;
    const Eigen::Vector2d half = 0.5 * crossing.robot_size_m.head<2>();
    options.footprint_L = {half, {-half.x(), half.y()}, -half, {half.x(), -half.y()}};
    options.paths.push_back(
        {absl::StrFormat("straight at %g m/s", crossing.max_speed_mps), result.straight_way, true});
    options.subtitle = absl::StrFormat("Straight ahead it would touch %s after %.1f s. ",
                                       NameOf(sequence, result.straight.touched),
                                       ToSeconds(*result.straight.contact - crossing.now));
  }
  Duration last = std::chrono::seconds(4);
  if (result.plan) {
    options.paths.push_back(
        {absl::StrCat("plan (", result.plan->planner, ")"), result.plan->path, false});
    last = result.plan->path.back().time - result.crossing->now;
    absl::StrAppendFormat(&options.subtitle, "The plan %s; closest %.2f m, unknown space %.1f %%.",
                          result.Conclusion(), result.verdict.closest_m,
                          100 * result.plan->unknown_fraction);
  } else {
    absl::StrAppend(&options.subtitle, result.problem);
  }
  for (Duration after = std::chrono::seconds(1); after <= last; after += std::chrono::seconds(1)) {
    options.predicted_after.push_back(after);
    if (scene.stamp + after > sequence.truth.end) continue;
    for (TopViewOutline& outline : OutlinesAt(sequence.truth, scene.stamp + after)) {
      options.recorded.push_back(std::move(outline));
    }
  }
  return WriteTopView(scene, options, file);
}

}  // namespace clearway::demo
