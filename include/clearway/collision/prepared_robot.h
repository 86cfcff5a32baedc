// A robot made ready for checks.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "clearway/collision/robot.h"

namespace clearway {

class RobotGeometry;

// A robot and what its shapes need to be checked quickly: a grid of distances and trees of
// triangles for each mesh and hull. Meshes count as the solids that they enclose, whichever way
// their faces are turned (see SolidMeshOf). Made once, handed to the SceneChecker of every scene
// version. Immutable; any number of threads and checkers may share it.
//
// Making it takes a millisecond or two for each mesh or hull of a few triangles, 0.1 s for 1,000
// and 0.8 s for 100,000; up to 0.5 s and 1.2 s if they are not closed. What the shapes of a robot
// may take together is bounded: 500,000 triangles, however they lie, take 3 to 10 s. Each shape
// takes up to a quarter of a megabyte, and some 0.7 kB a triangle.
class PreparedRobot {
 public:
  // `robot` must pass Validate.
  explicit PreparedRobot(Robot robot);
  ~PreparedRobot();
  PreparedRobot(const PreparedRobot&) = delete;
  PreparedRobot& operator=(const PreparedRobot&) = delete;

  const Robot& robot() const { return robot_; }  // as it was given
  // What was changed in its meshes, for people (see SolidRobot).
  const std::vector<std::string>& notes() const { return notes_; }
  // For this library's own use.
  const RobotGeometry& geometry() const { return *geometry_; }

 private:
  PreparedRobot(Robot robot, SolidRobot solid);

  Robot robot_;
  std::vector<std::string> notes_;
  std::unique_ptr<const RobotGeometry> geometry_;
};

}  // namespace clearway
