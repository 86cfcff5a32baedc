// One robot state against one scene at one time.
#pragma once

#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "clearway/collision/state_checker.h"
#include "collision/narrowphase.h"
#include "collision/placed_object.h"
#include "collision/voxel_search.h"

namespace clearway {

// A robot's shapes prepared for placing.
struct LinkGeometry {
  struct Part {
    ShapeGeometry geometry;
    Pose T_L_G;
  };
  std::vector<Part> parts;
};
using RobotGeometry = std::vector<LinkGeometry>;  // by link
RobotGeometry PrepareRobot(const Robot& robot);

// What all states of a time have in common. Refers to all of it.
struct CheckContext {
  const SceneSnapshot& scene;
  const CheckOptions& options;
  const std::set<std::pair<int, ObjectId>>& allowed_contacts;
  const std::vector<PlacedObject>& objects;
  const Cancelled& cancelled;  // once true, answers mean nothing
};

// A state under check. Lives on one thread's stack.
class StateCheck {
 public:
  // T_W_L: one pose per link.
  StateCheck(const CheckContext& context, const RobotGeometry& robot, const Pose* T_W_L);

  // The whole rule, in the order of precedence of SpaceStatus.
  StateAnswer Answer() const;

 private:
  struct Touch {
    int link;
    ObjectId object;
  };

  std::optional<Touch> OutOfBounds() const;
  std::optional<Touch> Occupied() const;
  std::optional<Touch> BeyondHorizon() const;
  std::optional<Touch> Unobserved() const;
  double UnknownShare() const;
  double Clearance() const;

  bool Allowed(int link, ObjectId object) const;
  bool TouchesStatic(int link) const;
  bool TouchesObject(int link, const PlacedObject& object) const;
  double StaticDistance(int link, double up_to_m) const;

  const CheckContext& context_;
  std::vector<std::vector<PlacedShape>> links_W_;
};

}  // namespace clearway
