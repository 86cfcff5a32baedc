// Values for programs (--json). Field names carry units; quaternions are x, y, z, w; stamps are
// integers in nanoseconds.
#pragma once

#include <nlohmann/json.hpp>
#include <ostream>

#include "clearway/client/scene_client.h"
#include "clearway/geometry/aabb.h"
#include "clearway/geometry/pose.h"

namespace clearway::cli {

// Keys stay in the order in which they are written.
using Json = nlohmann::ordered_json;

Json ToJson(const Eigen::Vector3d& vector);
Json ToJson(const Pose& pose);
Json ToJson(const Aabb& box);     // null for an empty box
Json ToJson(SpaceStatus status);  // "FREE", as on the wire
// {"version": ..., "stamp_ns": ...}
Json ToJson(const Versioned& answer);

// Two blanks of indent, a line's end; text that is not UTF-8 is replaced, never an exception.
void Print(std::ostream& out, const Json& json);

}  // namespace clearway::cli
