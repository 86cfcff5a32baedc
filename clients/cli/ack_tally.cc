#include "cli/ack_tally.h"

#include <algorithm>

namespace clearway::cli {

void AckTally::Sent(const Frame& frame) {
  const std::lock_guard lock(mutex_);
  in_flight_.push_back({frame.points_S.size(), frame.stamp});
  counts_.objects.Add(frame);
}

FrameSender::OnAck AckTally::OnAck() {
  return [this](const std::string& sensor_id, std::uint64_t sequence,
                const absl::StatusOr<PushAck>& answer) {
    const std::lock_guard lock(mutex_);
    ++counts_.answered;
    InFlight sent{};
    if (!in_flight_.empty()) {
      sent = in_flight_.front();
      in_flight_.pop_front();
    }
    counts_.points += sent.points;
    if (answer.ok()) {
      if (!answer->repeated_answer) {
        counts_.objects.Add(answer->report, sent.stamp);
        counts_.of_points.Add(answer->report);
      }
      counts_.repeated += answer->repeated_answer ? 1 : 0;
      const Duration late_by = answer->report.late_by;
      counts_.late += late_by > Duration::zero() ? 1 : 0;
      counts_.max_late_by = std::max(counts_.max_late_by, late_by);
      if (answer->version >= counts_.last.version) counts_.last = *answer;
      return;
    }
    if (counts_.refused++ > 0) return;
    counts_.first_refusal = answer.status();
    counts_.first_refused_sensor = sensor_id;
    counts_.first_refused_sequence = sequence;
  };
}

void AckTally::ServerRestarted() {
  const std::lock_guard lock(mutex_);
  counts_.lost = counts_.answered - counts_.refused;
  counts_.last = PushAck();
}

AckTally::Counts AckTally::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

}  // namespace clearway::cli
