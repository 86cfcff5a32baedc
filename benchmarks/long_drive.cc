#include "long_drive.h"

#include <cstdlib>

#include "clearway/sim/scenarios.h"

namespace clearway::bench {
namespace {

constexpr double kApart_m = 20;

void LeaveOutObjects(Frame& frame) {
  for (auto& label : frame.labels) {
    if (label != kStaticLabel) label = kIgnoreLabel;
  }
  frame.motions.clear();
  frame.poses.clear();
}

}  // namespace

LongDrive::LongDrive() {
  const auto street = MakeScenario("street", {});
  if (!street.ok()) std::abort();
  for (std::size_t k = 0; k < street->frame_count(); ++k) {
    const Eigen::Vector3d at_W = street->TrueT_W_S(k).translation;
    if (!street_.empty() && (at_W - street_.back().T_W_S.translation).norm() < kApart_m) continue;
    street_.push_back(street->MakeFrame(k));
    LeaveOutObjects(street_.back());
  }
  const Eigen::Vector3d last_W = street_.back().T_W_S.translation;
  const Eigen::Vector3d ahead_W = last_W - street_.front().T_W_S.translation;
  street_W_ = ahead_W + kApart_m * ahead_W.normalized();
}

Frame LongDrive::Next() {
  Frame frame = street_[next_ % street_.size()];
  const auto street = static_cast<double>(next_ / street_.size());
  frame.T_W_S.translation += street * street_W_;
  frame.sequence = next_;
  frame.stamp = street_.front().stamp + static_cast<std::int64_t>(next_) * FromSeconds(2);
  driven_m_ = (frame.T_W_S.translation - street_.front().T_W_S.translation).norm();
  ++next_;
  return frame;
}

}  // namespace clearway::bench
