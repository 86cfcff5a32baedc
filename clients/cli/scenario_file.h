// Planning problems as JSON files; the format is in docs/formats.md, "Scenarios".
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/collision/plan_task.h"
#include "clearway/io/left_out.h"
#include "clearway/scene/given_object.h"

namespace clearway::cli {

// All times count from Time(): see Delay. A plain value.
struct Scenario {
  std::string name;
  Robot robot;
  PlanTask task;
  bool starts_at_once = true;             // when is not stated
  std::vector<GivenObject> objects;       // that the scene gets for it
  std::map<ObjectId, std::string> names;  // of those that the file describes
  std::string note;                       // for people, if there is something to be said
  LeftOut left_out;                       // of the recording that it names
  bool solvable = true;
  std::optional<double> optimum_s;  // no plan arrives earlier, in seconds after the start
};

// All times `by` later.
void Delay(Duration by, std::vector<GivenObject>& objects);
void Delay(Duration by, Scenario& scenario);

// INVALID_ARGUMENT names the field, as in "doors.json: objects[2].future[0].t_s: missing";
// NOT_FOUND if there is no such file. Files that it names are looked for next to it.
absl::StatusOr<Scenario> ParseScenario(const std::filesystem::path& name, const std::string& text);
absl::StatusOr<Scenario> LoadScenario(const std::filesystem::path& file);

// {"objects": [...]} alone, as they stand in a scenario.
absl::StatusOr<std::vector<GivenObject>> LoadObjects(const std::filesystem::path& file);

}  // namespace clearway::cli
