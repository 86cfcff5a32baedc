#include "demo/case.h"

#include <chrono>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "clearway/report/top_view.h"

namespace clearway::demo {
namespace {

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
  return plan && (!drive || drive->arrived) && !verdict.contact &&
         ArrivalSeconds() <= ToSeconds(crossing->time_limit);
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
  if (drive && !drive->arrived) {
    return absl::StrFormat("touches nothing, not at the goal after %.1f s%s", ArrivalSeconds(),
                           drive->cut_off ? ", when the recording ends" : "");
  }
  std::string text = absl::StrFormat("touches nothing, arrives after %.1f s", ArrivalSeconds());
  if (!KnownToTheEnd()) {
    absl::StrAppendFormat(&text, " (recorded for %.1f s of them)",
                          ToSeconds(verdict.checked_until - crossing->now));
  }
  return text;
}

absl::StatusOr<PosedCase> PoseCase(const std::shared_ptr<Connection>& connection,
                                   const SceneSnapshot& scene, const ScenePtr& hindsight,
                                   const Problem& problem, const Truth& truth,
                                   const PlanSettings& settings) {
  PosedCase posed;
  CaseResult& result = posed.result;
  result.name = problem.name;
  auto place =
      ChoosePlace(connection, scene, hindsight, problem, truth, settings, result.void_places);
  if (absl::IsNotFound(place.status())) {
    result.problem = std::string(place.status().message());
    return posed;
  }
  if (!place.ok()) return place.status();
  result.margin_m = place->margin_m;
  result.crossing = place->crossing;
  result.straight = place->straight;
  result.straight_way = place->straight_way;
  posed.place = *std::move(place);
  return posed;
}

absl::StatusOr<CaseResult> PlanCase(PosedCase posed, const Truth& truth,
                                    const PlanSettings& settings) {
  CaseResult& result = posed.result;
  if (!posed.place) return result;
  const auto started = std::chrono::steady_clock::now();
  auto plan =
      PlanCrossing(posed.place->checker, posed.place->crossing, posed.place->ground, settings);
  result.planning_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  if (absl::IsNotFound(plan.status())) {
    result.problem = std::string(plan.status().message());
    return result;
  }
  if (!plan.ok()) return plan.status();
  result.plan = *std::move(plan);
  result.verdict = Judge(truth, posed.place->crossing, result.plan->path);
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
    absl::StrAppendFormat(&options.subtitle, "The %s %s; closest %.2f m.",
                          result.drive ? "drive" : "plan", result.Conclusion(),
                          result.verdict.closest_m);
    if (result.plan->unknown_fraction) {
      options.subtitle.pop_back();
      absl::StrAppendFormat(&options.subtitle, ", unknown space %.1f %%.",
                            100 * *result.plan->unknown_fraction);
    }
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
