// Latency of queries while scans of a real drive arrive at 10 Hz, against the same queries beside a
// thread that burns as much processor time without touching the scene. The two take turns.
#include <benchmark/benchmark.h>
#include <time.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

#include "clearway/client/frame_sender.h"
#include "drive_server.h"
#include "rpc_calls.h"
#include "summary.h"

namespace clearway::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kPoints = 1'000;
constexpr std::chrono::milliseconds kPeriod(100);

// Calls `work` each 0.1 s on a thread of its own, or as soon as it can if that takes longer.
class Ticker {
 public:
  explicit Ticker(std::function<void()> work) : work_(std::move(work)) {}
  ~Ticker() {
    stop_ = true;
    thread_.join();
  }
  int ticks() const { return ticks_; }

 private:
  void Run() {
    Clock::time_point next = Clock::now();
    while (!stop_) {
      work_();
      ++ticks_;
      next = std::max(next + kPeriod, Clock::now());
      std::this_thread::sleep_until(next);
    }
  }

  std::function<void()> work_;
  std::atomic<bool> stop_ = false;
  std::atomic<int> ticks_ = 0;
  std::thread thread_{[this] { Run(); }};
};

double ThreadSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double ProcessSeconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void Burn(double seconds) {
  const double end = ThreadSeconds() + seconds;
  while (ThreadSeconds() < end) {
    for (int i = 0; i < 10'000; ++i) benchmark::DoNotOptimize(i);
  }
}

struct Setting {
  explicit Setting(const Effort& effort)
      : served(effort.quick ? 6 : 20, 1),
        turn(std::chrono::seconds(effort.quick ? 2 : 5)),
        sender(*Connection::Open(served.address())) {}

  void Write() {
    if (!sender.Push(served.drive().Next()).ok()) std::abort();
  }

  DriveServer served;
  Duration turn;  // of one side
  FrameSender sender;
};

// Batches whose times stay ahead of the scans that arrive meanwhile.
LoadReport Ask(Setting& setting) {
  QuestionSpace space = setting.served.Space();
  space.from += setting.turn;
  auto report = RunLoad({PointsCall(setting.served.address(), space, kPoints, 1)}, setting.turn);
  if (!report.ok()) std::abort();
  return *std::move(report);
}

// Processor time that one scan takes, the client's part included.
double SecondsPerScan(Setting& setting) {
  const double begin = ProcessSeconds();
  constexpr int kScans = 5;
  for (int i = 0; i < kScans; ++i) setting.Write();
  return (ProcessSeconds() - begin) / kScans;
}

void Writing(benchmark::State& state, Setting& setting) {
  for (auto _ : state) {
    const double seconds_per_scan = SecondsPerScan(setting);
    LoadReport burning, writing;
    {
      const Ticker burner([&] { Burn(seconds_per_scan); });
      burning = Ask(setting);
    }
    {
      const Ticker writer([&] { setting.Write(); });
      writing = Ask(setting);
      state.counters["writing_scans_per_s"] = writer.ticks() / writing.seconds;
    }
    state.counters["query_p99_while_writing_x"] = writing.LatencyMs(0.99) / burning.LatencyMs(0.99);
    state.counters["query_p50_while_writing_x"] = writing.LatencyMs(0.5) / burning.LatencyMs(0.5);
    state.counters["query_p99_while_writing_ms"] = writing.LatencyMs(0.99);
    state.counters["writing_cpu_ms_per_scan"] = 1e3 * seconds_per_scan;
  }
}

void Register(const Effort& effort) {
  const auto setting = std::make_shared<Setting>(effort);
  benchmark::RegisterBenchmark("writing",
                               [=](benchmark::State& state) { Writing(state, *setting); })
      ->Unit(benchmark::kMillisecond)
      ->Iterations(1)
      ->Repetitions(effort.repetitions())
      ->UseRealTime()
      ->ReportAggregatesOnly();
}

}  // namespace
}  // namespace clearway::bench

int main(int argc, char** argv) {
  return clearway::bench::Main(argc, argv, clearway::bench::Register, {});
}
