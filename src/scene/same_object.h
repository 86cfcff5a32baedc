// Whether an object that is seen may be one that was lost before, for all that is known of them.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "clearway/scene/moving_object.h"
#include "clearway/scene/scene_params.h"

namespace clearway {

// The first pose that is no prediction.
const StampedPose& FirstPose(const MovingObject& object);

// In W, of the centre of what was seen of it; none if it was seen too briefly to tell.
std::optional<Eigen::Vector3d> VelocityNow_mps(const MovingObject& seen);
// The same of an object at that predicted pose; none if no motion is known.
std::optional<Eigen::Vector3d> VelocityAt_mps(const MovingObject& lost, const Pose& T_W_L);

// Whether what went so before it was lost may go so when it is seen again. What turns round
// out of sight, or changes its speed by more than 30 to 60 % and 0.5 m/s, may not.
bool MayComeToGo(const Eigen::Vector3d& before_mps, const Eigen::Vector3d& now_mps,
                 double unseen_s);

// How far from where `lost` is predicted `seen` may be, in metres, if it is that one: half a width,
// for another one like it cannot be nearer, and a tenth of its way meanwhile.
double ToleranceOfPlace_m(const MovingObject& lost, double speed_mps, double unseen_s);

// Whether `lost` was not seen since `seen` first was. Else they are two; and so they are if one is
// given, which nobody sees.
bool WasLostBefore(const MovingObject& lost, const MovingObject& seen);

// How far `seen`, where it was first seen, is from where `lost` was to be then, in metres; none if
// it cannot be that one. It cannot
// - if `lost` was seen since (WasLostBefore);
// - if they are not alike in two of three lengths (along their way, across it, and up), where both
//   go along an axis of their O and were seen often enough to know;
// - if `lost` may not have come to go as `seen` did in its first second (MayComeToGo);
// - if it is too far from all places where `lost` could be: it goes on at any one velocity between
//   the one it had and that of `seen` then, or at that of the two which is known.
// There is no horizon, and what is not known rules nothing out.
std::optional<double> DistanceIfSame_m(const MovingObject& lost, const MovingObject& seen,
                                       const SceneParams& params);

// How likely `seen` was to be where it was first seen if it is `lost`, to be compared with what it
// is as another: the logarithm of a density, of a normal distribution in the plane about where
// `lost` was to be, as wide as it may be off for DistanceIfSame_m (and all of its way more where
// nobody knows how it goes), a voxel at least. None if it cannot be that one.
std::optional<double> LogLikelihoodIfSame(const MovingObject& lost, const MovingObject& seen,
                                          const SceneParams& params);

}  // namespace clearway
