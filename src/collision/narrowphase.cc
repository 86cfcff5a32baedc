#include "collision/narrowphase.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <limits>

#include "clearway/geometry/hull.h"
#include "collision/closed_form.h"
#include "collision/contact_if_thrown.h"

namespace clearway {
namespace {

using FclGeometry = fcl::CollisionGeometryd;

// libccd's iterations stop at this change of the distance. With FCL's default of 1e-6 distances to
// cylinders are wrong by up to 0.25 mm; with this one by less than 1e-9 m, in 1.5 times the time.
// (The independent solver of FCL is not used: single box distances were off by 0.4 mm and more.)
constexpr double kSolverTolerance = 1e-12;

std::shared_ptr<FclGeometry> MakeConvex(const Mesh& mesh) {
  auto faces = std::make_shared<std::vector<int>>();
  for (const auto& triangle : mesh.triangles) {
    faces->push_back(3);
    for (std::uint32_t index : triangle) faces->push_back(static_cast<int>(index));
  }
  return std::make_shared<fcl::Convexd>(
      std::make_shared<std::vector<Eigen::Vector3d>>(mesh.vertices),
      static_cast<int>(mesh.triangles.size()), faces);
}

std::shared_ptr<FclGeometry> MakeMesh(const Mesh& mesh) {
  auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  std::vector<fcl::Triangle> triangles;
  for (const auto& [a, b, c] : mesh.triangles) triangles.emplace_back(a, b, c);
  model->beginModel(static_cast<int>(triangles.size()), static_cast<int>(mesh.vertices.size()));
  model->addSubModel(mesh.vertices, triangles);
  model->endModel();
  return model;
}

struct MakeFcl {
  std::shared_ptr<FclGeometry> operator()(const Sphere& s) const {
    return std::make_shared<fcl::Sphered>(s.radius_m);
  }
  std::shared_ptr<FclGeometry> operator()(const Box& b) const {
    return std::make_shared<fcl::Boxd>(b.size_m);
  }
  std::shared_ptr<FclGeometry> operator()(const Capsule& c) const {
    return std::make_shared<fcl::Capsuled>(c.radius_m, c.length_m);
  }
  std::shared_ptr<FclGeometry> operator()(const Cylinder& c) const {
    return std::make_shared<fcl::Cylinderd>(c.radius_m, c.length_m);
  }
  std::shared_ptr<FclGeometry> operator()(const ConvexPolytope& c) const {
    return MakeConvex(*c.mesh);
  }
  std::shared_ptr<FclGeometry> operator()(const TriangleMesh& t) const { return MakeMesh(*t.mesh); }
};

std::vector<Eigen::Vector3d> CornersOf(const Shape& shape) {
  if (const auto* hull = std::get_if<ConvexPolytope>(&shape)) return hull->mesh->vertices;
  const auto* mesh = std::get_if<TriangleMesh>(&shape);
  if (mesh == nullptr) return {};
  std::vector<Eigen::Vector3d> corners = ConvexHullOf(mesh->mesh->vertices).vertices;
  return corners.empty() ? mesh->mesh->vertices : corners;  // a flat mesh has no hull
}

// Two bodies as FCL takes them. Their poses are relative to the obstacle's centre, so that nothing
// is lost far from the origin.
struct Pair {
  const FclGeometry* shape;
  Eigen::Isometry3d shape_pose;
  const FclGeometry* obstacle;
  Eigen::Isometry3d obstacle_pose;
};

Eigen::Isometry3d Placement(const Eigen::Matrix3d& R, const Eigen::Vector3d& t) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = R;
  pose.translation() = t;
  return pose;
}

bool Collide(const Pair& pair) {
  fcl::CollisionRequestd request;
  request.gjk_tolerance = kSolverTolerance;
  fcl::CollisionResultd result;
  return fcl::collide(pair.shape, pair.shape_pose, pair.obstacle, pair.obstacle_pose, request,
                      result) > 0;
}

double Distance(const Pair& pair) {
  fcl::DistanceRequestd request;
  request.distance_tolerance = kSolverTolerance;
  fcl::DistanceResultd result;
  // Negative in contact.
  return std::max(0.0, fcl::distance(pair.shape, pair.shape_pose, pair.obstacle, pair.obstacle_pose,
                                     request, result));
}

}  // namespace

struct ShapeGeometry::Fcl {
  std::shared_ptr<const FclGeometry> geometry;
};

ShapeGeometry::ShapeGeometry(const Shape& shape)
    : shape_(shape),
      box_G_(BoundingBox(shape)),
      corners_G_(std::make_shared<const std::vector<Eigen::Vector3d>>(CornersOf(shape))) {
  std::shared_ptr<FclGeometry> geometry = std::visit(MakeFcl{}, shape);
  geometry->computeLocalAABB();
  fcl_ = std::make_shared<const Fcl>(Fcl{std::move(geometry)});
}

PlacedShape::PlacedShape(const ShapeGeometry& geometry, const Pose& T_F_G)
    : geometry_(&geometry),
      T_F_G_{T_F_G.rotation.normalized(), T_F_G.translation},
      R_F_G_(T_F_G_.rotation.toRotationMatrix()),
      box_F_(TightBox()) {}

