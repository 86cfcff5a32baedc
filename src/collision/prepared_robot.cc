#include "clearway/collision/prepared_robot.h"

#include <utility>

#include "collision/mesh_budget.h"
#include "collision/robot_geometry.h"

namespace clearway {

RobotGeometry::RobotGeometry(const Robot& robot) {
  BudgetShares budgets(robot);
  for (const Link& link : robot.links) {
    Parts& parts = links_.emplace_back();
    for (const LinkShape& shape : link.shapes) {
      const bool at_origin = shape.T_L_G == Pose{};
      parts.push_back({ShapeGeometry(shape.shape, Reuse::kManyQueries, budgets.Next(shape.shape)),
                       at_origin ? std::nullopt : std::optional(shape.T_L_G)});
    }
  }
}

PreparedRobot::PreparedRobot(Robot robot) : PreparedRobot(robot, WithSolidMeshes(robot)) {}

PreparedRobot::PreparedRobot(Robot robot, SolidRobot solid)
    : robot_(std::move(robot)),
      notes_(std::move(solid.notes)),
      geometry_(std::make_unique<const RobotGeometry>(solid.robot)) {}

PreparedRobot::~PreparedRobot() = default;

}  // namespace clearway
