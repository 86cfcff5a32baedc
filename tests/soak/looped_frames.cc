#include "soak/looped_frames.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clearway::soak {
namespace {

constexpr ObjectId kFirstId = BridgedObject::kId + 1;

ObjectId LargestId(const std::vector<Frame>& frames) {
  ObjectId largest = 0;
  const auto note = [&](ObjectId id) { largest = std::max(largest, id); };
  for (const Frame& frame : frames) {
    for (const ObjectId label : frame.labels) note(label);
    for (const ObjectMotion& motion : frame.motions) note(motion.id);
    for (const ObjectPose& pose : frame.poses) note(pose.id);
    for (const ObjectPart& part : frame.parts) note(std::max(part.id, part.whole));
  }
  return largest;
}

}  // namespace

LoopedFrames::LoopedFrames(std::vector<Frame> frames, Duration gap)
    : frames_(std::move(frames)),
      round_(frames_.back().stamp - frames_.front().stamp + gap),
      ids_per_round_(LargestId(frames_) + 1) {}

Frame LoopedFrames::Next() {
  Frame frame = frames_[next_];
  const Duration shift = rounds_ * round_;
  const auto rename = [&](ObjectId& id) {
    if (id > kStaticLabel) id += kFirstId + rounds_ * ids_per_round_;
  };
  frame.stamp += shift;
  for (ObjectId& label : frame.labels) rename(label);
  if (next_ == 0) frame.motions.clear();  // they would start before the round
  for (ObjectMotion& motion : frame.motions) {
    rename(motion.id);
    motion.from += shift;
  }
  for (ObjectPose& pose : frame.poses) rename(pose.id);
  for (ObjectPart& part : frame.parts) {
    rename(part.id);
    rename(part.whole);
  }
  next_ = (next_ + 1) % frames_.size();
  if (next_ == 0) ++rounds_;
  return frame;
}

Pose BridgedObject::T_W_O(Time stamp) const {
  constexpr double kRadius_m = 2, kTurn_radps = 0.5;
  const double angle_rad = kTurn_radps * ToSeconds(stamp - begin_);
  Pose pose;
  pose.rotation = Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitZ()));
  pose.translation = center_W_ + pose.rotation * Eigen::Vector3d(kRadius_m, 0, 0);
  return pose;
}

Frame BridgedObject::At(Time stamp) {
  constexpr int kFramesWithMotion = 5, kPoints = 60;
  constexpr double kSize_m = 0.4;
  if (frames_ == 0) begin_ = stamp;
  Frame frame;
  frame.sensor_id = "tracker";
  frame.stamp = stamp;
  frame.T_W_S.translation = center_W_;
  const Pose T_S_O = Inverse(frame.T_W_S) * T_W_O(stamp);
  for (int i = 0; i < kPoints; ++i) {  // a spiral on a ball
    const double z = -1 + 2.0 * i / (kPoints - 1), turn = i * std::numbers::phi * std::numbers::pi;
    const double r = std::sqrt(std::max(0.0, 1 - z * z));
    const Eigen::Vector3d p_O =
        kSize_m * Eigen::Vector3d(r * std::cos(turn), r * std::sin(turn), z);
    frame.points_S.push_back((T_S_O * p_O).cast<float>());
    frame.labels.push_back(kId);
  }
  if (frames_ > 0 && frames_ < kFramesWithMotion) {
    frame.motions = {{kId, T_W_O(stamp) * Inverse(T_W_O(last_)), last_}};
  }
  last_ = stamp;
  ++frames_;
  return frame;
}

}  // namespace clearway::soak
