// clearway plan: a way around moving objects, as early as can be.
#include <algorithm>
#include <chrono>
#include <memory>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "clearway/client/error_details.h"
#include "clearway/client/remote_planner.h"
#include "clearway/client/scene_client.h"
#include "clearway/report/table.h"
#include "cli/borrowed_objects.h"
#include "cli/commands.h"
#include "cli/json.h"
#include "cli/left_out_text.h"
#include "cli/mesh_notes.h"
#include "cli/message.h"
#include "cli/scenario_errors.h"
#include "cli/scenario_file.h"
#include "cli/server_flags.h"
#include "cli/text.h"

namespace clearway::cli {
namespace {

constexpr char kExamples[] =
    "  clearway plan examples/scenarios/sliding_doors.json\n"
    "  clearway plan task.json --budget 5 --json | jq '.path[] | [.t_s, .configuration]'\n"
    "  clearway plan task.json --first        the first plan that is found\n"
    "\n"
    "The file says what moves from where to where (docs/formats.md, \"Scenarios\"). Objects that "
    "it\n"
    "holds are in the server's scene while the plan is made; a file without any plans in the "
    "scene\n"
    "as it is. Its times count from the scene's newest stamp; without start_s the robot starts at\n"
    "the newest stamp when the plan is made.";

struct Flags {
  ServerFlags server;
  std::string file;
  double budget_s = 1;
  bool first = false;
  bool json = false;
};

struct Found {
  Plan plan;
  double after_s;  // of thinking
};

double ArrivalOf(const Plan& plan, const PlanTask& task) {
  return ToSeconds(plan.times.back() - task.start_time);
}

std::string NameOf(ObjectId id, const Scenario& scenario) {
  const auto name = scenario.names.find(id);
  const std::string object = absl::StrCat("object ", id);
  return name == scenario.names.end() ? object : absl::StrCat(object, ", ", name->second);
}

std::string WhatBlocks(const StateAnswer& blocker, const Scenario& scenario) {
  if (blocker.status == SpaceStatus::kBeyondHorizon) {
    return absl::StrCat(NameOf(blocker.object, scenario),
                        ", which may be anywhere there then: it is beyond the server's horizon of "
                        "predictions (--scene-horizon-s)");
  }
  if (blocker.object != kStaticLabel) return NameOf(blocker.object, scenario);
  switch (blocker.status) {
    case SpaceStatus::kOutOfBounds:
      return "the scene's bounds";
    case SpaceStatus::kUnknownSpace:
      return "unknown space";
    default:
      return "the static map or a keep-out box";
  }
}

absl::Status StatusOf(const PlanOutcome& outcome, const Scenario& scenario, const Flags& flags) {
  switch (outcome.status) {
    case PlanStatus::kFound:
      return absl::OkStatus();
    case PlanStatus::kStartBlocked:
      return absl::FailedPreconditionError(
          absl::StrCat("no plan: the start is blocked by ", WhatBlocks(outcome.blocker, scenario)));
    case PlanStatus::kGoalBlocked:
      return absl::FailedPreconditionError(
          absl::StrCat("no plan: the goal was never seen free, first of all blocked by ",
                       WhatBlocks(outcome.blocker, scenario)));
    case PlanStatus::kNoTimeToSpare:
      return absl::FailedPreconditionError(
          "no plan: the straight way is not free, and none was found that the time limit allows");
    default:
      return absl::DeadlineExceededError(absl::StrCat("no plan found within ", flags.budget_s,
                                                      " s (--budget); there may be none"));
  }
}

const char* WordFor(PlanStatus status) {
  switch (status) {
    case PlanStatus::kFound:
      return "found";
    case PlanStatus::kStartBlocked:
      return "start_blocked";
    case PlanStatus::kGoalBlocked:
      return "goal_blocked";
    case PlanStatus::kNoTimeToSpare:
      return "no_time_to_spare";
    default:
      return "not_found";
  }
}

std::string TextOf(const std::vector<double>& configuration) {
  std::string text;
  for (const double value : configuration) {
    absl::StrAppend(&text, text.empty() ? "" : "  ", absl::StrFormat("%.3f", value));
  }
  return text;
}

void PrintText(std::ostream& out, const Plan& plan, const PlanTask& task) {
  Table table({"after s", "configuration", ""});
  for (std::size_t i = 0; i < plan.times.size(); ++i) {
    const bool waits =
        i + 1 < plan.times.size() && plan.configurations[i] == plan.configurations[i + 1];
    table.AddRow({absl::StrFormat("%.3f", ToSeconds(plan.times[i] - task.start_time)),
                  TextOf(plan.configurations[i]), waits ? "waits" : ""});
  }
  out << table.ToString();
}

void PrintJson(std::ostream& out, const std::vector<Found>& plans, const PlanOutcome& outcome,
               const Scenario& scenario) {
  const PlanTask& task = scenario.task;
  Json json = ToJson(Versioned{outcome.version, outcome.stamp});
  json["horizon_s"] = ToSeconds(outcome.horizon);
  json["inflation_mps"] = outcome.inflation_mps;
  json["bound_multiple"] = outcome.bound_multiple;
  json["found"] = !plans.empty();
  json["status"] = WordFor(outcome.status);
  json["plans"] = Json::array();
  for (const Found& found : plans) {
    json["plans"].push_back(
        {{"planning_s", found.after_s}, {"arrival_s", ArrivalOf(found.plan, task)}});
  }
  json["path"] = Json::array();
  for (std::size_t i = 0; !plans.empty() && i < plans.back().plan.times.size(); ++i) {
    const Plan& plan = plans.back().plan;
    json["path"].push_back({{"t_s", ToSeconds(plan.times[i] - task.start_time)},
                            {"stamp_ns", ToNanoseconds(plan.times[i])},
                            {"configuration", plan.configurations[i]}});
  }
  json["left_out"] = ToJson(scenario.left_out);
  Print(out, json);
}

absl::Status StartPassed(const SceneClient& client, Time start) {
  const auto status = client.GetStatus();
  if (!status.ok()) return status.status();
  return absl::InvalidArgumentError(absl::StrCat(
      "start_s: the start is at ", Seconds(start), " of the scene's time, and the scene is of ",
      Seconds(status->stamp), " already; give a later start_s, or none to start at once"));
}

// A scenario that starts at once does so when the scene is that old: frames may have come since its
// objects were added, and may come while this is asked.
absl::StatusOr<PlanOutcome> PlanWith(const RemotePlanner& planner, const SceneClient& client,
                                     Scenario& scenario, Duration budget, std::uint64_t version,
                                     const std::function<bool(const Plan&)>& found) {
  constexpr int kTries = 10;
  for (int tries = 1;; ++tries) {
    if (scenario.starts_at_once) {
      const auto status = client.GetStatus();
      if (!status.ok()) return status.status();
      scenario.task.start_time = std::max(scenario.task.start_time, status->stamp);
    }
    auto outcome = planner.Plan(scenario.task, budget, found, {version, ""});
    const bool too_late = absl::IsInvalidArgument(outcome.status()) &&
                          DetailsOf(outcome.status()).field == "start_ns";
    if (too_late && !scenario.starts_at_once) {
      return StartPassed(client, scenario.task.start_time);
    }
    if (!too_late || tries == kTries) return outcome;
  }
}

absl::Status Run(const Flags& flags, const Terminal& terminal) {
  auto scenario = LoadScenario(flags.file);
  if (!scenario.ok()) return scenario.status();
  const SignalsBlocked blocked;
  const auto connection = Connect(flags.server);
  if (!connection.ok()) return connection.status();
  const double most_s = (*connection)->server().limits.max_planning_s;
  if (flags.budget_s > most_s) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "--budget is %.10g s; the server's limit (limits.max_planning_s) is %.10g s",
        flags.budget_s, most_s));
  }
  if (!scenario->note.empty()) terminal.err << "note: " << scenario->note << "\n";
  if (!scenario->left_out.Empty()) terminal.err << "warning: " << LeftOutText(scenario->left_out);
  PrintRobotNotes(scenario->robot, terminal.err);
  PrintObjectNotes(scenario->objects, terminal.err);
  const SceneClient client(*connection);
  const auto status = client.GetStatus();
  if (!status.ok()) return status.status();
  Delay(status->stamp - Time(), *scenario);
  BorrowedObjects borrowed(client);
  const auto version = borrowed.Add(scenario->objects);
  if (!version.ok()) return InScenario(flags.file, version.status());
  const auto planner = RemotePlanner::For(*connection, scenario->robot);
  if (!planner.ok()) return InScenario(flags.file, planner.status());
  std::vector<Found> plans;
  const auto begin = std::chrono::steady_clock::now();
  const auto found = [&](const Plan& plan) {
    const double after_s =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    plans.push_back({plan, after_s});
    if (!flags.json) {
      terminal.out << absl::StrFormat("%.3f s: arrives after %.3f s\n", after_s,
                                      ArrivalOf(plan, scenario->task));
    }
    return !flags.first;
  };
  const auto outcome =
      PlanWith(**planner, client, *scenario, FromSeconds(flags.budget_s), *version, found);
  if (!outcome.ok()) return InScenario(flags.file, outcome.status());
  if (flags.json) {
    PrintJson(terminal.out, plans, *outcome, *scenario);
  } else if (!plans.empty()) {
    PrintText(terminal.out, plans.back().plan, scenario->task);
  }
  return StatusOf(*outcome, *scenario, flags);
}

}  // namespace

void AddPlan(Cli& cli) {
  auto flags = std::make_shared<Flags>();
  CLI::App* command = AddCommand(cli, "plan", "Plan a way around moving objects", kExamples,
                                 [flags, &cli] { return Run(*flags, cli.terminal); });
  AddServerFlags(command, &flags->server);
  command->add_option("file", flags->file, "What to plan: a scenario file (docs/formats.md)")
      ->required();
  command
      ->add_option("--budget", flags->budget_s,
                   "Seconds to think (default: 1); at most the server's\nlimits.max_planning_s, "
                   "which is 60 unless set")
      ->check(Between(0.001, 3600));
  command->add_flag("--first", flags->first, "End with the first plan");
  command->add_flag("--json", flags->json, "Print JSON");
}

}  // namespace clearway::cli
