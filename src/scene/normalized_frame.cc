#include "scene/normalized_frame.h"

#include <algorithm>

#include "clearway/geometry/unit_quaternion.h"

namespace clearway {
namespace {

bool IsNormalized(const Pose& pose) { return Normalized(pose) == pose; }

}  // namespace

std::optional<Frame> Renormalized(const Frame& frame) {
  const bool is_normalized = IsNormalized(frame.T_W_S) &&
                             std::ranges::all_of(frame.motions, IsNormalized, &ObjectMotion::H_W) &&
                             std::ranges::all_of(frame.poses, IsNormalized, &ObjectPose::T_W_B);
  if (is_normalized) return std::nullopt;
  Frame result = frame;
  result.T_W_S = Normalized(result.T_W_S);
  for (ObjectMotion& motion : result.motions) motion.H_W = Normalized(motion.H_W);
  for (ObjectPose& pose : result.poses) pose.T_W_B = Normalized(pose.T_W_B);
  return result;
}

}  // namespace clearway
