// Runs a server under its usual load for as long as asked, and looks whether it stays well: see
// --help. The server is a process of its own.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"
#include "clearway/client/scene_client.h"
#include "clearway/client/scene_mirror.h"
#include "cli/open_source.h"
#include "clients/server_process.h"
#include "soak/clients.h"
#include "soak/memory_trend.h"

namespace clearway::soak {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kPlanners = 16, kWatchers = 4;
constexpr double kWarmUp_s = 300, kLeastJudged_s = 600;
constexpr double kMaxGrowth_bytes = 10e6;  // in an hour

struct Flags {
  double minutes = 20;
  std::string source = "sim:street";
  std::string out;
};

struct Memory {
  std::vector<MemorySample> resident, heap;
};

std::vector<std::string> ServerFlags() {
  // The answers that are remembered for repeated frames reach their limit in the warm-up: they are
  // no leak. Without its motions the bridged object would be estimated.
  return {"--limits-max-remembered-answers", "1000", "--scene-motion-from-points", "off"};
}

absl::StatusOr<std::vector<Frame>> ReadAll(const std::string& spec) {
  const auto source = cli::OpenSource(spec, {});
  if (!source.ok()) return source.status();
  std::vector<Frame> frames;
  for (std::size_t i = 0; i < source->frame_count; ++i) {
    auto frame = source->read(i);
    if (!frame.ok()) return frame.status();
    frames.push_back(*std::move(frame));
  }
  if (frames.empty()) return absl::NotFoundError(spec + ": holds no frames");
  return frames;
}

double Since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Until the time is over; true if memory can be judged after a warm-up.
Memory Sample(const SceneClient& client, Everyone& all, double duration_s) {
  const double warm_up_s = std::min(kWarmUp_s, duration_s / 2);
  Memory memory;
  const Clock::time_point start = Clock::now();
  while (Since(start) < duration_s) {
    std::this_thread::sleep_for(std::chrono::seconds(1));
    const auto status = client.GetStatus();
    if (!status.ok()) {
      all.faults.Note("status", status.status());
      continue;
    }
    const double at_s = Since(start);
    if (at_s < warm_up_s) continue;
    memory.resident.push_back({at_s, status->resident_bytes});
    memory.heap.push_back({at_s, status->heap_bytes_in_use});
  }
  return memory;
}

// Once nobody writes any more.
bool MirrorIsEqual(const SceneClient& client, const SceneMirror& mirror, Everyone& all) {
  const auto status = client.GetStatus(/*include_hash=*/true);
  if (!status.ok()) {
    all.faults.Note("status", status.status());
    return false;
  }
  const auto scene = mirror.WaitFor(status->version, std::chrono::seconds(60));
  if (!scene.ok()) all.faults.Note("mirror", scene.status());
  if (mirror.state().reconnects > 0) all.faults.Note("mirror", mirror.state().last_error);
  return scene.ok() && (*scene)->Hash() == status->scene_hash;
}

void Add(nlohmann::json& json, const std::string& name, const std::vector<MemorySample>& samples) {
  json[name] = {
      {"growth_mb_per_hour", GrowthPerHour(samples) / 1e6},
      {"first_mb", samples.empty() ? 0.0 : static_cast<double>(samples.front().bytes) / 1e6},
      {"last_mb", samples.empty() ? 0.0 : static_cast<double>(samples.back().bytes) / 1e6}};
}

nlohmann::json Summary(const Flags& flags, const Everyone& all, const Memory& memory,
                       bool mirror_equal) {
  const bool judged = 60 * flags.minutes - kWarmUp_s >= kLeastJudged_s;
  const bool steady = GrowthPerHour(memory.resident) < kMaxGrowth_bytes &&
                      GrowthPerHour(memory.heap) < kMaxGrowth_bytes;
  nlohmann::json json = {{"minutes", flags.minutes},
                         {"source", flags.source},
                         {"frames", all.tally.frames.load()},
                         {"frames_applied", all.tally.frames_applied.load()},
                         {"sensor_restarts", all.tally.sensor_restarts.load()},
                         {"planner_batches", all.tally.batches.load()},
                         {"watcher_news", all.tally.news.load()},
                         {"errors", all.faults.count()},
                         {"first_errors", all.faults.first()},
                         {"mirror_equal", mirror_equal},
                         {"memory_judged", judged}};
  Add(json, "resident", memory.resident);
  Add(json, "heap_in_use", memory.heap);
  json["passed"] = all.faults.count() == 0 && mirror_equal && (!judged || steady);
  return json;
}

// Everyone at work until the time is over.
absl::StatusOr<nlohmann::json> Soak(const Flags& flags) {
  auto frames = ReadAll(flags.source);
  if (!frames.ok()) return frames.status();
  const Eigen::Vector3d above_W = frames->front().T_W_S.translation + Eigen::Vector3d(0, 0, 6);
  Everyone all;
  std::optional<ServerProcess> server(std::in_place, ServerFlags());
  all.address = server->address();
  const auto connection = Connection::Open(all.address);
  if (!connection.ok()) return connection.status();
  const SceneClient client(*connection);
  auto mirror = SceneMirror::Follow(*connection);
  if (!mirror.ok()) return mirror.status();

  std::thread sensors([&] {
    RunSensors(all, LoopedFrames(*std::move(frames), std::chrono::milliseconds(100)),
               BridgedObject(above_W));
  });
  // The others ask where something has been seen.
  Aabb box_W;
  while (all.faults.count() == 0 && box_W.Empty()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    if (const auto status = client.GetStatus(); status.ok()) box_W = status->static_box_W;
  }
  std::vector<std::thread> planners, watchers;
  for (int i = 0; i < kPlanners; ++i) planners.emplace_back([&, i] { RunPlanner(all, box_W, i); });
  for (int i = 0; i < kWatchers; ++i) watchers.emplace_back([&, i] { RunWatcher(all, box_W, i); });

  const Memory memory = Sample(client, all, 60 * flags.minutes);
  all.stop = true;
  sensors.join();
  for (std::thread& planner : planners) planner.join();
  const bool equal = MirrorIsEqual(client, **mirror, all);
  server.reset();  // ends the watches
  for (std::thread& watcher : watchers) watcher.join();
  return Summary(flags, all, memory, equal);
}

int Main(int argc, char** argv) {
  CLI::App app(
      "Runs clearway-server for some time with a recording that loops over the same ground at "
      "10 Hz, sensors that restart, an object that is bridged all along, 16 planners, watchers and "
      "a mirror. Prints a summary as JSON; the exit code is 0 if there was no error, the mirror is "
      "equal at the end, and memory grew by less than 10 MB an hour after the first 5 minutes "
      "(judged in runs of 15 minutes or more).",
      "soak");
  Flags flags;
  app.add_option("minutes,--minutes", flags.minutes, "How long")
      ->check(CLI::Range(0.05, 1e5))
      ->capture_default_str();
  app.add_option("--source", flags.source, "As 'clearway replay' takes it")->capture_default_str();
  app.add_option("--out", flags.out, "Also write the summary to this file");
  CLI11_PARSE(app, argc, argv);
  const auto summary = Soak(flags);
  if (!summary.ok()) {
    std::cerr << "soak: " << summary.status() << "\n";
    return 1;
  }
  std::cout << summary->dump(2) << std::endl;
  if (!flags.out.empty()) std::ofstream(flags.out) << summary->dump(2) << "\n";
  return (*summary)["passed"] ? 0 : 1;
}

}  // namespace
}  // namespace clearway::soak

int main(int argc, char** argv) { return clearway::soak::Main(argc, argv); }
