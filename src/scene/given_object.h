// What is told of objects, put into the objects of a scene.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "clearway/scene/given_object.h"
#include "clearway/scene/scene_params.h"

namespace clearway {

// The objects of a scene while they are changed: ascending ids. What an error leaves behind is
// whole, but not to be published if there were changes before it.
using SceneObjects = std::vector<std::shared_ptr<const MovingObject>>;

// What SceneBuilder::AddObject says of a shape, `field`.
absl::Status ValidateGivenShape(const std::string& field, const Shape& shape);

// See SceneBuilder, whose methods these are for one item.
absl::Status AddGiven(const GivenObject& given, const SceneParams& params,
                      const FrameLimits& limits, SceneObjects& objects);
absl::Status RemoveGiven(const std::string& field, ObjectId id, SceneObjects& objects);
absl::Status StateFuture(ObjectId id, const std::vector<StampedPose>& poses,
                         const SceneParams& params, const FrameLimits& limits,
                         SceneObjects& objects);

}  // namespace clearway