Aabb PlacedShape::TightBox() const {
  const Shape& shape = geometry_->shape();
  Eigen::Vector3d half;
  const Eigen::Vector3d axis = R_F_G_.col(2).cwiseAbs();
  if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    half = Eigen::Vector3d::Constant(sphere->radius_m);
  } else if (const auto* box = std::get_if<Box>(&shape)) {
    half = R_F_G_.cwiseAbs() * (0.5 * box->size_m);
  } else if (const auto* capsule = std::get_if<Capsule>(&shape)) {
    half = (axis * capsule->length_m / 2).array() + capsule->radius_m;
  } else if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
    half = axis * cylinder->length_m / 2 +
           (1 - axis.array().square()).max(0).sqrt().matrix() * cylinder->radius_m;
  } else {
    Aabb around;
    for (const Eigen::Vector3d& corner_G : geometry_->corners_G()) {
      around.Extend(R_F_G_ * corner_G + origin_F());
    }
    return around;
  }
  return {origin_F() - half, origin_F() + half};
}

bool PlacedShape::Contains(const Eigen::Vector3d& p_F) const {
  return clearway::Contains(geometry_->shape(), ToG(p_F));
}

std::optional<Eigen::Vector3d> PlacedShape::FromNearestPoint(const Eigen::Vector3d& p_F) const {
  const auto* cylinder = std::get_if<Cylinder>(&geometry_->shape());
  if (cylinder == nullptr) return std::nullopt;
  const Eigen::Vector3d p_G = ToG(p_F);
  return R_F_G_ * (p_G - NearestPoint(p_G, *cylinder));
}

std::optional<RoundedBox> PlacedShape::AsRoundedBox() const {
  const Shape& shape = geometry_->shape();
  if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    return RoundedBox{R_F_G_, origin_F(), Eigen::Vector3d::Zero(), sphere->radius_m};
  }
  if (const auto* box = std::get_if<Box>(&shape)) {
    return RoundedBox{R_F_G_, origin_F(), 0.5 * box->size_m, 0};
  }
  if (const auto* capsule = std::get_if<Capsule>(&shape)) {
    return RoundedBox{R_F_G_, origin_F(), {0, 0, 0.5 * capsule->length_m}, capsule->radius_m};
  }
  return std::nullopt;
}

// The gap along F's axes, or that along G's.
double PlacedShape::LowerBound(const Aabb& box_F) const {
  const double in_F_m = BoxBoxDistance(box_F_, box_F);
  const Eigen::Vector3d center_G = ToG(box_F.Center());
  const Eigen::Vector3d half_G = R_F_G_.transpose().cwiseAbs() * (0.5 * (box_F.max - box_F.min));
  return std::max(in_F_m,
                  BoxBoxDistance(geometry_->box_G(), {center_G - half_G, center_G + half_G}));
}

double PlacedShape::DistanceTo(const Aabb& box_F, double up_to_m) const {
  const Shape& shape = geometry_->shape();
  if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    return std::max(0.0, PointBoxDistance(origin_F(), box_F) - sphere->radius_m);
  }
  const double bound_m = LowerBound(box_F);
  if (bound_m > up_to_m) return bound_m;
  if (const auto* capsule = std::get_if<Capsule>(&shape)) {
    const Eigen::Vector3d tip = R_F_G_.col(2) * (capsule->length_m / 2);
    return std::max(
        0.0, SegmentBoxDistance(origin_F() - tip, origin_F() + tip, box_F) - capsule->radius_m);
  }
  return ContactIfThrown([&] {
    const Eigen::Vector3d center_F = box_F.Center();
    const fcl::Boxd box(box_F.max - box_F.min);
    const Pair pair = {geometry_->fcl().geometry.get(), Placement(R_F_G_, origin_F() - center_F),
                       &box, Eigen::Isometry3d::Identity()};
    if (!std::holds_alternative<TriangleMesh>(shape)) return Distance(pair);
    // FCL sees a mesh's surface only; where that misses the box, the box is inside whole or not at
    // all. Its distances are ten times slower than its yes or no, hence the grown box.
    if (Collide(pair) || Contains(center_F)) return 0.0;
    const fcl::Boxd grown((box.side.array() + 2 * up_to_m).matrix());
    const bool near =
        up_to_m > 0 && Collide({pair.shape, pair.shape_pose, &grown, pair.obstacle_pose});
    return near ? Distance(pair) : std::numeric_limits<double>::infinity();
  });
}

double PlacedShape::DistanceToHull(const ShapeGeometry& hull, const Pose& T_F_H,
                                   double up_to_m) const {
  const Shape& shape = geometry_->shape();
  const Eigen::Matrix3d R_F_H = T_F_H.rotation.toRotationMatrix();
  if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    const Eigen::Vector3d center_H = R_F_H.transpose() * (origin_F() - T_F_H.translation);
    const double bound_m = PointBoxDistance(center_H, hull.box_G()) - sphere->radius_m;
    if (bound_m > up_to_m) return bound_m;
    return std::max(0.0, PointShapeDistance(center_H, hull.shape()) - sphere->radius_m);
  }
  const double bound_m = LowerBound(Transformed(T_F_H, hull.box_G()));
  if (bound_m > up_to_m) return bound_m;
  return ContactIfThrown([&] {
    const Pair pair{geometry_->fcl().geometry.get(),
                    Placement(R_F_G_, origin_F() - T_F_H.translation), hull.fcl().geometry.get(),
                    Placement(R_F_H, Eigen::Vector3d::Zero())};
    if (!std::holds_alternative<TriangleMesh>(shape)) return Distance(pair);
    const Eigen::Vector3d corner_F = T_F_H * hull.corners_G().front();
    return Collide(pair) || Contains(corner_F) ? 0.0 : Distance(pair);
  });
}

double PlacedShape::DistanceToBall(const Eigen::Vector3d& center_F, double radius_m,
                                   double up_to_m) const {
  const double bound_m = PointBoxDistance(center_F, box_F_) - radius_m;
  if (bound_m > up_to_m) return bound_m;
  return std::max(0.0, PointShapeDistance(ToG(center_F), geometry_->shape()) - radius_m);
}

}  // namespace clearway
