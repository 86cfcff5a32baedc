#include "server/ingestor.h"

#include <exception>
#include <new>

#include "absl/strings/str_cat.h"
#include "server/memory_use.h"
#include "spdlog/spdlog.h"
#include "wire/status.h"

namespace clearway {
namespace {

constexpr std::chrono::milliseconds kLook(20);

absl::Status QueueFull(std::size_t limit) {
  return WithReason(absl::ResourceExhaustedError(
                        absl::StrCat("the queue is full: ", limit, " changes are waiting")),
                    "QUEUE_FULL");
}

}  // namespace

absl::Status DrainingError() {
  return WithReason(absl::UnavailableError("the server is draining"), "DRAINING");
}

Ingestor::Ingestor(const Options& options, Versions& versions)
    : options_(options),
      versions_(versions),
      pool_(options.threads),
      builder_(options.scene, options.frames, pool_),
      alarms_(options.threads),
      remembered_(options.max_remembered) {
  versions_.Publish(builder_.Publish());
  writer_ = std::thread([this] { Run(); });
}

Ingestor::~Ingestor() {
  Drain(std::chrono::steady_clock::now());
  writer_.join();
}

std::unique_ptr<Ingestor::Job> Ingestor::JobOf(PushedFrame pushed) {
  auto job = std::make_unique<Job>();
  job->frame = pushed.name();
  job->change = [shared = std::make_shared<const PushedFrame>(std::move(pushed)),
                 ack = &job->ack](SceneBuilder& builder) {
    absl::StatusOr<FrameReport> report =
        builder.Apply(shared->frame, {.allow_stamp_jump = shared->allow_stamp_jump});
    if (report.ok()) ack->report = *report;
    return report.status();
  };
  return job;
}

absl::StatusOr<Ingestor::Ticket> Ingestor::Enqueue(std::unique_lock<std::mutex>&,
                                                   std::unique_ptr<Job> job) {
  if (draining_) return DrainingError();
  if (queue_.size() >= options_.max_queued) return QueueFull(options_.max_queued);
  Ticket ticket{job->answer.get_future().share(), false};
  queue_.push_back(std::move(job));
  changed_.notify_all();
  return ticket;
}

absl::StatusOr<Ingestor::Ticket> Ingestor::PushLocked(std::unique_lock<std::mutex>& lock,
                                                      PushedFrame pushed) {
  const FrameName name = pushed.name();
  RememberedFrames::Entry entry{pushed.content(), pushed.allow_stamp_jump, {}};
  const auto repeated = remembered_.Find(name, entry.content, entry.allow_stamp_jump);
  if (!repeated.ok()) {
    ++counts_.frames_refused;
    return repeated.status();
  }
  if (*repeated != nullptr) return Ticket{(*repeated)->answer, true};
  absl::StatusOr<Ticket> ticket = Enqueue(lock, JobOf(std::move(pushed)));
  if (!ticket.ok()) return ticket;
  entry.answer = ticket->answer;
  remembered_.Add(name, std::move(entry));
  return ticket;
}

std::optional<Ingestor::Ticket> Ingestor::FindRepeated(const FrameName& name,
                                                       const FrameContent& content,
                                                       bool allow_stamp_jump) const {
  std::lock_guard lock(mutex_);
  const auto repeated = remembered_.Find(name, content, allow_stamp_jump);
  if (!repeated.ok() || *repeated == nullptr) return std::nullopt;
  return Ticket{(*repeated)->answer, true};
}

absl::StatusOr<Ingestor::Ticket> Ingestor::Push(PushedFrame pushed) {
  std::unique_lock lock(mutex_);
  return PushLocked(lock, std::move(pushed));
}

absl::StatusOr<Ingestor::Ticket> Ingestor::PushWhenRoom(PushedFrame pushed, const Gone& gone) {
  std::unique_lock lock(mutex_);
  while (!draining_ && queue_.size() >= options_.max_queued) {
    if (gone()) return absl::CancelledError("the client has gone");
    changed_.wait_for(lock, kLook);
  }
  return PushLocked(lock, std::move(pushed));
}

absl::StatusOr<Ingestor::Ticket> Ingestor::Apply(Change change, Effect effect) {
  auto job = std::make_unique<Job>();
  job->change = std::move(change);
  job->effect = effect;
  std::unique_lock lock(mutex_);
  absl::StatusOr<Ticket> ticket = Enqueue(lock, std::move(job));
  if (!ticket.ok() || effect != Effect::kBeginsAnew) return ticket;
  // Now, not when the change is applied: frames that come in between belong to what follows it.
  remembered_.Clear();
  return ticket;
}

Ingestor::Answer Ingestor::Wait(const Ticket& ticket, const Gone& gone) {
  while (ticket.answer.wait_for(kLook) != std::future_status::ready) {
    if (gone()) return absl::CancelledError("the client has gone");
  }
  Answer answer = ticket.answer.get();
  if (answer.ok()) answer->repeated_answer = ticket.repeated;
  return answer;
}

// Kept versions are the first to go.
absl::Status Ingestor::MakeRoom() {
  if (options_.has_room().ok()) return absl::OkStatus();
  versions_.KeepNewestOnly();
  return options_.has_room();
}

Ingestor::Answer Ingestor::Do(Job& job) {
  try {
    if (job.effect == Effect::kAdds) {
      if (absl::Status status = MakeRoom(); !status.ok()) return status;
    }
    if (absl::Status status = job.change(builder_); !status.ok()) return status;
    ScenePtr scene = builder_.Publish();
    job.ack.version = scene->version;
    job.ack.stamp = scene->stamp;
    job.ack.reached = AckLevel::kApplied;
    versions_.Publish(std::move(scene));
    if (job.effect == Effect::kBeginsAnew) {
      versions_.KeepNewestOnly();
      GiveMemoryBack();
    }
    return job.ack;
  } catch (const std::bad_alloc&) {
    spdlog::error("a change failed: no memory");
    return WithReason(absl::ResourceExhaustedError("the server has no memory for the change"),
                      "NO_MEMORY");
  } catch (const std::exception& e) {
    spdlog::error("a change failed: {}", e.what());
    return WithReason(absl::InternalError("the server failed to apply the change"),
                      "CHANGE_FAILED");
  }
}

// Gives the threads that apply frames a smaller share of a busy machine, and lets others in before
// they are done: who asks waits for an answer, while a frame that comes late is only late.
void Ingestor::MakeThreadsGiveWay() {
  pool_.ParallelFor(pool_.threads(), [this](int worker, std::size_t, std::size_t) {
    GiveWay(options_.niceness);
    alarms_[worker].emplace();
  });
}

void Ingestor::Run() {
  MakeThreadsGiveWay();
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return draining_ || !queue_.empty(); });
    if (queue_.empty()) return;
    const std::unique_ptr<Job> job = std::move(queue_.front());
    queue_.pop_front();
    applying_ = true;
    changed_.notify_all();
    lock.unlock();
    for (auto& alarm : alarms_) alarm->Start();
    Answer answer = Do(*job);
    for (auto& alarm : alarms_) alarm->Stop();
    lock.lock();
    if (job->frame) Count(*job->frame, answer);
    job->answer.set_value(std::move(answer));
    applying_ = false;
    changed_.notify_all();
  }
}

