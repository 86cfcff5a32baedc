// Where an object is whose source's poses are off.
#pragma once

#include <cstdint>
#include <span>

#include "clearway/scene/moving_object.h"
#include "scene/labelled_cloud.h"

namespace clearway {

// By so much stamps of motions may be off.
inline constexpr Duration kNoGap = std::chrono::milliseconds(10);

// T_W_T (see ToldPose) after a motion. Where motions follow each other, it goes on from what the
// source said before and not from T_W_from, the object's pose as it was mended: what is wrong with
// one of them, the next may make good again. Else it begins anew.
Pose CarriedOn(const ObjectMotion& motion, const Pose& T_W_from, MovingObject& object);

// The object's T_W_O at `stamp`, of which the source says T_W_T: mended by how the points fit the
// object's map (if there are any), by how far the source was off lately, and by where the object
// went when it was seen last. What the source said is noted in object.told. T_W_T itself unless
// params.MendsObjectPoses().
Pose MendedPose(const Pose& T_W_T, const LabelledCloud& cloud,
                std::span<const std::uint32_t> points, Time stamp, const SceneParams& params,
                MovingObject& object);

}  // namespace clearway
