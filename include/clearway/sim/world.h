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
  Pose T_B_G;  // the shape's frame G in the body's frame B
};

// A rigid thing of one or several shapes, all of them solid. A plain value.
struct Body {
  ObjectId id = kStaticLabel;  // 0: part of the static world; else unique and above 0
  std::string name;            // for people
  std::vector<BodyPart> parts;
  Trajectory trajectory;  // of B; bodies with id 0 must be FixedPose

  static Body Single(ObjectId id, std::string name, Shape shape, Trajectory trajectory);

  // The smallest box in B around all parts: an object's true dimensions.
  Aabb BoxB() const;
};

// Bodies with their trajectories, at every time. A value; any thread may read it.
class World {
 public:
  World() = default;
  explicit World(std::vector<Body> bodies) : bodies_(std::move(bodies)) {}

  void Add(Body body) { bodies_.push_back(std::move(body)); }
  std::span<const Body> bodies() const { return bodies_; }

  // The ids above 0, ascending.
  std::vector<ObjectId> ObjectIds() const;
  // Null if there is no such object, or for id 0.
  const Body* FindObject(ObjectId id) const;

  // Exact pose; none for an unknown id.
  std::optional<Pose> T_W_B(ObjectId id, Time t) const;
  // H_W with T_W_B(to) = H_W * T_W_B(from); none for an unknown id.
  std::optional<Pose> MotionOf(ObjectId id, Time from, Time to) const;

  // What contains the point at time t (boundaries included): the lowest id above 0, else 0 for a
  // static body, else none.
  std::optional<ObjectId> ObjectAt(const Eigen::Vector3d& p_W, Time t) const;
  // Whether this one body contains it.
  static bool Contains(const Body& body, const Eigen::Vector3d& p_W, Time t);

  // What the shape, placed at T_W_G, touches at time t: the lowest id above 0, else 0 for a static
  // body, else none. Exact for convex shapes to about 1e-9 m; triangle meshes count with their
  // inside.
  std::optional<ObjectId> Touched(const Shape& shape, const Pose& T_W_G, Time t) const;

  // The world-aligned box around the body at time t.
  static Aabb BoxW(const Body& body, Time t);

 private:
  std::vector<Body> bodies_;
};

}  // namespace clearway
