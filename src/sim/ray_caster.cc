#include "sim/ray_caster.h"

#include <algorithm>

#include "sim/ray_shape.h"

namespace clearway {

// A target where it is at the time of a scan, seen from the sensor.
struct RayCaster::Placed {
  const Target* target;
  Eigen::Matrix3d R_G_S;
  Eigen::Vector3d origin_G;  // of S
  Eigen::Vector3d center_S;
  double center_squared;
  double radius_squared;
  double nearest_m;  // no hit can be nearer

  // Whether the ray from S's origin can meet the ball around the target.
  bool MayHit(const Eigen::Vector3d& direction_S) const {
    if (center_squared <= radius_squared) return true;
    const double along_m = direction_S.dot(center_S);
    return along_m > 0 && center_squared - along_m * along_m <= radius_squared;
  }
  double Distance(const Eigen::Vector3d& direction_S) const {
    const Eigen::Vector3d direction_G = R_G_S * direction_S;
    if (target->bvh) return target->bvh->RayDistance(origin_G, direction_G);
    return RayDistance(target->part->shape, origin_G, direction_G);
  }
};

RayCaster::RayCaster(const World& world) : world_(&world) {
  for (std::size_t body = 0; body < world.bodies().size(); ++body) {
    for (const BodyPart& part : world.bodies()[body].parts) {
      const Aabb box_G = BoundingBox(part.shape);
      Target target{.body = body,
                    .part = &part,
                    .bvh = nullptr,
                    .center_B = part.T_B_G * box_G.Center(),
                    .radius_m = 0.5 * box_G.Size().norm() + 1e-6};  // slack for rounding
      if (const auto* mesh = std::get_if<TriangleMesh>(&part.shape)) {
        target.bvh = std::make_shared<const MeshBvh>(mesh->mesh);
      }
      targets_.push_back(std::move(target));
    }
  }
}

std::vector<RayCaster::Placed> RayCaster::Place(const Pose& T_W_S, Time t,
                                                double max_range_m) const {
  std::vector<Placed> placed;
  const Pose T_S_W = Inverse(T_W_S);
  std::size_t posed_body = world_->bodies().size();
  Pose T_S_B;
  for (const Target& target : targets_) {
    if (target.body != posed_body) {
      posed_body = target.body;
      T_S_B = T_S_W * PoseAt(world_->bodies()[posed_body].trajectory, t);
    }
    const Eigen::Vector3d center_S = T_S_B * target.center_B;
    const double nearest_m = std::max(0.0, center_S.norm() - target.radius_m);
    if (nearest_m > max_range_m) continue;
    const Pose T_G_S = Inverse(T_S_B * target.part->T_B_G);
    placed.push_back({&target, T_G_S.rotation.toRotationMatrix(), T_G_S.translation, center_S,
                      center_S.squaredNorm(), target.radius_m * target.radius_m, nearest_m});
  }
  std::stable_sort(placed.begin(), placed.end(),
                   [](const Placed& a, const Placed& b) { return a.nearest_m < b.nearest_m; });
  return placed;
}

std::vector<RayHit> RayCaster::Cast(const Pose& T_W_S, Time t,
                                    std::span<const Eigen::Vector3d> directions_S,
                                    double max_range_m) const {
  const std::vector<Placed> placed = Place(T_W_S, t, max_range_m);
  std::vector<RayHit> hits;
  hits.reserve(directions_S.size());
  for (const Eigen::Vector3d& direction_S : directions_S) {
    RayHit best{.range_m = kNoHit, .body = world_->bodies().size()};
    for (const Placed& candidate : placed) {
      if (candidate.nearest_m > std::min(best.range_m, max_range_m)) break;
      if (!candidate.MayHit(direction_S)) continue;
      const double range_m = candidate.Distance(direction_S);
      if (range_m > max_range_m) continue;
      const std::size_t body = candidate.target->body;
      if (range_m < best.range_m || (range_m == best.range_m && body < best.body)) {
        best = {range_m, body};
      }
    }
    hits.push_back(best);
  }
  return hits;
}

}  // namespace clearway
