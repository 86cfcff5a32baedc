#include "soak/clients.h"

#include <chrono>
#include <optional>

#include "absl/strings/str_cat.h"
#include "clearway/client/frame_sender.h"
#include "clearway/client/remote_checker.h"
#include "clearway/client/scene_client.h"
#include "load/questions.h"

namespace clearway::soak {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kFramePeriod(100), kPlannerPeriod(500);
constexpr std::chrono::seconds kSensorLife(20);
constexpr std::chrono::seconds kChecked(2), kWatched(30);  // how long motions take
constexpr std::size_t kStates = 256, kMotions = 8, kMaxFaults = 10;

Robot Vehicle() { return Robot::SingleShape("vehicle", Box{{1.2, 0.8, 0.6}}); }

ConnectionOptions Patient() {
  ConnectionOptions options;
  options.deadline = std::chrono::seconds(60);  // the machine may be busy
  return options;
}

MotionOptions UnknownIsFree() {
  MotionOptions options;
  options.check.unknown = UnknownPolicy::kFree;
  return options;
}

// Straight ones, from a stamp on.
MotionBatch RandomMotions(std::size_t count, const Aabb& box_W, Time from, Duration length,
                          std::uint64_t seed) {
  RandomQuestions random({box_W, from, Duration(0)}, seed);
  const StateBatch ends = random.States(2 * count, {Pose{}});
  MotionBatch motions;
  motions.T_W_L = ends.T_W_L;
  for (std::size_t m = 0; m < count; ++m) {
    motions.knot_counts.push_back(2);
    for (const Time time : {from, from + length}) {
      motions.times.push_back(time);
      motions.deviations_m.push_back(0);
    }
    // Not across the whole box.
    Pose& end = motions.T_W_L[2 * m + 1];
    const Pose& begin = motions.T_W_L[2 * m];
    end.translation = begin.translation + 0.05 * (end.translation - begin.translation);
  }
  return motions;
}

void SleepUntil(Clock::time_point time, const Everyone& all) {
  while (!all.stop && Clock::now() < time) {
    std::this_thread::sleep_for(
        std::min<Clock::duration>(time - Clock::now(), std::chrono::milliseconds(100)));
  }
}

// One run of the sensors: a connection and a stream of their own, and sequences from 0 on.
class SensorRun {
 public:
  explicit SensorRun(Everyone& all) : all_(all) {
    auto connection = Connection::Open(all.address, Patient());
    if (!connection.ok()) {
      all.faults.Note("sensor", connection.status());
      return;
    }
    sender_.emplace(*connection);
    const absl::Status opened = sender_->OpenStream(
        [&all](const std::string& sensor, std::uint64_t sequence, const auto& answer) {
          if (answer.ok() && !answer->repeated_answer) {
            ++all.tally.frames_applied;
          } else {
            all.faults.Note(absl::StrCat("frame ", sequence, " of ", sensor),
                            answer.ok() ? absl::AlreadyExistsError("taken for an earlier frame")
                                        : answer.status());
          }
        });
    if (!opened.ok()) all.faults.Note("sensor", opened);
  }
  ~SensorRun() {
    if (!sender_) return;
    if (sender_->state().reconnects > 0) {
      all_.faults.Note("sensor", sender_->state().last_error);
    }
    if (auto closed = sender_->CloseStream(); !closed.ok()) all_.faults.Note("sensor", closed);
  }
  SensorRun(const SensorRun&) = delete;
  SensorRun& operator=(const SensorRun&) = delete;

  void Send(Frame frame) {
    frame.sequence = next_++;
    ++all_.tally.frames;
    if (!sender_) return;
    if (auto sent = sender_->Send(frame); !sent.ok()) all_.faults.Note("sensor", sent);
  }

 private:
  Everyone& all_;
  std::uint64_t next_ = 0;
  std::optional<FrameSender> sender_;
};

}  // namespace

void Faults::Note(const std::string& who, const absl::Status& status) {
  Note(who, status.ToString());
}

void Faults::Note(const std::string& who, const std::string& what) {
  std::lock_guard lock(mutex_);
  if (++count_ <= kMaxFaults) first_.push_back(absl::StrCat(who, ": ", what));
}

std::vector<std::string> Faults::first() const {
  std::lock_guard lock(mutex_);
  return first_;
}

std::uint64_t Faults::count() const {
  std::lock_guard lock(mutex_);
  return count_;
}

void RunSensors(Everyone& all, LoopedFrames frames, BridgedObject bridged) {
  Clock::time_point next = Clock::now();
  while (!all.stop) {
    SensorRun run(all);
    const Clock::time_point end = Clock::now() + kSensorLife;
    while (!all.stop && Clock::now() < end) {
      Frame frame = frames.Next();
      const Time stamp = frame.stamp;
      run.Send(std::move(frame));
      run.Send(bridged.At(stamp));
      // A busy machine is not caught up with.
      next = std::max(next + kFramePeriod, Clock::now());
      SleepUntil(next, all);
    }
    ++all.tally.sensor_restarts;
  }
}

void RunPlanner(Everyone& all, const Aabb& box_W, std::uint64_t seed) {
  const auto connection = Connection::Open(all.address, Patient());
  if (!connection.ok()) return all.faults.Note("planner", connection.status());
  Clock::time_point next = Clock::now();
  for (std::uint64_t round = 0; !all.stop; ++round) {
    const auto checker = RemoteChecker::Pin(*connection, Vehicle());
    if (!checker.ok()) return all.faults.Note("planner", checker.status());
    const Time from = (*checker)->stamp();
    RandomQuestions random({box_W, from, std::chrono::seconds(3)}, seed + 1000 * round);
    const MotionOptions options = UnknownIsFree();
    const auto states = (*checker)->Check(random.States(kStates, {Pose{}}), options.check);
    if (!states.ok()) all.faults.Note("planner", states.status());
    const auto motions = (*checker)->CheckMotions(
        RandomMotions(kMotions, box_W, from, kChecked, seed + 1000 * round), options);
    if (!motions.ok()) all.faults.Note("planner", motions.status());
    ++all.tally.batches;
    next = std::max(next + kPlannerPeriod, Clock::now());
    SleepUntil(next, all);
  }
}

void RunWatcher(Everyone& all, const Aabb& box_W, std::uint64_t seed) {
  const auto connection = Connection::Open(all.address, Patient());
  if (!connection.ok()) return all.faults.Note("watcher", connection.status());
  const auto planner = RemotePlanner::For(*connection, Vehicle());
  if (!planner.ok()) return all.faults.Note("watcher", planner.status());
  const SceneClient client(*connection);
  for (std::uint64_t round = 0; !all.stop; ++round) {
    const auto now = client.GetStatus();
    if (!now.ok()) return all.faults.Note("watcher", now.status());
    const Time end = now->stamp + kWatched;
    const auto status =
        (*planner)->Watch(RandomMotions(kMotions, box_W, now->stamp, kWatched, seed + 1000 * round),
                          UnknownIsFree(), [&](const RemotePlanner::News& news) {
                            ++all.tally.news;
                            if (!news.connection.ok() && !all.stop)
                              all.faults.Note("watcher", news.connection);
                            return !all.stop && news.reply.stamp < end;
                          });
    if (!status.ok()) return all.faults.Note("watcher", status);
  }
}

}  // namespace clearway::soak
