#include "collision/brute_geometry.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>

namespace clearway {
namespace {

constexpr double kUnsure_m = 1e-6;

FclGeometry Convex(const Mesh& mesh, const Eigen::Vector3d& center, double scale) {
  auto vertices = std::make_shared<std::vector<Eigen::Vector3d>>();
  for (const Eigen::Vector3d& v : mesh.vertices) vertices->push_back(center + scale * (v - center));
  auto faces = std::make_shared<std::vector<int>>();
  for (const auto& [a, b, c] : mesh.triangles) {
    faces->insert(faces->end(), {3, static_cast<int>(a), static_cast<int>(b), static_cast<int>(c)});
  }
  return std::make_shared<fcl::Convexd>(vertices, static_cast<int>(mesh.triangles.size()), faces);
}

FclGeometry Surface(const Mesh& mesh) {
  auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  std::vector<fcl::Triangle> triangles;
  for (const auto& [a, b, c] : mesh.triangles) triangles.emplace_back(a, b, c);
  model->beginModel();
  model->addSubModel(mesh.vertices, triangles);
  model->endModel();
  return model;
}

}  // namespace

// In every size, by this.
Shape Grown(Shape shape, double by_m) {
  if (auto* sphere = std::get_if<Sphere>(&shape)) sphere->radius_m += by_m;
  if (auto* box = std::get_if<Box>(&shape)) box->size_m.array() += by_m;
  if (auto* capsule = std::get_if<Capsule>(&shape)) capsule->radius_m += by_m;
  if (auto* cylinder = std::get_if<Cylinder>(&shape)) {
    cylinder->radius_m += by_m;
    cylinder->length_m += by_m;
  }
  return shape;
}

FclGeometry GeometryOf(const Shape& shape) {
  if (const auto* s = std::get_if<Sphere>(&shape))
    return std::make_shared<fcl::Sphered>(s->radius_m);
  if (const auto* b = std::get_if<Box>(&shape)) return std::make_shared<fcl::Boxd>(b->size_m);
  if (const auto* c = std::get_if<Capsule>(&shape)) {
    return std::make_shared<fcl::Capsuled>(c->radius_m, c->length_m);
  }
  if (const auto* c = std::get_if<Cylinder>(&shape)) {
    return std::make_shared<fcl::Cylinderd>(c->radius_m, c->length_m);
  }
  if (const auto* c = std::get_if<ConvexPolytope>(&shape)) {
    return Convex(*c->mesh, Eigen::Vector3d::Zero(), 1);
  }
  return Surface(*std::get<TriangleMesh>(shape).mesh);
}

double RadiusOf(const Shape& shape) {
  const Aabb box = BoundingBox(shape);
  return box.min.cwiseAbs().cwiseMax(box.max.cwiseAbs()).norm();
}

Eigen::Isometry3d AsIsometry(const Pose& pose) {
  return Eigen::Translation3d(pose.translation) * pose.rotation.normalized();
}

Sizes BoxSizes(const Eigen::Vector3d& size) {
  const auto grown = [&](double by) {
    return std::make_shared<fcl::Boxd>((size.array() + by).matrix());
  };
  return {grown(-kUnsure_m), grown(0), grown(kUnsure_m)};
}

Sizes BallSizes(double radius_m) {
  const auto grown = [&](double by) { return std::make_shared<fcl::Sphered>(radius_m + by); };
  return {grown(-kUnsure_m), grown(0), grown(kUnsure_m)};
}

Sizes SolidSizes(const Solid& solid) {
  if (std::holds_alternative<ConvexPolytope>(solid.shape)) {
    const double relative = kUnsure_m / (0.5 * solid.box_O.Size().minCoeff());
    const auto grown = [&](double by) { return Convex(*solid.hull, solid.box_O.Center(), 1 + by); };
    return {grown(-relative), grown(0), grown(relative)};
  }
  const auto grown = [&](double by) { return GeometryOf(Grown(solid.shape, by)); };
  return {grown(-kUnsure_m), grown(0), grown(kUnsure_m)};
}

double Distance(const RobotBody& body, const FclGeometry& obstacle,
                const Eigen::Isometry3d& pose_W) {
  const bool is_mesh = std::holds_alternative<TriangleMesh>(*body.shape);
  if (is_mesh) {  // FCL knows the surface alone, and its mesh-sphere distances are not 0 in contact
    if (Contains(*body.shape, body.pose_W.inverse() * pose_W.translation())) return 0;
    fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    if (fcl::collide(body.geometry.get(), body.pose_W, obstacle.get(), pose_W, request, result) > 0)
      return 0;
  }
  fcl::DistanceRequestd request;
  request.distance_tolerance = 1e-12;
  fcl::DistanceResultd result;
  return std::max(0.0, fcl::distance(body.geometry.get(), body.pose_W, obstacle.get(), pose_W,
                                     request, result));
}

Verdict Touches(const RobotBody& body, const Obstacle& obstacle, double margin_m) {
  const double distance_m = Distance(body, obstacle.geometry.exact, obstacle.pose_W);
  if (distance_m > margin_m + 1e-4) return Verdict::kApart;
  if (Distance(body, obstacle.geometry.smaller, obstacle.pose_W) <= margin_m) {
    return Verdict::kTouching;
  }
  return Distance(body, obstacle.geometry.larger, obstacle.pose_W) > margin_m ? Verdict::kApart
                                                                              : Verdict::kUnsure;
}

}  // namespace clearway
