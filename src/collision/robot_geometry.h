// A robot's shapes prepared for placing.
#pragma once

#include <optional>
#include <vector>

#include "clearway/collision/robot.h"
#include "collision/narrowphase.h"

namespace clearway {

// Immutable; threads share it.
class RobotGeometry {
 public:
  explicit RobotGeometry(const Robot& robot);

  struct Part {
    ShapeGeometry geometry;
    std::optional<Pose> T_L_G;  // none: G is L
  };
  using Parts = std::vector<Part>;  // of one link
  const std::vector<Parts>& links() const { return links_; }

 private:
  std::vector<Parts> links_;
};

}  // namespace clearway
