#include "cli/scenario_file.h"

#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"
#include "cli/check_flags.h"
#include "cli/json_fields.h"
#include "cli/json_file.h"
#include "cli/message.h"
#include "cli/robot_file.h"
#include "cli/scenario_objects.h"
#include "cli/scenario_space.h"
#include "cli/scenario_tracks.h"

namespace clearway::cli {
namespace {

// The robot, in short, in a file of its own or in place; a body's links share one frame.
absl::StatusOr<Robot> ParseRobotField(const JsonFields& fields, const Json& value, bool arm,
                                      const std::filesystem::path& folder) {
  if (!value.contains("robot")) return fields.Error("robot", "missing");
  const Json& field = value.at("robot");
  const std::string text = field.is_string() ? field.get<std::string>() : "";
  const bool is_short = text.find(':') != std::string::npos;
  auto file = !field.is_string() ? ParseRobot(folder / fields.PathOf("robot"), field.dump())
              : is_short         ? ParseShortRobot(text)
                                 : LoadRobot((folder / text).string());
  if (!file.ok() && is_short) return fields.Error("robot", std::string(file.status().message()));
  if (!file.ok()) return file.status();
  for (std::size_t l = 0; l < file->robot.links.size(); ++l) {
    if (arm && !(file->T_R_L[l] == Pose{})) {
      return fields.Error(absl::StrCat("robot.links[", l, "].pose"),
                          "is not for arms: joints place their links");
    }
    for (LinkShape& part : file->robot.links[l].shapes) part.T_L_G = file->T_R_L[l] * part.T_L_G;
  }
  return std::move(file->robot);
}

absl::Status ParseChecks(const JsonFields& fields, CheckOptions& options) {
  if (fields.Has("unknown")) {
    const auto text = fields.Text("unknown");
    if (!text.ok()) return text.status();
    const auto unknown = ParseUnknown(*text);
    if (!unknown.ok()) return fields.Error("unknown", std::string(unknown.status().message()));
    options.unknown = unknown->policy;
    options.max_unknown_fraction = unknown->max_fraction;
  }
  for (const auto& [name, number] : {std::pair{"padding_m", &options.padding_m},
                                     {"inflation_mps", &options.inflation_mps},
                                     {"bound_multiple", &options.bound_multiple}}) {
    const auto read = fields.NumberOr(name, *number);
    if (!read.ok()) return read.status();
    *number = *read;
  }
  return absl::OkStatus();
}

absl::Status ParseTask(const JsonFields& fields, const Json& value, PlanTask& task) {
  if (!value.contains("space")) return fields.Error("space", "missing");
  auto space = ParseSpace(value.at("space"), fields.PathOf("space"));
  if (!space.ok()) return space.status();
  task.space = *std::move(space);
  if (!std::holds_alternative<ArmSpace>(task.space)) {
    const auto corners = fields.Vectors("area_m");
    if (!corners.ok()) return corners.status();
    if (corners->size() != 2) return fields.Error("area_m", "expected two corners");
    const Eigen::Vector3d &a = (*corners)[0], &b = (*corners)[1];
    task.area_W = {a.cwiseMin(b), a.cwiseMax(b)};
  }
  for (const auto& [name, number] :
       {std::pair{"max_speed_mps", &task.max_speed_mps},
        {"max_turn_radps", &task.max_turn_radps},
        {"contact_resolution_m", &task.options.contact_resolution_m}}) {
    const auto read = fields.NumberOr(name, *number);
    if (!read.ok()) return read.status();
    *number = *read;
  }
  if (!std::holds_alternative<ArmSpace>(task.space) && !fields.Has("max_speed_mps")) {
    return fields.Error("max_speed_mps", "missing");
  }
  if (Turns(task.space) && !fields.Has("max_turn_radps")) {
    return fields.Error("max_turn_radps", "missing");
  }
  if (fields.Has("start_s")) {
    const auto start = fields.Seconds("start_s");
    if (!start.ok()) return start.status();
    if (*start < Duration::zero()) {
      return fields.Error("start_s",
                          absl::StrCat("is ", NumberText(ToSeconds(*start)),
                                       " s; it must not be below 0: times count from the newest "
                                       "stamp of the scene"));
    }
    task.start_time = Time() + *start;
  }
  const auto limit_s = fields.Number("time_limit_s");
  if (!limit_s.ok()) return limit_s.status();
  if (!(*limit_s > 0 && *limit_s <= kMaxTimeLimit_s)) {
    return fields.Error("time_limit_s", absl::StrCat("is ", NumberText(*limit_s),
                                                     "; it must be above 0, and at most ",
                                                     NumberText(kMaxTimeLimit_s)));
  }
  task.time_limit = FromSeconds(*limit_s);
  for (const auto& [name, values] : {std::pair{"start", &task.start}, {"goal", &task.goal}}) {
    auto read = fields.NumberList(name);
    if (!read.ok()) return read.status();
    *values = *std::move(read);
  }
  return ParseChecks(fields, task.options.check);
}

absl::StatusOr<Scenario> ScenarioOf(const Json& json, const std::filesystem::path& folder) {
  const auto fields =
      JsonFields::Of(json, "", {"name",          "about",          "solvable",
                                "optimum_s",     "robot",          "space",
                                "area_m",        "max_speed_mps",  "max_turn_radps",
                                "start",         "goal",           "start_s",
                                "time_limit_s",  "unknown",        "padding_m",
                                "inflation_mps", "bound_multiple", "contact_resolution_m",
                                "objects",       "tracks"});
  if (!fields.ok()) return fields.status();
  Scenario scenario;
  auto name = fields->Text("name");
  if (!name.ok()) return name.status();
  scenario.name = *std::move(name);
  const auto solvable = fields->FlagOr("solvable", true);
  if (!solvable.ok()) return solvable.status();
  scenario.solvable = *solvable;
  if (fields->Has("optimum_s")) {
    const auto optimum_s = fields->Positive("optimum_s");
    if (!optimum_s.ok()) return optimum_s.status();
    scenario.optimum_s = *optimum_s;
  }
  if (auto status = ParseTask(*fields, json, scenario.task); !status.ok()) return status;
  scenario.starts_at_once = !fields->Has("start_s");
  const bool arm = std::holds_alternative<ArmSpace>(scenario.task.space);
  auto robot = ParseRobotField(*fields, json, arm, folder);
  if (!robot.ok()) return robot.status();
  scenario.robot = *std::move(robot);
  if (fields->Has("objects")) {
    const auto list = fields->List("objects");
    if (!list.ok()) return list.status();
    auto objects = ParseGivenObjects(**list, "objects", folder);
    if (!objects.ok()) return objects.status();
    scenario.objects = *std::move(objects);
    for (std::size_t i = 0; i < scenario.objects.size(); ++i) {
      if (!(**list)[i].contains("about") || !(**list)[i].at("about").is_string()) continue;
      scenario.names[scenario.objects[i].id] = (**list)[i].at("about").get<std::string>();
    }
  }
  if (fields->Has("tracks")) {
    constexpr ObjectId kFirstId = 1'000'000;
    for (std::size_t i = 0; i < scenario.objects.size(); ++i) {
      if (scenario.objects[i].id < kFirstId) continue;
      return fields->Error(
          absl::StrCat("objects[", i, "].id"),
          absl::StrCat("is ", scenario.objects[i].id, "; ids from 1000000 on are those of tracks"));
    }
    auto recorded = ParseTracks(json.at("tracks"), "tracks", kFirstId);
    if (!recorded.ok()) return recorded.status();
    scenario.objects.insert(scenario.objects.end(), recorded->objects.begin(),
                            recorded->objects.end());
    scenario.names.merge(recorded->names);
    scenario.note = std::move(recorded->note);
    scenario.left_out = std::move(recorded->left_out);
  }
  if (auto status = Validate(scenario.task, scenario.robot); !status.ok()) return status;
  return scenario;
}

}  // namespace

void Delay(Duration by, std::vector<GivenObject>& objects) {
  for (GivenObject& object : objects) {
    object.pose.stamp += by;
    for (StampedPose& pose : object.future) pose.stamp += by;
  }
}

void Delay(Duration by, Scenario& scenario) {
  scenario.task.start_time += by;
  Delay(by, scenario.objects);
}

absl::StatusOr<Scenario> ParseScenario(const std::filesystem::path& name, const std::string& text) {
  const auto json = ParseJson(text);
  if (!json.ok()) return InContext(name.string(), json.status());
  auto scenario = ScenarioOf(*json, name.parent_path());
  if (!scenario.ok()) return InContext(name.string(), scenario.status());
  return scenario;
}

absl::StatusOr<Scenario> LoadScenario(const std::filesystem::path& file) {
  const auto text = ReadTextFile(file, "scenario");
  if (!text.ok()) return text.status();
  return ParseScenario(file, *text);
}

absl::StatusOr<std::vector<GivenObject>> LoadObjects(const std::filesystem::path& file) {
  const auto text = ReadTextFile(file, "file of objects");
  if (!text.ok()) return text.status();
  const auto json = ParseJson(*text);
  if (!json.ok()) return InContext(file.string(), json.status());
  const auto fields = JsonFields::Of(*json, "", {"objects"});
  if (!fields.ok()) return InContext(file.string(), fields.status());
  const auto list = fields->List("objects");
  if (!list.ok()) return InContext(file.string(), list.status());
  auto objects = ParseGivenObjects(**list, "objects", file.parent_path());
  if (!objects.ok()) return InContext(file.string(), objects.status());
  return objects;
}

}  // namespace clearway::cli
