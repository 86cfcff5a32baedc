// clearway bench: how many questions a server answers, and how fast.
#include <memory>

#include "absl/strings/str_cat.h"
#include "clearway/client/remote_checker.h"
#include "clearway/client/scene_client.h"
#include "cli/bench_output.h"
#include "cli/check_flags.h"
#include "cli/commands.h"
#include "cli/message.h"
#include "cli/values.h"
#include "load/questions.h"

namespace clearway::cli {
namespace {

constexpr char kExamples[] =
    "  clearway bench --points 10000 --connections 4 --seconds 10\n"
    "  clearway bench --states 1000 --robot box:1,0.7,1 --bounds 0,-10,0.5,40,10,1.5 --json";

constexpr std::size_t kBatches = 8;  // that each connection asks in turn

struct Flags {
  ServerFlags server;
  std::optional<std::size_t> points, states;
  std::string robot = "box:1,0.7,1";
  UnknownArgument unknown;
  std::optional<Aabb> bounds;
  double ahead_s = 2;
  double time_step_s = 0.1;
  int connections = 1;
  double seconds = 5;
  std::uint64_t seed = 1;
  bool json = false;
};

absl::StatusOr<QuestionSpace> SpaceOf(const Flags& flags, const ServerStatus& scene) {
  QuestionSpace space;
  space.box_W = flags.bounds.value_or(scene.static_box_W);
  if (space.box_W.Empty()) {
    return absl::FailedPreconditionError("the scene is empty: replay something, or give --bounds");
  }
  space.from = scene.stamp;
  space.span = FromSeconds(flags.ahead_s);
  space.step = FromSeconds(flags.time_step_s);
  return space;
}

absl::Status AtMost(const std::string& items, std::size_t batch, std::size_t limit) {
  if (batch <= limit) return absl::OkStatus();
  return absl::ResourceExhaustedError(
      absl::StrCat("--", items, " ", batch, ": the server takes at most ", limit, " at once"));
}

LoadCall PointCaller(std::shared_ptr<Connection> connection, std::size_t points,
                     RandomQuestions questions) {
  struct Batch {
    std::vector<Eigen::Vector3f> points_W;
    std::vector<Time> times;
  };
  std::vector<Batch> batches(kBatches);
  for (Batch& batch : batches) batch = {questions.Points(points), questions.Times(points)};
  const SceneClient client(std::move(connection));
  return [client, batches = std::move(batches), next = std::size_t{0}]() mutable {
    const Batch& batch = batches[next++ % kBatches];
    return client.OccupancyOfPoints(batch.points_W, batch.times).status();
  };
}

LoadCall StateCaller(std::shared_ptr<RemoteChecker> checker, const std::vector<Pose>& T_R_L,
                     std::size_t states, const CheckOptions& options, RandomQuestions questions) {
  std::vector<StateBatch> batches(kBatches);
  for (StateBatch& batch : batches) batch = questions.States(states, T_R_L);
  return [checker = std::move(checker), options, batches = std::move(batches),
          next = std::size_t{0}]() mutable {
    return checker->Check(batches[next++ % kBatches], options).status();
  };
}

absl::StatusOr<LoadCall> MakeCaller(const Flags& flags, std::shared_ptr<Connection> connection,
                                    const RandomQuestions& questions, std::size_t batch) {
  if (!flags.states) {
    const std::uint64_t limit = connection->server().limits.max_points_per_query;
    if (absl::Status status = AtMost("points", batch, limit); !status.ok()) return status;
    return PointCaller(std::move(connection), batch, questions);
  }
  auto file = LoadRobot(flags.robot);
  if (!file.ok()) return file.status();
  CheckOptions options;
  options.unknown = flags.unknown.policy;
  options.max_unknown_fraction = flags.unknown.max_fraction;
  auto checker = RemoteChecker::Pin(std::move(connection), std::move(file->robot));
  if (!checker.ok()) return checker.status();
  const std::size_t limit = (*checker)->states_per_request();
  if (absl::Status status = AtMost("states", batch, limit); !status.ok()) return status;
  return StateCaller(*std::move(checker), file->T_R_L, batch, options, questions);
}

absl::Status Run(const Flags& flags, const Terminal& terminal) {
  if (flags.points && flags.states) return UsageError("give --points or --states, not both");
  BenchOutput output;
  output.items = flags.states ? "states" : "points";
  output.batch = flags.states ? *flags.states : flags.points.value_or(1000);
  std::vector<LoadCall> callers;
  for (int i = 0; i < flags.connections; ++i) {
    auto connection = Connect(flags.server);
    if (!connection.ok()) return connection.status();
    const auto scene = SceneClient(*connection).GetStatus();
    if (!scene.ok()) return scene.status();
    const auto space = SpaceOf(flags, *scene);
    if (!space.ok()) return space.status();
    output.box_W = space->box_W;
    auto caller = MakeCaller(flags, *std::move(connection), RandomQuestions(*space, flags.seed + i),
                             output.batch);
    if (!caller.ok()) return caller.status();
    callers.push_back(*std::move(caller));
  }
  output.connections = callers.size();
  auto report = RunLoad(callers, FromSeconds(flags.seconds));
  if (absl::IsResourceExhausted(report.status())) {
    return InContext(absl::StrCat("--", output.items, " ", output.batch), report.status());
  }
  if (!report.ok()) return report.status();
  output.report = *std::move(report);
  flags.json ? PrintBenchJson(terminal.out, output) : PrintBenchText(terminal.out, output);
  return absl::OkStatus();
}

void AddQuestionFlags(CLI::App* command, Flags* flags) {
  const auto batch = CLI::Range(std::size_t{1}, std::size_t{10'000'000}).description("");
  command
      ->add_option("--points", flags->points,
                   "Ask for occupancy, this many points a batch\n"
                   "(default: 1000)")
      ->check(batch);
  CLI::Option* const states =
      command->add_option("--states", flags->states, "Instead check this many robot states a batch")
          ->check(batch);
  command->add_option("--robot", flags->robot, "A robot file or one shape, as of 'clearway check'")
      ->capture_default_str()
      ->needs(states);
  AddParsed(command, "--unknown", &flags->unknown, ParseUnknown,
            "How unknown space counts for states, as of 'clearway\ncheck' (default: blocked)")
      ->type_name("POLICY")
      ->needs(states);
  AddParsed(command, "--bounds", &flags->bounds, ParseBox,
            "Ask within the box of these two opposite corners\n(default: the scene's)")
      ->type_name("X,Y,Z,X,Y,Z");
  command
      ->add_option("--ahead", flags->ahead_s,
                   "Times go from the newest stamp to this many "
                   "seconds\nlater")
      ->check(Between(0, 1e6))
      ->capture_default_str();
  command
      ->add_option("--time-step", flags->time_step_s,
                   "Times come in steps of this many seconds; 0: any time")
      ->check(Between(0, 1e6))
      ->capture_default_str();
  command->add_option("--seed", flags->seed, "Of the random questions")
      ->check(NotNegative())
      ->capture_default_str();
}

}  // namespace

void AddBench(Cli& cli) {
  auto flags = std::make_shared<Flags>();
  CLI::App* command = AddCommand(cli, "bench", "Load a server with random questions", kExamples,
                                 [flags, &cli] { return Run(*flags, cli.terminal); });
  AddQuestionFlags(command, flags.get());
  command
      ->add_option("--connections", flags->connections,
                   "Ask over this many at once, each "
                   "waiting for\nits answer")
      ->check(CLI::Range(1, 1000).description(""))
      ->capture_default_str();
  command->add_option("--seconds", flags->seconds, "Go on for so long")
      ->check(Between(0.001, 1e6))
      ->capture_default_str();
  command->add_flag("--json", flags->json, "Print JSON");
  AddServerFlags(command, &flags->server);
}

}  // namespace clearway::cli
