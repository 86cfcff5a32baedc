// A robot made ready for checks.
#pragma once

#include <memory>

#include "clearway/collision/robot.h"

namespace clearway {

class RobotGeometry;

// A robot and what its shapes need to be checked quickly: a grid of distances and trees of
// triangles for each mesh and hull. Made once, handed to the SceneChecker of every scene version.
// Immutable; any number of threads and checkers may share it.
//
// Making it takes some 15 ms for each mesh or hull of a few triangles, 0.07 s for 1,000 and 0.9 s
// for 100,000; 0.15 s and 3 s if they are not closed. Each takes a quarter of a megabyte, and
// 0.8 kB a triangle.
class PreparedRobot {
 public:
  // `robot` must pass Validate.
  explicit PreparedRobot(Robot robot);
  ~PreparedRobot();
  PreparedRobot(const PreparedRobot&) = delete;
  PreparedRobot& operator=(const PreparedRobot&) = delete;

  const Robot& robot() const { return robot_; }
  // For this library's own use.
  const RobotGeometry& geometry() const { return *geometry_; }

 private:
  Robot robot_;
  std::unique_ptr<const RobotGeometry> geometry_;
};

}  // namespace clearway
