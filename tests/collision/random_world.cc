#include "collision/random_world.h"

#include <numbers>

#include "clearway/geometry/hull.h"

namespace clearway {
namespace {

const Aabb kRegion{{-1.6, -1.6, -0.8}, {1.6, 1.6, 0.8}};

// A closed, non-convex mesh: a prism over an L.
std::shared_ptr<const Mesh> EllMesh(double size_m) {
  const double s = size_m;
  const Eigen::Vector2d outline[6] = {{-s, -s}, {s, -s}, {s, 0}, {0, 0}, {0, s}, {-s, s}};
  auto mesh = std::make_shared<Mesh>();
  for (double z : {-s, s}) {
    for (const Eigen::Vector2d& p : outline) mesh->vertices.emplace_back(p.x(), p.y(), z);
  }
  for (const auto& [a, b, c] : {std::array{0u, 1u, 3u}, std::array{1u, 2u, 3u},
                                std::array{0u, 3u, 5u}, std::array{3u, 4u, 5u}}) {
    mesh->triangles.push_back({a, c, b});
    mesh->triangles.push_back({a + 6, b + 6, c + 6});
  }
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t next = (i + 1) % 6;
    mesh->triangles.push_back({i, next, next + 6});
    mesh->triangles.push_back({i, next + 6, i + 6});
  }
  return mesh;
}

}  // namespace

Eigen::Vector3d RandomWorld::Point(const Aabb& box) {
  Eigen::Vector3d p;
  for (int axis = 0; axis < 3; ++axis) p[axis] = Uniform(box.min[axis], box.max[axis]);
  return p;
}

Pose RandomWorld::AnyPose(const Aabb& box) {
  const Eigen::Vector3d axis = Point({{-1, -1, -1}, {1, 1, 1}}).normalized();
  const double angle = Uniform(0, std::numbers::pi);
  return {Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis)), Point(box)};
}

std::vector<VoxelKey> RandomWorld::Blob() {
  std::vector<VoxelKey> keys;
  for (int part = 0; part < 2; ++part) {
    const VoxelKey low{Below(4) - 2, Below(4) - 2, Below(3) - 1};
    const VoxelKey high{low.x + 1 + Below(3), low.y + 1 + Below(3), low.z + 1 + Below(2)};
    for (const VoxelKey& key : VoxelCuboid(low, high)) keys.push_back(key);
  }
  return keys;
}

// One to four poses, sometimes at rest in the end.
std::vector<StampedPose> RandomWorld::Future(double after_s) {
  std::vector<StampedPose> poses;
  double stamp_s = after_s;
  for (int left = 1 + Below(4); left > 0; --left) {
    stamp_s += Uniform(0.1, 0.9);
    poses.push_back({TestTime(stamp_s), AnyPose(kRegion)});
  }
  if (Below(3) == 0) poses.push_back({TestTime(stamp_s + 0.2), poses.back().T_W_O});
  return poses;
}

ScenePtr RandomWorld::Scene() {
  SceneParams params;
  params.resolution_m = Below(2) ? 0.2 : 0.16;
  params.object_resolution_m = 0.15;
  params.solid = static_cast<SolidMode>(Below(3));
  params.horizon = std::chrono::seconds(2);
  params.bounds_W = kRegion.Padded(0.5);
  if (Below(2)) {
    const Eigen::Vector3d corner = Point(kRegion);
    params.keep_out_W = {{corner, corner + Point({{0.1, 0.1, 0.1}, {0.5, 0.5, 0.5}})}};
  }
  TestWorld world(params);
  world.Free(kRegion);
  for (int i = 0; i < 5; ++i) {
    const Eigen::Vector3d corner = Point(kRegion);
    world.Occupied({corner, corner + Point({{0.1, 0.1, 0.1}, {0.5, 0.5, 0.5}})});
    const Eigen::Vector3d hidden = Point(kRegion);
    world.Unknown({hidden, hidden + Point({{0.1, 0.1, 0.1}, {0.6, 0.6, 0.6}})});
  }
  for (ObjectId id : {2, 3, 7, 40}) {
    const Pose first = AnyPose(kRegion);
    Twist velocity{Point({{-1, -1, -1}, {1, 1, 1}}), Point({{-1, -1, -1}, {1, 1, 1}})};
    if (id == 3 && Below(2)) velocity = Twist{};
    const double stamp_s = Uniform(-0.5, 0);
    world.Object(id, Blob(),
                 {{TestTime(stamp_s - 1), first}, {TestTime(stamp_s), first * Exp(velocity)}},
                 id == 40 ? std::nullopt : std::optional(velocity));
    if (Below(2)) world.Bound({Uniform(0, 0.1), Uniform(0, 0.1), Uniform(0, 0.2)});
    if (id == 7 && Below(2)) world.Future(Future(stamp_s));
  }
  const Twist velocity{Point({{-1, -1, -1}, {1, 1, 1}}), Point({{-1, -1, -1}, {1, 1, 1}})};
  if (Below(2)) world.Given(41, ShapeOfKind(Below(5)), AnyPose(kRegion), velocity);
  if (Below(2)) world.Given(43, ShapeOfKind(Below(5)), AnyPose(kRegion), {}, Future(0));
  return world.Scene();
}

