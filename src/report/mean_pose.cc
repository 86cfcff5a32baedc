#include "clearway/report/mean_pose.h"

namespace clearway {
namespace {

Pose Turn(const Eigen::Quaterniond& rotation) { return {rotation, Eigen::Vector3d::Zero()}; }

}  // namespace

void MeanPose::Add(const Pose& pose) {
  if (Empty()) first_ = pose.rotation;
  turns_ += Log(Inverse(Turn(first_)) * Turn(pose.rotation)).angular;
  translations_ += pose.translation;
  ++count_;
}

Pose MeanPose::Value() const {
  const Pose turned = Turn(first_) * Exp({turns_ / count_, Eigen::Vector3d::Zero()});
  return {turned.rotation, translations_ / count_};
}

}  // namespace clearway
