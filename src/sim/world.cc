#include "clearway/sim/world.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <variant>

#include "clearway/geometry/distance.h"
#include "clearway/geometry/solid_mesh.h"
#include "sim/convex.h"

namespace clearway {

Body Body::Single(ObjectId id, std::string name, Shape shape, Trajectory trajectory) {
  return {id, std::move(name), {{std::move(shape), Pose()}}, std::move(trajectory)};
}

Aabb Body::BoxB() const {
  Aabb box_B;
  for (const BodyPart& part : parts) {
    box_B.Extend(Transformed(part.T_B_G, BoundingBox(part.shape)));
  }
  return box_B;
}

double SurfaceDistance(const Eigen::Vector3d& p_B, const Body& body) {
  double outside_m = std::numeric_limits<double>::infinity(), inside_m = -1;
  for (const BodyPart& part : body.parts) {
    const Eigen::Vector3d p_G = Inverse(part.T_B_G) * p_B;
    const double distance_m = SurfaceDistance(p_G, part.shape);
    if (Contains(part.shape, p_G)) {
      inside_m = std::max(inside_m, distance_m);
    } else {
      outside_m = std::min(outside_m, distance_m);
    }
  }
  return inside_m >= 0 ? inside_m : outside_m;
}

World::World(std::vector<Body> bodies) {
  for (Body& body : bodies) Add(std::move(body));
}

void World::Add(Body body) {
  for (BodyPart& part : body.parts) {
    if (auto* mesh = std::get_if<TriangleMesh>(&part.shape)) {
      mesh->mesh = SolidMeshOf(mesh->mesh).mesh;
    }
  }
  bodies_.push_back(std::move(body));
}

std::vector<ObjectId> World::ObjectIds() const {
  std::vector<ObjectId> ids;
  for (const Body& body : bodies_) {
    if (body.id > kStaticLabel) ids.push_back(body.id);
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

std::vector<const Body*> World::PartsOf(ObjectId whole) const {
  std::vector<const Body*> parts;
  for (const Body& body : bodies_) {
    if (whole != kStaticLabel && body.part_of == whole) parts.push_back(&body);
  }
  std::ranges::sort(parts, {}, &Body::id);
  return parts;
}

const Body* World::FindObject(ObjectId id) const {
  if (id <= kStaticLabel) return nullptr;
  const auto found = std::find_if(bodies_.begin(), bodies_.end(),
                                  [id](const Body& body) { return body.id == id; });
  return found == bodies_.end() ? nullptr : &*found;
}

std::optional<Pose> World::T_W_B(ObjectId id, Time t) const {
  const Body* body = FindObject(id);
  if (body == nullptr) return std::nullopt;
  return PoseAt(body->trajectory, t);
}

std::optional<Pose> World::MotionOf(ObjectId id, Time from, Time to) const {
  const Body* body = FindObject(id);
  if (body == nullptr) return std::nullopt;
  return PoseAt(body->trajectory, to) * Inverse(PoseAt(body->trajectory, from));
}

std::optional<ObjectId> World::ObjectAt(const Eigen::Vector3d& p_W, Time t) const {
  return WorldAtTime(*this, t).ObjectAt(p_W);
}

std::optional<ObjectId> World::Touched(const Shape& shape, const Pose& T_W_G, Time t) const {
  return WorldAtTime(*this, t).Touched(shape, T_W_G);
}

WorldAtTime::WorldAtTime(const World& world, Time t) {
  for (const Body& body : world.bodies()) {
    const Pose T_W_B = PoseAt(body.trajectory, t);
    for (const BodyPart& part : body.parts) {
      const Pose T_W_G = T_W_B * part.T_B_G;
      // Padded, so that rounding of the box never decides.
      const Aabb box_W = Transformed(T_W_G, BoundingBox(part.shape)).Padded(1e-6);
      placed_.push_back({body.id, &part, T_W_G, Inverse(T_W_G), box_W});
    }
  }
  const auto rank = [](ObjectId id) {
    return id == kStaticLabel ? std::numeric_limits<ObjectId>::max() : id;
  };
  std::stable_sort(placed_.begin(), placed_.end(),
                   [&](const Placed& a, const Placed& b) { return rank(a.id) < rank(b.id); });
}

std::optional<ObjectId> WorldAtTime::ObjectAt(const Eigen::Vector3d& p_W) const {
  for (const Placed& placed : placed_) {
    if (placed.box_W.Contains(p_W) && Contains(placed.part->shape, placed.T_G_W * p_W)) {
      return placed.id;
    }
  }
  return std::nullopt;
}

std::optional<ObjectId> WorldAtTime::Touched(const Shape& shape, const Pose& T_W_G) const {
  const Aabb box_W = Transformed(T_W_G, BoundingBox(shape));
  for (const Placed& placed : placed_) {
    if (placed.box_W.Intersects(box_W) && Touch(shape, T_W_G, placed.part->shape, placed.T_W_G)) {
      return placed.id;
    }
  }
  return std::nullopt;
}

}  // namespace clearway
