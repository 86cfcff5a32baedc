#include "collision/body_contact.h"

#include <algorithm>

#include "collision/prepared_mesh.h"

namespace clearway {
namespace {

struct CoreOf {
  const PlacedShape& shape_F;
  Eigen::Vector3d operator()(const Eigen::Vector3d& direction_F) const {
    return shape_F.FarthestOfCore(direction_F);
  }
};

struct Corners {
  const Triangle& t;
  const Eigen::Vector3d& operator()(const Eigen::Vector3d& direction) const {
    const double a = direction.dot(t.a), b = direction.dot(t.b), c = direction.dot(t.c);
    return a >= b && a >= c ? t.a : b >= c ? t.b : t.c;
  }
};

// What the frame G of a shape sees of a body.
struct SeenFromG {
  const PlacedShape& shape_F;
  const ConvexBody& body_F;
  Eigen::Vector3d operator()(const Eigen::Vector3d& direction_G) const {
    return shape_F.ToG(body_F.farthest(shape_F.R_F_G() * direction_G));
  }
};

// The surface of a mesh against a convex body, in the mesh's frame G, in which it moves by way_F
// and spreads.
class SurfaceContact {
 public:
  SurfaceContact(const PlacedShape& shape_F, const Eigen::Vector3d& way_F, const ConvexBody& body_F,
                 double margin_m, const Spread& spread_F)
      : mesh_(*shape_F.AsMesh()),
        way_G_(shape_F.R_F_G().transpose() * way_F),
        farthest_G_{shape_F, body_F},
        body_G_{farthest_G_, shape_F.ToG(body_F.center)},
        margin_m_(margin_m),
        spread_G_(spread_F.Turned(shape_F.R_F_G().transpose())) {
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d along = Eigen::Vector3d::Unit(axis);
      const double reach_m = margin_m + spread_G_.half_m()[axis] + kTouching_m;
      around_G_.max[axis] = farthest_G_(along)[axis] + reach_m;
      around_G_.min[axis] = farthest_G_(-along)[axis] - reach_m;
    }
  }
  SurfaceContact(const SurfaceContact&) = delete;
  SurfaceContact& operator=(const SurfaceContact&) = delete;

  // Of the body's points one is as good as another if none is at the surface.
  bool HoldsBody(double share) const {
    return mesh_.Contains(farthest_G_(Eigen::Vector3d::UnitX()) - share * way_G_);
  }

  double FirstTouch(double from, double until) const {
    return mesh_.tree().Least(
        until,
        [&](const TriangleTree::Node& node, double limit) { return OfBox(node, from, limit); },
        [&](const Triangle& triangle, double limit) { return OfTriangle(triangle, from, limit); });
  }

  // Where the mesh is.
  std::optional<bool> Meets() const {
    const double least_m = mesh_.tree().Least(
        margin_m_,
        [&](const TriangleTree::Node& node, double) {
          return BoxesMeet(node, 0, 0) == kNever ? kNever : 0;
        },
        [&](const Triangle& triangle, double) {
          const Separation apart =
              FindSeparation(Corners{triangle}, body_G_.farthest, body_G_.center - triangle.a,
                             margin_m_, [](const Separation&) { return true; });
          return apart.at_most_m <= margin_m_ ? -1 : std::max(0.0, apart.gap_m);
        });
    if (least_m == kNever) return false;
    return least_m < 0 ? std::optional(true) : std::nullopt;
  }

 private:
  double OfBox(const TriangleTree::Node& node, double from, double until) const {
    const double entered = BoxesMeet(node, from, until);
    if (entered == kNever) return kNever;
    const auto farthest = [&](const Eigen::Vector3d& direction) -> Eigen::Vector3d {
      return node.center_G + (direction.array() > 0).select(node.half_m, -node.half_m);
    };
    return FirstTouchOf({farthest, node.center_G}, way_G_, body_G_, margin_m_, spread_G_, entered,
                        until);
  }

  double OfTriangle(const Triangle& triangle, double from, double until) const {
    return FirstTouchOf({Corners{triangle}, triangle.a}, way_G_, body_G_, margin_m_, spread_G_,
                        from, until);
  }

  // The box round the body is entered on all axes, and left on none.
  double BoxesMeet(const TriangleTree::Node& node, double from, double until) const {
    double enters = from, leaves = until;
    for (int axis = 0; axis < 3; ++axis) {
      const double before_m = around_G_.min[axis] - node.center_G[axis] - node.half_m[axis];
      const double behind_m = around_G_.max[axis] - node.center_G[axis] + node.half_m[axis];
      const double way_m = way_G_[axis];
      if (way_m == 0 && (before_m > 0 || behind_m < 0)) return kNever;
      if (way_m == 0) continue;
      enters = std::max(enters, (way_m > 0 ? before_m : behind_m) / way_m);
      leaves = std::min(leaves, (way_m > 0 ? behind_m : before_m) / way_m);
    }
    constexpr double kRounding = 1e-9;
    return enters > leaves + kRounding ? kNever : std::max(from, enters - kRounding);
  }

  const PreparedMesh& mesh_;
  Eigen::Vector3d way_G_;
  SeenFromG farthest_G_;
  ConvexBody body_G_;  // refers to it
  double margin_m_;
  Spread spread_G_;
  Aabb around_G_;  // the body and all that touches it
};

}  // namespace

std::optional<bool> Meets(const PlacedShape& shape_F, const ConvexBody& body_F, double margin_m) {
  const ShapeGeometry& geometry = shape_F.geometry();
  const double beyond_core_m = margin_m + geometry.core_radius_m();
  const Separation apart =
      FindSeparation(CoreOf{shape_F}, body_F.farthest, body_F.center - shape_F.Center_F(),
                     beyond_core_m, [](const Separation&) { return true; });
  if (apart.gap_m > beyond_core_m) return false;
  if (geometry.convex()) {
    return apart.at_most_m <= beyond_core_m ? std::optional(true) : std::nullopt;
  }
  const SurfaceContact surface(shape_F, Eigen::Vector3d::Zero(), body_F, margin_m, {});
  return surface.HoldsBody(0) ? true : surface.Meets();
}

double FirstTouchOf(const Sweep& sweep, const ConvexBody& body_F, double beyond_m, double from,
                    double until) {
  const PlacedShape& shape_F = sweep.shape_F;
  const ShapeGeometry& geometry = shape_F.geometry();
  const double margin_m = sweep.margin_m + beyond_m + geometry.core_radius_m();
  const double share = FirstTouchOf({CoreOf{shape_F}, shape_F.Center_F()}, sweep.way_F, body_F,
                                    margin_m, sweep.spread_F, from, until);
  if (share == kNever || geometry.convex() || !geometry.prepared()->closed()) return share;
  const SurfaceContact surface(shape_F, sweep.way_F, body_F, margin_m, sweep.spread_F);
  return surface.HoldsBody(share) ? share : surface.FirstTouch(share, until);
}

}  // namespace clearway
