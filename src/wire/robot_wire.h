// Converters of robot.proto.
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "clearway/collision/robot.h"
#include "clearway/v1/robot.pb.h"
#include "clearway/wire/server_info.h"
#include "wire/geometry_wire.h"

namespace clearway {

void Write(const Robot& robot, v1::Robot* proto);
// A TriangleMesh goes as a convex one: the reader's side checks whether it is.
void Write(const Shape& shape, v1::ConvexShape* proto);
// Whether the shape makes sense is for Validate(field, shape).
Shape ReadConvexShape(const std::string& field, const v1::ConvexShape& proto, FieldReader& read);
// Checks what the message itself can get wrong and the limits; whether the shapes make sense is for
// Validate(robot), which the caller runs.
absl::StatusOr<Robot> ReadRobot(const std::string& field, const v1::Robot& proto,
                                const ServerLimits& limits);

}  // namespace clearway