void Ingestor::Count(const FrameName& name, const Answer& answer) {
  if (!answer.ok()) {
    ++counts_.frames_refused;
    // What has a reason is the server's own failure, and for what is exhausted there may be room
    // later: the same frame may succeed when it comes again.
    if (absl::IsResourceExhausted(answer.status()) || !ReasonOf(answer.status()).empty()) {
      remembered_.Forget(name);
    }
    return;
  }
  const FrameReport& report = answer->report;
  ++counts_.frames_applied;
  counts_.frames_late += report.late_by > Duration::zero();
  counts_.points_used += report.points_used;
  counts_.points_not_finite += report.points_not_finite;
}

void Ingestor::CountRefused() {
  std::lock_guard lock(mutex_);
  ++counts_.frames_refused;
}

bool Ingestor::Drain(std::chrono::steady_clock::time_point end) {
  std::unique_lock lock(mutex_);
  draining_ = true;
  changed_.notify_all();
  changed_.wait_until(lock, end, [&] { return queue_.empty() && !applying_; });
  for (const auto& job : queue_) job->answer.set_value(DrainingError());
  queue_.clear();
  return !applying_;
}

IngestCounts Ingestor::counts() const {
  std::lock_guard lock(mutex_);
  IngestCounts counts = counts_;
  counts.queued = queue_.size();
  return counts;
}

}  // namespace clearway
