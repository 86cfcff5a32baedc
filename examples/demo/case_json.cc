#include "demo/case_json.h"

namespace clearway::demo {
namespace {

using Json = nlohmann::ordered_json;

Json PathOf(const std::vector<TimedPose>& path, Time now) {
  Json steps = Json::array();
  for (const TimedPose& step : path) {
    const Eigen::Vector3d& p = step.T_W_L.translation;
    const Eigen::Quaterniond& q = step.T_W_L.rotation;
    steps.push_back({{"after_s", ToSeconds(step.time - now)},
                     {"position_world_m", {p.x(), p.y(), p.z()}},
                     {"rotation_xyzw", {q.x(), q.y(), q.z(), q.w()}}});
  }
  return steps;
}

Json VerdictOf(const Verdict& verdict, Time now) {
  Json json{{"contact", verdict.contact.has_value()}};
  if (verdict.contact) {
    json["contact_after_s"] = ToSeconds(*verdict.contact - now);
    json["touched_object"] = verdict.touched;
  }
  json["closest_m"] = verdict.closest_m;
  json["checked_until_s"] = ToSeconds(verdict.checked_until - now);
  return json;
}

Json DriveOf(const DriveLog& drive) {
  return {{"arrived", drive.arrived},     {"cut_off", drive.cut_off},
          {"decisions", drive.decisions}, {"plans", drive.plans},
          {"evasions", drive.evasions},   {"slowest_decision_s", drive.slowest_decision_s}};
}

Json CrossingOf(const Crossing& crossing) {
  const Eigen::Vector3d& size = crossing.robot_size_m;
  return {{"blocker", crossing.blocker},
          {"stamp_ns", ToNanoseconds(crossing.now)},
          {"robot_size_m", {size.x(), size.y(), size.z()}},
          {"max_speed_mps", crossing.max_speed_mps},
          {"time_limit_s", ToSeconds(crossing.time_limit)},
          {"start_world_m", {crossing.start_W.x(), crossing.start_W.y()}},
          {"goal_world_m", {crossing.goal_W.x(), crossing.goal_W.y()}},
          {"shifted_along_path_m", crossing.shift_m}};
}

}  // namespace

Json JsonOf(const CaseResult& result) {
  Json json{{"name", result.name}, {"passed", result.Passed()}};
  json["conclusion"] = result.Conclusion();
  json["void_places"] = result.void_places;
  if (!result.crossing) return json;
  json["before_blocker_itself"] = result.straight.touched == result.crossing->blocker;
  const Time now = result.crossing->now;
  json["crossing"] = CrossingOf(*result.crossing);
  json["straight"] = VerdictOf(result.straight, now);
  json["planning_s"] = result.planning_s;
  if (!result.plan) return json;
  json["plan"] = {{"planner", result.plan->planner},
                  {"margin_m", result.margin_m},
                  {"inflation_mps", result.plan->inflation_mps},
                  {"scene_version", result.plan->version},
                  {"arrival_s", result.ArrivalSeconds()},
                  {"states_checked", result.plan->states_checked},
                  {"path", PathOf(result.plan->path, now)}};
  if (result.plan->unknown_fraction) {
    json["plan"]["unknown_fraction"] = *result.plan->unknown_fraction;
  }
  if (result.drive) json["drive"] = DriveOf(*result.drive);
  json["verdict"] = VerdictOf(result.verdict, now);
  return json;
}

}  // namespace clearway::demo
