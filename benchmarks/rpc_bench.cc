// A server over gRPC on loopback: occupancy of timed points against a service that answers the same
// messages without work, one state against an empty call, and robot states. The two sides of a
// ratio take turns, so that both see the same machine.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <thread>
#include <utility>
#include <vector>

#include "clearway/client/remote_checker.h"
#include "clearway/client/scene_client.h"
#include "drive_server.h"
#include "rpc_calls.h"
#include "summary.h"

namespace clearway::bench {
namespace {

constexpr std::size_t kPoints = 10'000, kStates = 1'000;

struct Setting {
  explicit Setting(const Effort& effort)
      : served(effort.quick ? 5 : 20),
        turn(std::chrono::milliseconds(effort.quick ? 500 : 2000)),
        callers(static_cast<int>(std::max(1u, std::thread::hardware_concurrency()))) {}

  DriveServer served;
  EchoServer echo;
  Duration turn;  // of one side
  int callers;
};

// Runs the callers; a failure ends the benchmark.
LoadReport Measure(benchmark::State& state, const std::vector<LoadCall>& callers,
                   Duration duration) {
  auto report = RunLoad(callers, duration);
  if (report.ok()) return *std::move(report);
  state.SkipWithError(report.status().ToString().c_str());
  return {};
}

// Whether the answers on the wire are those of the scene in the server, asked point by point.
bool AnswersAreTheScenes(Setting& setting, const QuestionSpace& space) {
  RandomQuestions questions(space, 1);
  const std::vector<Eigen::Vector3f> points_W = questions.Points(kPoints);
  const std::vector<Time> times = questions.Times(kPoints);
  const auto answers =
      SceneClient(*Connection::Open(setting.served.address())).OccupancyOfPoints(points_W, times);
  if (!answers.ok()) return false;
  const ScenePtr scene = setting.served.Newest();
  for (std::size_t i = 0; i < kPoints; ++i) {
    const PointOccupancy expected = SceneAtTime(*scene, times[i]).At(points_W[i].cast<double>());
    const PointOccupancy& answer = answers->points[i];
    if (answer.status != expected.status || answer.object != expected.object) return false;
  }
  return true;
}

// As many callers as processors, each with batches of its own.
void Points(benchmark::State& state, Setting& setting, Duration step) {
  QuestionSpace space = setting.served.Space();
  space.step = step;
  if (!AnswersAreTheScenes(setting, space)) return state.SkipWithError("the answers differ");
  std::vector<LoadCall> points, echoes;
  for (int i = 0; i < setting.callers; ++i) {
    points.push_back(PointsCall(setting.served.address(), space, kPoints, i));
    echoes.push_back(PointsCall(setting.echo.address(), space, kPoints, i));
  }
  for (auto _ : state) {
    const double echo = Measure(state, echoes, setting.turn).CallsPerSecond();
    const double ours = Measure(state, points, setting.turn).CallsPerSecond();
    const std::string name = step == Duration(0) ? "rpc_points_any_time" : "rpc_points";
    state.counters[name + "_vs_echo_x"] = ours / echo;
    state.counters[name + "_per_s"] = kPoints * ours;
  }
}

// A box-shaped robot at random near the ground.
LoadCall StatesCall(Setting& setting, std::size_t states, std::uint64_t seed) {
  auto connection = Connection::Open(setting.served.address());
  if (!connection.ok()) return [status = connection.status()] { return status; };
  auto checker = RemoteChecker::Pin(*connection, Robot::SingleShape("robot", Box{{1.0, 0.7, 1.0}}));
  if (!checker.ok()) return [status = checker.status()] { return status; };
  CheckOptions options;
  options.unknown = UnknownPolicy::kFree;
  std::vector<StateBatch> batches;
  RandomQuestions questions(setting.served.GroundSpace(), seed);
  for (int i = 0; i < 8; ++i) batches.push_back(questions.States(states, {Pose{}}));
  return [checker = std::shared_ptr<RemoteChecker>(*std::move(checker)), options, batches,
          next = std::size_t{0}]() mutable {
    return checker->Check(batches[next++ % batches.size()], options).status();
  };
}

double Median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

// In short turns, each with a connection of its own: the same call takes a quarter longer on one
// connection than on the next.
void OneState(benchmark::State& state, Setting& setting) {
  constexpr int kTurns = 9;
  const Duration turn = setting.turn / kTurns;
  const auto median_ms = [&](LoadCall caller) {
    return Measure(state, {std::move(caller)}, turn).LatencyMs(0.5);
  };
  for (auto _ : state) {
    std::vector<double> empty_ms, ours_ms;
    for (int i = 0; i < kTurns; ++i) {
      empty_ms.push_back(median_ms(EmptyCall(setting.echo.address())));
      ours_ms.push_back(median_ms(StatesCall(setting, 1, i)));
    }
    state.counters["rpc_unary_vs_empty_x"] = Median(ours_ms) / Median(empty_ms);
    state.counters["rpc_unary_ms"] = Median(ours_ms);
  }
}

void States(benchmark::State& state, Setting& setting) {
  std::vector<LoadCall> callers;
  for (int i = 0; i < setting.callers; ++i) {
    callers.push_back(StatesCall(setting, kStates, i));
  }
  for (auto _ : state) {
    state.counters["rpc_states_per_s"] =
        kStates * Measure(state, callers, setting.turn).CallsPerSecond();
  }
}

void Register(const Effort& effort) {
  const auto setting = std::make_shared<Setting>(effort);
  const auto add = [&](const char* name, auto run) {
    Add(name, effort, [=](benchmark::State& state) { run(state, *setting); });
  };
  using State = benchmark::State;
  add("points", [](State& s, Setting& all) { Points(s, all, std::chrono::milliseconds(100)); });
  add("points_any_time", [](State& s, Setting& all) { Points(s, all, Duration(0)); });
  add("one_state", [](State& s, Setting& all) { OneState(s, all); });
  add("states", [](State& s, Setting& all) { States(s, all); });
}

}  // namespace
}  // namespace clearway::bench

int main(int argc, char** argv) {
  return clearway::bench::Main(argc, argv, clearway::bench::Register, {});
}
