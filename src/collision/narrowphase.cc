#include "collision/narrowphase.h"

#include <fcl/geometry/shape/box.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "clearway/geometry/distance.h"
#include "clearway/geometry/hull.h"
#include "collision/body_contact.h"
#include "collision/contact_if_thrown.h"
#include "collision/fcl_bodies.h"
#include "collision/prepared_mesh.h"

namespace clearway {
namespace {

std::shared_ptr<const PreparedMesh> Prepare(const Shape& shape, Reuse reuse,
                                            const MeshBudget& budget) {
  if (const auto* mesh = std::get_if<TriangleMesh>(&shape)) {
    return std::make_shared<const PreparedMesh>(mesh->mesh, budget);
  }
  const auto* polytope = std::get_if<ConvexPolytope>(&shape);
  if (polytope == nullptr || reuse == Reuse::kFewQueries) return nullptr;
  const std::vector<Eigen::Vector3d>& corners = polytope->mesh->vertices;
  if (corners.size() > budget.hull_corners) return nullptr;
  Mesh hull = ConvexHullOf(corners);
  if (hull.triangles.empty()) return nullptr;
  return std::make_shared<const PreparedMesh>(std::make_shared<const Mesh>(std::move(hull)),
                                              budget);
}

Aabb Moved(const Aabb& box, const Eigen::Vector3d& by) { return {box.min + by, box.max + by}; }

// Four at a time, without a branch that could be guessed wrong.
const Eigen::Vector3d& FarthestOf(const std::vector<Eigen::Vector3d>& points,
                                  const Eigen::Vector3d& direction) {
  constexpr std::size_t kLanes = 4;
  std::array<double, kLanes> farthest;
  std::array<std::size_t, kLanes> index{};
  farthest.fill(direction.dot(points[0]));
  const auto look = [&](std::size_t i, std::size_t lane) {
    const double far = direction.dot(points[i]);
    index[lane] = far > farthest[lane] ? i : index[lane];
    farthest[lane] = far > farthest[lane] ? far : farthest[lane];
  };
  std::size_t i = 0;
  for (; i + kLanes <= points.size(); i += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) look(i + lane, lane);
  }
  for (; i < points.size(); ++i) look(i, 0);
  const auto best = std::max_element(farthest.begin(), farthest.end());
  return points[index[best - farthest.begin()]];
}

}  // namespace

struct ShapeGeometry::Fcl {
  std::shared_ptr<const FclGeometry> geometry;
};

ShapeGeometry::ShapeGeometry(const Shape& shape, Reuse reuse, const MeshBudget& budget)
    : shape_(shape),
      box_G_(BoundingBox(shape)),
      prepared_(Prepare(shape, reuse, budget)),
      fcl_(std::make_shared<const Fcl>(Fcl{ToFcl(shape)})) {}

double ShapeGeometry::core_radius_m() const {
  if (const auto* sphere = std::get_if<Sphere>(&shape_)) return sphere->radius_m;
  const auto* capsule = std::get_if<Capsule>(&shape_);
  return capsule != nullptr ? capsule->radius_m : 0;
}

Eigen::Vector3d ShapeGeometry::FarthestOfCore(const Eigen::Vector3d& direction_G) const {
  if (std::holds_alternative<Sphere>(shape_)) return Eigen::Vector3d::Zero();
  if (prepared_) return prepared_->Farthest(direction_G);
  if (const auto* polytope = std::get_if<ConvexPolytope>(&shape_)) {
    return FarthestOf(polytope->mesh->vertices, direction_G);
  }
  Eigen::Vector3d farthest = box_G_.max;
  if (const auto* cylinder = std::get_if<Cylinder>(&shape_)) {
    farthest.head<2>() = cylinder->radius_m * direction_G.head<2>().normalized();
  } else if (const auto* capsule = std::get_if<Capsule>(&shape_)) {
    farthest = {0, 0, 0.5 * capsule->length_m};
  }
  for (int axis = 0; axis < 3; ++axis) {
    farthest[axis] = std::copysign(farthest[axis], direction_G[axis]);
  }
  return farthest;
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
    const PreparedMesh* mesh = geometry_->prepared();
    if (mesh != nullptr) return Moved(mesh->BoxTurned(R_F_G_), origin_F());
    Aabb around;
    for (const Eigen::Vector3d& corner_G : std::get<ConvexPolytope>(shape).mesh->vertices) {
      around.Extend(R_F_G_ * corner_G + origin_F());
    }
    return around;
  }
  return {origin_F() - half, origin_F() + half};
}

bool PlacedShape::Contains(const Eigen::Vector3d& p_F) const {
  const Eigen::Vector3d p_G = ToG(p_F);
  const PreparedMesh* mesh = geometry_->prepared();
  return mesh != nullptr ? mesh->Contains(p_G) : clearway::Contains(geometry_->shape(), p_G);
}

// A convex shape that has the corners of an octahedron has the ball in it.
bool PlacedShape::Holds(const Eigen::Vector3d& center_F, double radius_m) const {
  const Eigen::Vector3d center_G = ToG(center_F);
  const Shape& shape = geometry_->shape();
  if (const PreparedMesh* mesh = geometry_->prepared()) {
    return mesh->SideOf(center_G, radius_m).value_or(false);
  }
  if (!std::holds_alternative<ConvexPolytope>(shape)) return DepthIn(shape, center_G) >= radius_m;
  constexpr double kToCorner = 1.7320508075688774;
  for (const double corner_m : {-kToCorner * radius_m, kToCorner * radius_m}) {
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d corner_G = center_G + corner_m * Eigen::Vector3d::Unit(axis);
      if (!clearway::Contains(shape, corner_G)) return false;
    }
  }
  return true;
}

