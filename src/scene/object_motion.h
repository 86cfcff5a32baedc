// How an object goes on after its newest pose.
#pragma once

#include <optional>
#include <span>

#include "clearway/scene/moving_object.h"
#include "clearway/scene/scene_params.h"

namespace clearway {

// The middle of the object, in O.
Eigen::Vector3d CenterOf(const Solid& solid);

// The box of what is known of a body, in O. Half a size of zero: a point.
struct BodyBox {
  Eigen::Vector3d center_O = Eigen::Vector3d::Zero(), half_size_m = Eigen::Vector3d::Zero();
};
BodyBox BoxOf(const Solid& solid);

// The velocity (in O) with which an object of that track goes on: by params.motion its last motion,
// or what fits the track, whose newest pose is the last; none if it is at rest
// (params.rest_distance_m). Its last motion counts in any case if the last step turns too far.
Twist GoesOn(std::span<const StampedPose> track, const Twist& last_motion_O, const Solid& solid,
             const SceneParams& params);

// The same, of a track of two poses or more whose last motion is that between the last two.
Twist GoesOnByItself(std::span<const StampedPose> track, const Solid& solid,
                     const SceneParams& params);

// Poses that are closer in time tell no velocity: of two sensors' frames 10 microseconds apart, a
// centimetre of noise would be 1,000 m/s.
inline constexpr Duration kShortestStep = std::chrono::milliseconds(5);

// The newest pose that is at least kShortestStep before `stamp`; null if there is none.
const StampedPose* StepBefore(std::span<const StampedPose> track, Time stamp);

// By how much a heading may be off from where it was, or was predicted to be, so long ago: people
// turn round within half a second; the rest is noise of headings.
double MaxTurn_rad(double seconds);

// Whether a heading is wrong: the step turns farther than MaxTurn_rad, or the acceleration towards
// the middle of the turn is more than vehicles and people reach, be it that of the box's middle or
// that of its corners about its middle.
bool TurnsTooFar(const StampedPose& before, const StampedPose& after, const BodyBox& body);

// The newest pose of half a second before with the heading of `pose`, to within 0.3 rad: if every
// second heading is wrong, the one before the last. Null if there is none.
const StampedPose* PoseAlike(std::span<const StampedPose> track, const StampedPose& pose);

// The velocity, in O, of a step of at least kShortestStep. If the step turns too far, the velocity
// is that of the box's middle. `until_then` is the velocity that was known before, in O; the object
// then turns on as it did, and its velocity changes no faster than vehicles and people accelerate:
// the middle is seldom the point that a wrong heading turns about.
Twist VelocityOfStep(const StampedPose& before, const StampedPose& after, const BodyBox& body,
                     const std::optional<Twist>& until_then = std::nullopt);

// The velocity of the last step, in O, however far it turns; zero if there is none.
Twist LastMotionOf(std::span<const StampedPose> track);

}  // namespace clearway
