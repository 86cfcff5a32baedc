// Latency of queries while scans of a real drive arrive at 10 Hz, against the same queries beside a
// thread that burns as much processor time without touching the scene: once with the share that
// threads usually have, once with the smaller one of the server's writer. The three take turns.
// Server, sensor and client are three processes.
#include <benchmark/benchmark.h>
#include <time.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include "clearway/client/scene_client.h"
#include "clients/server_process.h"
#include "rpc_calls.h"
#include "scan_process.h"
#include "server/config.h"
#include "server/thread_priority.h"
#include "summary.h"

namespace clearway::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kPoints = 1'000;
constexpr int kScans = 20;  // of the drive
constexpr std::chrono::milliseconds kPeriod(100);
constexpr std::chrono::seconds kTurn(1);  // of one side

double SecondsOf(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Processor time that a process has taken.
double ProcessSeconds(pid_t pid) {
  clockid_t clock{};
  if (clock_getcpuclockid(pid, &clock) != 0) std::abort();
  return SecondsOf(clock);
}

// A thread that takes so much processor time in each 0.1 s, or all it can get if that is more.
class Burner {
 public:
  Burner(double seconds, int niceness) : seconds_(seconds), niceness_(niceness) {}
  ~Burner() {
    stop_ = true;
    thread_.join();
  }

 private:
  void Run() {
    GiveWay(niceness_);
    Clock::time_point next = Clock::now();
    while (!stop_) {
      const double end = SecondsOf(CLOCK_THREAD_CPUTIME_ID) + seconds_;
      while (!stop_ && SecondsOf(CLOCK_THREAD_CPUTIME_ID) < end) {
        // About a millisecond between two system calls: the writer makes few.
        for (int i = 0; i < 2'000'000; ++i) benchmark::DoNotOptimize(i);
      }
      next = std::max(next + kPeriod, Clock::now());
      std::this_thread::sleep_until(next);
    }
  }

  const double seconds_;
  const int niceness_;
  std::atomic<bool> stop_ = false;
  std::thread thread_{[this] { Run(); }};
};

class Setting {
 public:
  Setting() {
    scans_.Connect(server_.address());
    scans_.Push(2 * kScans);  // forth and back
  }

  ScanProcess& scans() { return scans_; }

  // Batches whose times stay ahead of the scans that arrive meanwhile.
  LoadReport Ask() {
    const auto scene = SceneClient(*Connection::Open(server_.address())).GetStatus();
    const QuestionSpace space{scene->static_box_W, scene->stamp + kTurn, std::chrono::seconds(2)};
    auto report = RunLoad({PointsCall(server_.address(), space, kPoints, 1)}, kTurn);
    if (!report.ok()) std::abort();
    return *std::move(report);
  }

  LoadReport AskBeside(const Burner&) { return Ask(); }

  // Processor time that one scan takes, the sensor's part included.
  double SecondsPerScan() {
    const double begin = Spent();
    scans_.Push(kScans);
    return (Spent() - begin) / kScans;
  }

 private:
  double Spent() const { return ProcessSeconds(server_.pid()) + ProcessSeconds(scans_.pid()); }

  ScanProcess scans_;  // forks before there are threads
  ServerProcess server_{{"--threads", "1", "--scene-max-range-m", "50"}};
};

// Of several loads, as if of one.
class Pooled {
 public:
  void Add(const LoadReport& report) {
    latencies_ms_.insert(latencies_ms_.end(), report.latencies_ms.begin(),
                         report.latencies_ms.end());
    seconds_ += report.seconds;
  }
  double LatencyMs(double share) {
    std::sort(latencies_ms_.begin(), latencies_ms_.end());
    return LoadReport{seconds_, latencies_ms_}.LatencyMs(share);
  }

 private:
  std::vector<double> latencies_ms_;
  double seconds_ = 0;
};

// Short turns: what disturbs one side disturbs the others.
void Writing(benchmark::State& state, Setting& setting) {
  constexpr int kTurns = 8;
  for (auto _ : state) {
    const double seconds_per_scan = setting.SecondsPerScan();
    Pooled burning, burning_behind, writing;
    int scans = 0;
    double sending_s = 0;  // the pause after the last one included
    for (int turn = 0; turn < kTurns; ++turn) {
      burning.Add(setting.AskBeside(Burner(seconds_per_scan, 0)));
      burning_behind.Add(
          setting.AskBeside(Burner(seconds_per_scan, ServerConfig().writer_niceness)));
      const auto begin = Clock::now();
      setting.scans().Start();
      writing.Add(setting.Ask());
      scans += setting.scans().Stop();
      sending_s += std::chrono::duration<double>(Clock::now() - begin).count();
    }
    const double p99_ms = writing.LatencyMs(0.99);
    state.counters["writing_scans_per_s"] = scans / sending_s;
    state.counters["query_p99_while_writing_x"] = p99_ms / burning.LatencyMs(0.99);
    state.counters["query_p99_while_writing_vs_nice_x"] = p99_ms / burning_behind.LatencyMs(0.99);
    state.counters["query_p50_while_writing_x"] = writing.LatencyMs(0.5) / burning.LatencyMs(0.5);
    state.counters["query_p99_while_writing_ms"] = p99_ms;
    state.counters["writing_cpu_ms_per_scan"] = 1e3 * seconds_per_scan;
  }
}

void Register(const Effort& effort) {
  const auto setting = std::make_shared<Setting>();
  Add("writing", effort, [=](benchmark::State& state) { Writing(state, *setting); });
}

}  // namespace
}  // namespace clearway::bench

int main(int argc, char** argv) {
  return clearway::bench::Main(argc, argv, clearway::bench::Register, {});
}
