#include "demo/replay.h"

#include <algorithm>
#include <chrono>
#include <mutex>

#include "cli/progress.h"

namespace clearway::demo {
namespace {

// The answers to one piece; they come from a thread of the sender's own.
struct Answers {
  std::mutex mutex;
  absl::Status first_refusal;
  std::uint64_t version = 0;
  std::size_t answered = 0;
};

}  // namespace

Replay::Replay(std::shared_ptr<Connection> connection, const FrameSource& source, std::ostream& out,
               bool is_terminal)
    : source_(source), out_(out), is_terminal_(is_terminal), sender_(std::move(connection)) {}

absl::Status Replay::Through(std::size_t last_frame) {
  const std::size_t first = totals_.frames;
  const std::size_t end = std::min(last_frame + 1, source_.frame_count);
  if (first >= end) return absl::OkStatus();
  const auto started = std::chrono::steady_clock::now();
  Answers answers;
  absl::Status status = sender_.OpenStream(
      [&answers](const std::string&, std::uint64_t, const absl::StatusOr<PushAck>& answer) {
        const std::lock_guard lock(answers.mutex);
        ++answers.answered;
        if (answer.ok()) answers.version = std::max(answers.version, answer->version);
        if (!answer.ok()) answers.first_refusal.Update(answer.status());
      });
  cli::ProgressBar bar(out_, is_terminal_, end - first);
  std::uint64_t points = 0;
  for (std::size_t k = first; k < end && status.ok(); ++k) {
    const auto frame = source_.read(k);
    status = frame.ok() ? sender_.Send(*frame) : frame.status();
    if (!status.ok()) break;
    points += frame->points_S.size();
    bar.Update(k - first + 1, points);
  }
  status.Update(sender_.CloseStream());
  bar.Finish();
  status.Update(answers.first_refusal);
  totals_.frames = end;
  totals_.points += points;
  totals_.seconds +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  totals_.version = std::max(totals_.version, answers.version);
  return status;
}

}  // namespace clearway::demo
