// What a version says of its moving objects, as one that lists them wants to know it.
#pragma once

#include "absl/status/statusor.h"
#include "clearway/wire/answers.h"
#include "server/versions.h"

namespace clearway {

// With its parts. The object must be one of the scene's.
ObjectInfo DescribeObject(const SceneSnapshot& scene, const MovingObject& object);
// All of them, parts with the object that they are parts of. CANCELLED soon after `gone`.
absl::StatusOr<ObjectList> DescribeObjects(const SceneSnapshot& scene, const Gone& gone);

}  // namespace clearway
