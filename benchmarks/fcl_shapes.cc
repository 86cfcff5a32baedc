#include "fcl_shapes.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <cmath>
#include <numbers>

namespace clearway::bench {
namespace {

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

// A dented ball: 25 rings of 20 corners between two poles give 1,000 triangles.
std::shared_ptr<const Mesh> DentedBall() {
  constexpr int kRings = 25, kCorners = 20;
  auto mesh = std::make_shared<Mesh>();
  for (int ring = 1; ring <= kRings; ++ring) {
    for (int corner = 0; corner < kCorners; ++corner) {
      const double polar = std::numbers::pi * ring / (kRings + 1);
      const double azimuth = 2 * std::numbers::pi * corner / kCorners;
      const double radius_m = 0.5 + 0.08 * std::sin(3 * azimuth) * std::sin(4 * polar);
      mesh->vertices.emplace_back(radius_m * std::sin(polar) * std::cos(azimuth),
                                  radius_m * std::sin(polar) * std::sin(azimuth),
                                  radius_m * std::cos(polar));
    }
  }
  const auto at = [](int ring, int corner) -> std::uint32_t {
    return (ring - 1) * kCorners + corner % kCorners;
  };
  const auto top = static_cast<std::uint32_t>(mesh->vertices.size());
  mesh->vertices.emplace_back(0, 0, 0.5);
  mesh->vertices.emplace_back(0, 0, -0.5);
  for (int corner = 0; corner < kCorners; ++corner) {
    mesh->triangles.push_back({top, at(1, corner), at(1, corner + 1)});
    mesh->triangles.push_back({top + 1, at(kRings, corner + 1), at(kRings, corner)});
    for (int ring = 1; ring < kRings; ++ring) {
      mesh->triangles.push_back({at(ring, corner), at(ring + 1, corner), at(ring, corner + 1)});
      mesh->triangles.push_back(
          {at(ring, corner + 1), at(ring + 1, corner), at(ring + 1, corner + 1)});
    }
  }
  return mesh;
}

Geometry ToFcl(const Shape& shape) {
  if (const auto* box = std::get_if<Box>(&shape)) return std::make_shared<fcl::Boxd>(box->size_m);
  if (const auto* ball = std::get_if<Sphere>(&shape)) {
    return std::make_shared<fcl::Sphered>(ball->radius_m);
  }
  if (const auto* capsule = std::get_if<Capsule>(&shape)) {
    return std::make_shared<fcl::Capsuled>(capsule->radius_m, capsule->length_m);
  }
  const Mesh& mesh = *std::get<TriangleMesh>(shape).mesh;
  auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  std::vector<fcl::Triangle> triangles;
  for (const auto& [a, b, c] : mesh.triangles) triangles.emplace_back(a, b, c);
  model->beginModel(static_cast<int>(triangles.size()), static_cast<int>(mesh.vertices.size()));
  model->addSubModel(mesh.vertices, triangles);
  model->endModel();
  return model;
}

Eigen::Isometry3d ToIsometry(const Pose& pose) {
  Eigen::Isometry3d isometry(pose.rotation);
  isometry.pretranslate(pose.translation);
  return isometry;
}

}  // namespace

std::vector<NamedShape> BenchShapes() {
  return {{"box", Box{{4, 1.8, 1.5}}},
          {"sphere", Sphere{0.3}},
          {"capsule", Capsule{0.2, 0.8}},
          {"mesh", TriangleMesh{DentedBall()}}};
}

struct FclChecker::Impl {
  Geometry shape;
  std::shared_ptr<fcl::OcTreed> tree;
};

FclChecker::FclChecker(const Shape& shape, std::shared_ptr<const octomap::OcTree> tree)
    : impl_(std::make_unique<const Impl>(
          Impl{ToFcl(shape), std::make_shared<fcl::OcTreed>(std::move(tree))})) {
  impl_->shape->computeLocalAABB();
  impl_->tree->computeLocalAABB();
}
FclChecker::~FclChecker() = default;

bool FclChecker::Collides(const Pose& T_W_G) const {
  fcl::CollisionResultd result;
  return fcl::collide(impl_->shape.get(), ToIsometry(T_W_G), impl_->tree.get(),
                      Eigen::Isometry3d::Identity(), fcl::CollisionRequestd(), result) > 0;
}

double FclChecker::Distance(const Pose& T_W_G, double up_to_m) const {
  fcl::DistanceResultd result(up_to_m);
  return fcl::distance(impl_->shape.get(), ToIsometry(T_W_G), impl_->tree.get(),
                       Eigen::Isometry3d::Identity(), fcl::DistanceRequestd(), result);
}

}  // namespace clearway::bench
