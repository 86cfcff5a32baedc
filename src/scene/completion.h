// What is taken to be there of an object though no ray has met it (SolidMode::kCompletedHull).
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "clearway/scene/moving_object.h"

namespace clearway {

// The object's completion once it is seen from there, at its newest pose; none while it has not
// gone far enough to tell its direction, which is that of its way over the last second, or over
// half of one at least. Of what rests, or swings, the last direction stays.
std::optional<Completion> CompletionOf(const MovingObject& object, const Eigen::Vector3d& sensor_W);

// That of an object that was lost and is seen again as the young one, T_Y_L from its frame to that
// one's: what either of them knew.
std::optional<Completion> JoinedCompletion(const std::optional<Completion>& lost,
                                           const std::optional<Completion>& young,
                                           const Pose& T_Y_L);

// Adds to points that a hull shall hold, which must not be none, their mirror images at the upright
// plane that halves their width, and, with an unseen end, both carried on until they are at least
// twice as long as wide: so are 49 of 56 vehicles in recorded boxes of KITTI and Argoverse 2, and
// the others, of about 4 m, are at least 1.34 times as long (see docs/architecture.md). In a unit
// of length of which a thousandth does not matter. Without an unseen end the points reach no
// farther along, across and up.
void AddUnseen(const Completion& completion, std::vector<Eigen::Vector3d>& points);

}  // namespace clearway
