#include "cli/ack_tally.h"

#include <algorithm>

namespace clearway::cli {

void AckTally::Sent(std::uint64_t points) {
  const std::lock_guard lock(mutex_);
  points_in_flight_.push_back(points);
}

FrameSender::OnAck AckTally::OnAck() {
  return [this](const std::string& sensor_id, std::uint64_t sequence,
                const absl::StatusOr<PushAck>& answer) {
    const std::lock_guard lock(mutex_);
    ++counts_.answered;
    if (!points_in_flight_.empty()) {
      counts_.points += points_in_flight_.front();
      points_in_flight_.pop_front();
    }
    if (answer.ok()) {
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

AckTally::Counts AckTally::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

}  // namespace clearway::cli
