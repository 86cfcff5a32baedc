// The part of a delta on one object.
#pragma once

#include <memory>

#include "absl/status/statusor.h"
#include "clearway/scene/scene_delta.h"

namespace clearway {

// `from`: null for a new object.
ObjectDelta DiffObjects(const MovingObject* from, const MovingObject& to, MapDetail detail);

// The object after the change. `base`: null for a new one. INVALID_ARGUMENT if the delta is not
// well formed.
absl::StatusOr<std::shared_ptr<const MovingObject>> ApplyObject(const MovingObject* base,
                                                                const ObjectDelta& delta,
                                                                const SceneParams& params);

}  // namespace clearway
