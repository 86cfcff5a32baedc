// Everything that changes the scene: a bounded queue and the one writer thread.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/base/thread_pool.h"
#include "clearway/scene/scene_builder.h"
#include "clearway/wire/push_ack.h"
#include "server/memory_budget.h"
#include "server/remembered_frames.h"
#include "server/thread_priority.h"
#include "server/versions.h"

namespace clearway {

// UNAVAILABLE: what a server that is about to end says to what it does not do any more.
absl::Status DrainingError();

// What the ingestor has done so far.
struct IngestCounts {
  std::uint64_t frames_applied = 0, frames_refused = 0;
  std::uint64_t frames_late = 0;  // of those applied
  std::uint64_t points_used = 0, points_not_finite = 0;
  std::uint64_t queued = 0;
};

// A frame as it was pushed.
struct PushedFrame {
  Frame frame;
  std::uint64_t content_hash = 0;  // of all that was sent: equal for repeats alone
  bool allow_stamp_jump = false;
  RequestMemory::Share memory{};  // that it takes until it is applied

  FrameName name() const { return {frame.sensor_id, frame.sensor_run, frame.sequence}; }
  FrameContent content() const { return {frame.stamp, content_hash}; }
};

// Applies frames and other changes in the order they were accepted, and publishes a version after
// each. Any thread may call any method. A frame is named by (sensor_id, sensor_run, sequence): an
// identical repeat gets the first one's answer, refusals by the scene included, as long as the name
// is remembered; another frame of that name is refused. Frames that were never accepted leave no
// trace, nor do those that the server failed to apply.
class Ingestor {
 public:
  using Answer = absl::StatusOr<PushAck>;
  // An accepted frame; its answer comes when it was applied or refused.
  struct Ticket {
    std::shared_future<Answer> answer;
    bool repeated = false;

    bool Answered() const {
      return answer.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    }
  };
  using Change = std::function<absl::Status(SceneBuilder&)>;
  // What a change does to the scene. One that adds to it is refused when there is no room. One that
  // begins it anew lets frames pushed before it be pushed again, and older versions are dropped.
  enum class Effect { kAdds, kTakesAway, kBeginsAnew };

  struct Options {
    SceneParams scene;
    FrameLimits frames;
    std::size_t max_queued = 32;
    std::size_t max_remembered = 10'000;
    int threads = 1;
    int niceness = 0;  // of the threads that apply frames
    // RESOURCE_EXHAUSTED if the scene may not grow.
    std::function<absl::Status()> has_room = [] { return absl::OkStatus(); };
  };

  // `versions` must outlive the ingestor. Publishes the empty scene.
  Ingestor(const Options& options, Versions& versions);
  ~Ingestor();  // drains

  // The answer to the same frame, accepted before and remembered. None if there is none, and if
  // another frame has its name: Push says so.
  std::optional<Ticket> FindRepeated(const FrameName& name, const FrameContent& content,
                                     bool allow_stamp_jump) const;
  // RESOURCE_EXHAUSTED if the queue is full, UNAVAILABLE while draining, ALREADY_EXISTS for the
  // name of another frame.
  absl::StatusOr<Ticket> Push(PushedFrame pushed);
  // As Push, but waits for room in the queue; CANCELLED once `gone`.
  absl::StatusOr<Ticket> PushWhenRoom(PushedFrame pushed, const Gone& gone);
  // Queues a change beside the frames.
  absl::StatusOr<Ticket> Apply(Change change, Effect effect);
  // The answer; CANCELLED once `gone` (the frame is applied all the same).
  static Answer Wait(const Ticket& ticket, const Gone& gone);

  // Counts a frame that was refused before it came here.
  void CountRefused();

  // Refuses what is new, and applies what was accepted, as long as there is time: at `end` the
  // changes that still wait are answered with UNAVAILABLE. False if one is being applied even then.
  bool Drain(std::chrono::steady_clock::time_point end);
  IngestCounts counts() const;

 private:
  struct Job {
    Change change;
    Effect effect = Effect::kAdds;
    std::optional<FrameName> frame;  // of a frame
    PushAck ack;                     // filled by `change`, then by the publication
    std::promise<Answer> answer;
  };

  absl::StatusOr<Ticket> Enqueue(std::unique_lock<std::mutex>& lock, std::unique_ptr<Job> job);
  std::unique_ptr<Job> JobOf(PushedFrame pushed);
  absl::StatusOr<Ticket> PushLocked(std::unique_lock<std::mutex>& lock, PushedFrame pushed);
  void Count(const FrameName& name, const Answer& answer);
  void MakeThreadsGiveWay();
  void Run();
  absl::Status MakeRoom();
  Answer Do(Job& job);

  const Options options_;
  Versions& versions_;
  ThreadPool pool_;
  SceneBuilder builder_;                          // the writer thread's alone
  std::vector<std::optional<TurnAlarm>> alarms_;  // of the pool's threads, while they apply

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::unique_ptr<Job>> queue_;
  RememberedFrames remembered_;
  IngestCounts counts_;
  bool applying_ = false;
  bool draining_ = false;
  std::thread writer_;
};

}  // namespace clearway
