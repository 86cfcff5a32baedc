// The middle of many poses.
#pragma once

#include "clearway/geometry/pose.h"

namespace clearway {

// Collects poses whose rotations are close to each other. A value.
class MeanPose {
 public:
  void Add(const Pose& pose);

  bool Empty() const { return count_ == 0; }
  // There must be one.
  Pose Value() const;

 private:
  Eigen::Quaterniond first_ = Eigen::Quaterniond::Identity();
  double count_ = 0;
  Eigen::Vector3d turns_ = Eigen::Vector3d::Zero();  // from the first; sums, as the next
  Eigen::Vector3d translations_ = Eigen::Vector3d::Zero();
};

}  // namespace clearway
