// A robot's shape as data.
#pragma once

#include <string>
#include <vector>

#include "absl/status/status.h"
#include "clearway/geometry/shape.h"

namespace clearway {

// One shape of a link.
struct LinkShape {
  Shape shape;
  Pose T_L_G;  // the shape's frame G in the link's frame L
};

struct Link {
  std::string name;
  std::vector<LinkShape> shapes;
};

// A robot of one or many links. Kinematics stay with the caller: a state gives every link's pose. A
// value.
struct Robot {
  std::string name;
  std::vector<Link> links;

  // A robot of one link and one shape centred at the link's origin.
  static Robot SingleShape(std::string name, Shape shape);
};

// INVALID_ARGUMENT naming the field: no links, a link without shapes, sizes that are not positive
// or above 100 m, meshes that are empty or whose indices are out of range, hulls that have no
// volume, are not convex or face inward, poses that are not rigid.
absl::Status Validate(const Robot& robot);

// A robot whose meshes are the solids that they enclose (see SolidMeshOf), and a note on each mesh
// that had to be changed or is open: "links[0].shapes[1].mesh: 6 of 12 faces turned".
struct SolidRobot {
  Robot robot;
  std::vector<std::string> notes;
};
// The robot must pass Validate.
SolidRobot WithSolidMeshes(Robot robot);

// The hash of the robot's content (names too) in 32 hex digits (XXH3-128), by which a server knows
// it: equal robots have equal ids on every machine.
std::string RobotId(const Robot& robot);

}  // namespace clearway
