// What a version says of its moving objects, as one that lists them wants to know it.
#pragma once

#include "clearway/wire/answers.h"

namespace clearway {

// With its parts. The object must be one of the scene's.
ObjectInfo DescribeObject(const SceneSnapshot& scene, const MovingObject& object);
// All of them, parts with the object that they are parts of.
ObjectList DescribeObjects(const SceneSnapshot& scene);

}  // namespace clearway
