// clearway check: is a robot free at given places and times?
#include <memory>

#include "absl/strings/str_cat.h"
#include "clearway/client/remote_checker.h"
#include "cli/check_flags.h"
#include "cli/check_output.h"
#include "cli/commands.h"
#include "cli/robot_notes.h"

namespace clearway::cli {
namespace {

constexpr char kExamples[] =
    "  clearway check --robot box:1,0.7,1 --state 12,-3,0.6,0 --state 12,-3,0.6,0,+1.5\n"
    "  clearway check --robot robot.json --states path.csv --unknown 0.1 --clearance 2\n"
    "  echo 'x,y,z,yaw,t\n"
    "  12,-3,0.6,0,+2' | clearway check --robot robot.json --states - --json";

absl::Status Run(const CheckFlags& flags, const Terminal& terminal) {
  auto file = LoadRobot(flags.robot);
  if (!file.ok()) return file.status();
  const auto states = StatesOf(flags, terminal.in);
  if (!states.ok()) return states.status();
  const auto options = CheckOptionsOf(flags, file->robot);
  if (!options.ok()) return options.status();
  const auto connection = Connect(flags.server);
  if (!connection.ok()) return connection.status();
  const auto checker = RemoteChecker::Pin(*connection, std::move(file->robot));
  if (!checker.ok()) return checker.status();
  PrintRobotNotes((*checker)->robot(), terminal.err);

  const StateBatch batch = BatchOf(*states, file->T_R_L, (*checker)->stamp());
  const auto reply = (*checker)->Check(batch, *options);
  if (!reply.ok()) return reply.status();
  if (reply->answers.size() != states->size()) {
    return absl::InternalError("the server answered another number of states");
  }
  std::vector<Pose> T_W_R;
  for (const TimedBase& state : *states) T_W_R.push_back(state.T_W_R);
  const CheckedStates checked{(*checker)->robot(), T_W_R, batch, *reply};
  if (flags.json) {
    PrintCheckJson(terminal.out, checked);
  } else {
    PrintCheckText(terminal.out, checked);
  }
  if (flags.require_free && NotFree(*reply) > 0) {
    return absl::FailedPreconditionError(
        absl::StrCat(NotFree(*reply), " of ", reply->answers.size(), " states not free"));
  }
  return absl::OkStatus();
}

}  // namespace

void AddCheck(Cli& cli) {
  auto flags = std::make_shared<CheckFlags>();
  CLI::App* command = AddCommand(cli, "check", "Check robot states for collisions, now or later",
                                 kExamples, [flags, &cli] { return Run(*flags, cli.terminal); });
  AddCheckFlags(command, flags.get());
}

}  // namespace clearway::cli
