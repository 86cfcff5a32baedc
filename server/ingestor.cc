#include "server/ingestor.h"

#include <exception>
#include <new>

#include "absl/strings/str_cat.h"
#include "spdlog/spdlog.h"
#include "wire/status.h"

namespace clearway {
namespace {

constexpr std::chrono::milliseconds kLook(20);

absl::Status Draining() {
  return WithReason(absl::UnavailableError("the server is draining"), "DRAINING");
}

absl::Status QueueFull(std::size_t limit) {
  return WithReason(absl::ResourceExhaustedError(
                        absl::StrCat("the queue is full: ", limit, " changes are waiting")),
                    "QUEUE_FULL");
}

}  // namespace

Ingestor::Ingestor(const Options& options, Versions& versions)
    : options_(options),
      versions_(versions),
      pool_(options.threads),
      builder_(options.scene, options.frames, pool_),
      alarms_(options.threads) {
  versions_.Publish(builder_.Publish());
  writer_ = std::thread([this] { Run(); });
}

Ingestor::~Ingestor() { Drain(); }

std::unique_ptr<Ingestor::Job> Ingestor::JobOf(Frame frame) {
  auto job = std::make_unique<Job>();
  job->is_frame = true;
  job->change = [shared = std::make_shared<const Frame>(std::move(frame)),
                 ack = &job->ack](SceneBuilder& builder) {
    absl::StatusOr<FrameReport> report = builder.Apply(*shared);
    if (report.ok()) ack->report = *report;
    return report.status();
  };
  return job;
}

std::optional<Ingestor::Ticket> Ingestor::Remembered(const FrameName& name) const {
  const auto found = answers_.find(name);
  if (found == answers_.end()) return std::nullopt;
  return Ticket{found->second.answer, true};
}

void Ingestor::Remember(const FrameName& name, const Ticket& ticket) {
  answers_[name] = ticket;
  answer_order_.push_back(name);
  if (answer_order_.size() <= options_.max_remembered) return;
  answers_.erase(answer_order_.front());
  answer_order_.pop_front();
}

absl::StatusOr<Ingestor::Ticket> Ingestor::Enqueue(std::unique_lock<std::mutex>&,
                                                   std::unique_ptr<Job> job) {
  if (draining_) return Draining();
  if (queue_.size() >= options_.max_queued) return QueueFull(options_.max_queued);
  Ticket ticket{job->answer.get_future().share(), false};
  queue_.push_back(std::move(job));
  changed_.notify_all();
  return ticket;
}

absl::StatusOr<Ingestor::Ticket> Ingestor::PushLocked(std::unique_lock<std::mutex>& lock,
                                                      Frame frame) {
  const FrameName name(frame.sensor_id, frame.sequence);
  if (auto remembered = Remembered(name)) return *remembered;
  absl::StatusOr<Ticket> ticket = Enqueue(lock, JobOf(std::move(frame)));
  if (ticket.ok()) Remember(name, *ticket);
  return ticket;
}

std::optional<Ingestor::Ticket> Ingestor::Find(const std::string& sensor_id,
                                               std::uint64_t sequence) const {
  std::lock_guard lock(mutex_);
  return Remembered({sensor_id, sequence});
}

absl::StatusOr<Ingestor::Ticket> Ingestor::Push(Frame frame) {
  std::unique_lock lock(mutex_);
  return PushLocked(lock, std::move(frame));
}

absl::StatusOr<Ingestor::Ticket> Ingestor::PushWhenRoom(Frame frame, const Gone& gone) {
  std::unique_lock lock(mutex_);
  while (!draining_ && queue_.size() >= options_.max_queued) {
    if (gone()) return absl::CancelledError("the client has gone");
    changed_.wait_for(lock, kLook);
  }
  return PushLocked(lock, std::move(frame));
}

absl::StatusOr<Ingestor::Ticket> Ingestor::Apply(Change change, bool forget_answers) {
  auto job = std::make_unique<Job>();
  job->change = std::move(change);
  std::unique_lock lock(mutex_);
  absl::StatusOr<Ticket> ticket = Enqueue(lock, std::move(job));
  if (!ticket.ok() || !forget_answers) return ticket;
  // Now, not when the change is applied: frames that come in between belong to what follows it.
  answers_.clear();
  answer_order_.clear();
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

Ingestor::Answer Ingestor::Do(Job& job) {
  try {
    if (absl::Status status = job.change(builder_); !status.ok()) return status;
    ScenePtr scene = builder_.Publish();
    job.ack.version = scene->version;
    job.ack.stamp = scene->stamp;
    job.ack.reached = AckLevel::kApplied;
    versions_.Publish(std::move(scene));
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
    changed_.notify_all();
    lock.unlock();
    for (auto& alarm : alarms_) alarm->Start();
    Answer answer = Do(*job);
    for (auto& alarm : alarms_) alarm->Stop();
    lock.lock();
    if (job->is_frame) {
      ++(answer.ok() ? counts_.frames_applied : counts_.frames_refused);
      counts_.points_used += answer.ok() ? answer->report.points_used : 0;
      counts_.points_not_finite += answer.ok() ? answer->report.points_not_finite : 0;
    }
    job->answer.set_value(std::move(answer));
  }
}

void Ingestor::CountRefused() {
  std::lock_guard lock(mutex_);
  ++counts_.frames_refused;
}

void Ingestor::Drain() {
  {
    std::lock_guard lock(mutex_);
    draining_ = true;
  }
  changed_.notify_all();
  if (writer_.joinable()) writer_.join();
}

IngestCounts Ingestor::counts() const {
  std::lock_guard lock(mutex_);
  IngestCounts counts = counts_;
  counts.queued = queue_.size();
  return counts;
}

}  // namespace clearway
