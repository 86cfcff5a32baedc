// A simulated world, and the truth about it.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "clearway/geometry/aabb.h"
#include "clearway/geometry/shape.h"
#include "clearway/scene/frame.h"
#include "clearway/sim/trajectory.h"

namespace clearway {

// One shape of a body.
struct BodyPart {
  Shape shape;
  Pose T_B_G = {};  // the shape's frame G in the body's frame B
};

// A rigid thing of one or several shapes, all of them solid. A plain value.
struct Body {
  ObjectId id = kStaticLabel;  // 0: part of the static world; else unique and above 0
  std::string name = {};       // for people
  std::vector<BodyPart> parts = {};
  Trajectory trajectory = {};       // of B; bodies with id 0 must be FixedPose
  ObjectId part_of = kStaticLabel;  // the object whose part it is, if of one

  static Body Single(ObjectId id, std::string name, Shape shape, Trajectory trajectory);

  // The box in B around all parts: an object's true dimensions.
  Aabb BoxB() const;
};

// From a point in B, inside or outside, to the body's surface; less inside several parts at once.
double SurfaceDistance(const Eigen::Vector3d& p_B, const Body& body);

// Bodies with their trajectories: where everything is at every time. A value; any thread may read
// it.
class World {
 public:
  World() = default;
  explicit World(std::vector<Body> bodies);

  // Meshes count as the solids that they enclose (see SolidMeshOf).
  void Add(Body body);
  std::span<const Body> bodies() const { return bodies_; }

  // The ids above 0, ascending.
  std::vector<ObjectId> ObjectIds() const;
  // Of that object, ascending ids.
  std::vector<const Body*> PartsOf(ObjectId whole) const;
  // Null if there is no such object, or for id 0.
  const Body* FindObject(ObjectId id) const;

  // The exact pose; none for an unknown id.
  std::optional<Pose> T_W_B(ObjectId id, Time t) const;
  // H_W with T_W_B(to) = H_W * T_W_B(from); none for an unknown id.
  std::optional<Pose> MotionOf(ObjectId id, Time from, Time to) const;

  // As WorldAtTime; for many questions at one time make one of those.
  std::optional<ObjectId> ObjectAt(const Eigen::Vector3d& p_W, Time t) const;
  std::optional<ObjectId> Touched(const Shape& shape, const Pose& T_W_G, Time t) const;

 private:
  std::vector<Body> bodies_;
};

// A world at one time: ground truth for points and shapes. Immutable; any thread may read it. It
// must not outlive the world.
class WorldAtTime {
 public:
  WorldAtTime(const World& world, Time t);

  // What contains the point (boundaries included): the lowest id above 0, else 0 for a static body,
  // else none.
  std::optional<ObjectId> ObjectAt(const Eigen::Vector3d& p_W) const;

  // What the shape, placed at T_W_G, touches: the lowest id above 0, else 0 for a static body, else
  // none. Gaps below about 1e-9 m count as contact; triangle meshes count with their inside. It
  // shares no code with the checkers of the collision layer, so that they can be judged by it.
  std::optional<ObjectId> Touched(const Shape& shape, const Pose& T_W_G) const;

 private:
  struct Placed {
    ObjectId id;
    const BodyPart* part;
    Pose T_W_G;
    Pose T_G_W;
    Aabb box_W;
  };
  std::vector<Placed> placed_;  // objects by id, then the static bodies
};

}  // namespace clearway
