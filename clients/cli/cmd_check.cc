// clearway check: is a robot free at given places and times?
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "clearway/client/remote_checker.h"
#include "clearway/client/scene_client.h"
#include "cli/check_flags.h"
#include "cli/check_output.h"
#include "cli/commands.h"
#include "cli/mesh_notes.h"

namespace clearway::cli {
namespace {

constexpr char kExamples[] =
    "  clearway check --robot box:1,0.7,1 --state 12,-3,0.6,0 --state 12,-3,0.6,0,+1.5\n"
    "  clearway check --robot robot.json --states path.csv --unknown 0.1 --clearance 2\n"
    "  echo 'x,y,z,yaw,t\n"
    "  12,-3,0.6,0,+2' | clearway check --robot robot.json --states - --json";

// An id that is no object's leaves nothing out, and is hardly what was meant.
absl::Status NoteUnknownObjects(const CheckOptions& options, const SceneClient& client,
                                const SceneQuery& query, std::ostream& err) {
  std::set<ObjectId> known = {kStaticLabel};
  std::vector<std::pair<const char*, ObjectId>> named;
  for (const ObjectId id : options.ignored_objects) named.emplace_back("--ignore", id);
  for (const auto& [link, id] : options.allowed_contacts) named.emplace_back("--allow", id);
  if (named.empty()) return absl::OkStatus();
  const auto list = client.ListObjects(query);
  if (!list.ok()) return list.status();
  for (const ObjectInfo& object : list->objects) {
    known.insert(object.id);
    known.insert(object.also.begin(), object.also.end());
    for (const ObjectInfo& part : object.parts) known.insert(part.id);
  }
  for (const auto& [flag, id] : named) {
    if (known.contains(id)) continue;
    err << "note: " << flag << ": the scene has no object " << id << "\n";
  }
  return absl::OkStatus();
}

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

  if (auto status = NoteUnknownObjects(*options, SceneClient(*connection),
                                       {0, (*checker)->lease_id()}, terminal.err);
      !status.ok()) {
    return status;
  }

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