std::optional<Eigen::Vector3d> PlacedShape::FromNearestPoint(const Eigen::Vector3d& p_F) const {
  const auto* cylinder = std::get_if<Cylinder>(&geometry_->shape());
  if (cylinder == nullptr) return std::nullopt;
  const Eigen::Vector3d p_G = ToG(p_F);
  return R_F_G_ * (p_G - NearestPoint(p_G, *cylinder));
}

std::optional<RoundedLine> PlacedShape::AsRoundedLine() const {
  const Shape& shape = geometry_->shape();
  if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    return RoundedLine{origin_F(), R_F_G_.col(2), 0, sphere->radius_m};
  }
  if (const auto* capsule = std::get_if<Capsule>(&shape)) {
    return RoundedLine{origin_F(), R_F_G_.col(2), 0.5 * capsule->length_m, capsule->radius_m};
  }
  return std::nullopt;
}

std::optional<TurnedBox> PlacedShape::AsBox() const {
  const auto* box = std::get_if<Box>(&geometry_->shape());
  if (box == nullptr) return std::nullopt;
  return TurnedBox{R_F_G_, origin_F(), 0.5 * box->size_m};
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
  const Eigen::Vector3d center_F = box_F.Center();
  if (const PreparedMesh* mesh = geometry_->prepared()) {
    return mesh->DistanceTo({ToG(center_F), R_F_G_, 0.5 * (box_F.max - box_F.min)}, up_to_m);
  }
  return ContactIfThrown([&] {
    const fcl::Boxd box(box_F.max - box_F.min);
    return Distance({geometry_->fcl().geometry.get(), Placement(R_F_G_, origin_F() - center_F),
                     &box, Eigen::Isometry3d::Identity()});
  });
}

std::optional<ParallelCylinders> PlacedShape::BesideCylinder(const ShapeGeometry& other,
                                                             const Pose& T_F_O) const {
  const auto* mine = std::get_if<Cylinder>(&geometry_->shape());
  const auto* others = std::get_if<Cylinder>(&other.shape());
  if (mine == nullptr || others == nullptr) return std::nullopt;
  return ParallelCylinders::Of(*mine, *others, Inverse(T_F_O) * T_F_G_);
}

bool PlacedShape::Meets(const ShapeGeometry& other, const Pose& T_F_O, double margin_m) const {
  if (const auto cylinders = BesideCylinder(other, T_F_O)) return cylinders->Distance() <= margin_m;
  const Eigen::Matrix3d R_F_O = T_F_O.rotation.toRotationMatrix();
  const auto farthest_F = [&](const Eigen::Vector3d& direction_F) -> Eigen::Vector3d {
    return R_F_O * other.FarthestOfCore(R_F_O.transpose() * direction_F) + T_F_O.translation;
  };
  const Eigen::Vector3d center_F = T_F_O * other.box_G().Center();
  const std::optional<bool> meets =
      clearway::Meets(*this, {farthest_F, center_F}, margin_m + other.core_radius_m());
  return meets ? *meets : DistanceToShape(other, T_F_O, margin_m) <= margin_m;
}

double PlacedShape::DistanceToShape(const ShapeGeometry& other, const Pose& T_F_O,
                                    double up_to_m) const {
  const Shape& shape = geometry_->shape();
  const Eigen::Matrix3d R_F_O = T_F_O.rotation.toRotationMatrix();
  if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    const Eigen::Vector3d center_O = R_F_O.transpose() * (origin_F() - T_F_O.translation);
    const double bound_m = PointBoxDistance(center_O, other.box_G()) - sphere->radius_m;
    if (bound_m > up_to_m) return bound_m;
    return std::max(0.0, PointShapeDistance(center_O, other.shape()) - sphere->radius_m);
  }
  if (const auto* sphere = std::get_if<Sphere>(&other.shape())) {
    return DistanceToBall(T_F_O.translation, sphere->radius_m, up_to_m);
  }
  if (const auto cylinders = BesideCylinder(other, T_F_O)) return cylinders->Distance();
  const double bound_m = LowerBound(Transformed(T_F_O, other.box_G()));
  if (bound_m > up_to_m) return bound_m;
  return ContactIfThrown([&] {
    const FclPair pair{geometry_->fcl().geometry.get(),
                       Placement(R_F_G_, origin_F() - T_F_O.translation),
                       other.fcl().geometry.get(), Placement(R_F_O, Eigen::Vector3d::Zero())};
    if (!std::holds_alternative<TriangleMesh>(shape)) return Distance(pair);
    // Of the other's points one is as good as another if none is at the surface.
    const Eigen::Vector3d point_F = T_F_O * other.FarthestOfCore(Eigen::Vector3d::UnitX());
    return Collide(pair) || Contains(point_F) ? 0.0 : Distance(pair);
  });
}

double PlacedShape::DistanceToBall(const Eigen::Vector3d& center_F, double radius_m,
                                   double up_to_m) const {
  const double bound_m = PointBoxDistance(center_F, box_F_) - radius_m;
  if (bound_m > up_to_m) return bound_m;
  const Eigen::Vector3d center_G = ToG(center_F);
  const PreparedMesh* mesh = geometry_->prepared();
  return std::max(0.0, (mesh != nullptr ? mesh->DistanceTo(center_G, up_to_m + radius_m)
                                        : PointShapeDistance(center_G, geometry_->shape())) -
                           radius_m);
}

}  // namespace clearway
