// One robot state against one scene at one time.
#pragma once

#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "clearway/collision/state_checker.h"
#include "collision/narrowphase.h"
#include "collision/placed_object.h"
#include "collision/robot_geometry.h"
#include "collision/voxel_search.h"

namespace clearway {

// What all states have in common. Refers to all of it.
struct CheckContext {
  const SceneSnapshot& scene;
  const CheckOptions& options;
  const std::set<std::pair<int, ObjectId>>& allowed_contacts;
  ObjectPlacer& objects;
  const Cancelled& cancelled;  // once true, answers mean nothing
};

// Checks one state after the other. Lives on one thread's stack.
class StateCheck {
 public:
  StateCheck(const CheckContext& context, const RobotGeometry& robot);

  // The whole rule. T_W_L: one pose per link. The answer is written where it is to stay: to copy
  // what was just written in smaller pieces stalls the processor (failed store forwarding).
  void Answer(Time time, const Pose* T_W_L, StateAnswer& answer);

 private:
  void Place(const Pose* T_W_L);
  Aabb SearchedBox() const;  // what lies beyond does not matter to the answer
  std::span<const PlacedShape> ShapesOf(int link) const;
  int links() const { return static_cast<int>(robot_.links().size()); }

  // In the order of precedence of SpaceStatus, within bounds; as those below, it names in `answer`
  // what made it so.
  SpaceStatus Status(StateAnswer& answer) const;
  bool OutOfBounds(StateAnswer& answer) const;
  bool Occupied(StateAnswer& answer) const;
  bool BeyondHorizon(StateAnswer& answer) const;
  bool Unobserved(StateAnswer& answer) const;
  // Always true.
  static bool Blame(int link, ObjectId object, StateAnswer& answer) {
    answer.link = link;
    answer.object = object;
    return true;
  }
  double UnknownShare() const;
  double Clearance() const;

  double ContactMargin() const;  // what is no farther is in contact
  bool Allowed(int link, ObjectId object) const;
  bool TouchesStatic(int link) const;
  bool TouchesObject(int link, const PlacedObject& object) const;
  double StaticDistance(int link, double up_to_m) const;

  const CheckContext& context_;
  const RobotGeometry& robot_;
  Aabb bounds_W_;                          // within which voxels can be told
  std::vector<PlacedShape> shapes_W_;      // link by link
  std::vector<std::size_t> first_shapes_;  // of each link, and the end
  const std::vector<PlacedObject>* objects_ = nullptr;
};

}  // namespace clearway