Shape RandomWorld::AnyShape() { return ShapeOfKind(Below(std::variant_size_v<Shape>)); }

Shape RandomWorld::ShapeOfKind(std::size_t kind) {
  switch (kind) {
    case 0:
      return Sphere{Uniform(0.05, 0.4)};
    case 1:
      return Box{Point({{0.05, 0.05, 0.05}, {0.8, 0.8, 0.8}})};
    case 2:
      return Capsule{Uniform(0.05, 0.2), Uniform(0.1, 0.6)};
    case 3:
      return Cylinder{Uniform(0.05, 0.3), Uniform(0.1, 0.6)};
    case 4: {
      std::vector<Eigen::Vector3d> points;
      for (int i = 0; i < 12; ++i) points.push_back(Point({{-0.4, -0.4, -0.4}, {0.4, 0.4, 0.4}}));
      return ConvexPolytope{std::make_shared<const Mesh>(ConvexHullOf(points))};
    }
    default:
      return TriangleMesh{EllMesh(Uniform(0.1, 0.4))};
  }
}

Robot RandomWorld::AnyRobot() {
  Robot robot{"random", {}};
  const int links = 1 + Below(3);
  for (int l = 0; l < links; ++l) {
    Link& link = robot.links.emplace_back();
    const int shapes = 1 + Below(2);
    for (int s = 0; s < shapes; ++s) {
      link.shapes.push_back({AnyShape(), AnyPose({{-0.2, -0.2, -0.2}, {0.2, 0.2, 0.2}})});
    }
  }
  return robot;
}

StateBatch RandomWorld::States(const Robot& robot, int count) {
  constexpr double kTimes_s[] = {-2, -0.7, 0, 0.8, 1.6, 2.5};
  StateBatch states;
  for (int s = 0; s < count; ++s) {
    states.times.push_back(TestTime(kTimes_s[Below(6)]));
    const Pose T_W_base = AnyPose(kRegion);
    for (std::size_t l = 0; l < robot.links.size(); ++l) {
      states.T_W_L.push_back(T_W_base * AnyPose({{-0.3, -0.3, -0.3}, {0.3, 0.3, 0.3}}));
    }
  }
  return states;
}

CheckOptions RandomWorld::Options(const Robot& robot) {
  CheckOptions options;
  options.unknown = static_cast<UnknownPolicy>(Below(3));
  options.max_unknown_fraction = Uniform(0, 0.5);
  options.with_unknown_fraction = Below(2);
  if (Below(2)) {
    const Eigen::Vector3d corner = Point(kRegion);
    options.known_free_W = {{corner, corner + Eigen::Vector3d::Constant(0.8)}};
  }
  if (Below(2)) options.padding_m = Uniform(0, 0.2);
  if (Below(2)) options.inflation_mps = Uniform(0, 0.1);
  if (Below(2)) options.bound_multiple = Uniform(0, 1.5);
  options.inflate_moving_only = Below(2);
  if (Below(3) == 0) options.ignored_objects = {3, 17};
  if (Below(3) == 0) {
    const int link = Below(static_cast<int>(robot.links.size()));
    options.allowed_contacts = {{link, kStaticLabel}, {link, 2}};
  }
  if (Below(3) != 0) options.clearance_up_to_m = Uniform(0.1, 0.6);
  return options;
}

}  // namespace clearway
