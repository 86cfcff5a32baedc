// Point, box and ray queries.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "clearway/scene/scene_snapshot.h"

namespace clearway {

// What all maps say of one point at one time.
struct PointOccupancy {
  SpaceStatus status = SpaceStatus::kUnknownSpace;
  // The lowest id that occupies the point or may have reached it; 0 for the static map (or keep-out
  // zone).
  ObjectId object = kStaticLabel;
  // Sum of the log-odds of every map that has observed the point (II-E); none if no map has.
  std::optional<double> fused_log_odds = {};
  // Whether it is the static map's dynamic space that occupies the point.
  bool dynamic = false;
};

// Every moving object of a snapshot placed at one time. Immutable; any thread may read it. It must
// not outlive the snapshot.
class SceneAtTime {
 public:
  struct Placed {
    const MovingObject* object;
    Pose T_W_O;
    Pose T_O_W;
    std::optional<double> beyond_horizon_radius_m;
    Aabb box_W;  // around the observed voxels, the solid, and the swept bound
  };
  static Placed Place(const SceneSnapshot& scene, const MovingObject& object, Time t);

  SceneAtTime(const SceneSnapshot& scene, Time t);

  const SceneSnapshot& scene() const { return *scene_; }
  Time time() const { return time_; }
  const std::vector<Placed>& objects() const { return objects_; }  // ascending ids

  // Searches only the maps whose box contains the point (II-E), and follows the one status rule of
  // SpaceStatus.
  PointOccupancy At(const Eigen::Vector3d& p_W) const;

 private:
  const SceneSnapshot* scene_;
  Time time_;
  std::vector<Placed> objects_;
};

// The two parts of what a scene says of a point: the static map with the scene's bounds and
// keep-out zones, and then every object near the point in ascending order, if the point is within
// bounds.
// `stored`: the log-odds of the point's voxel, if the static map has observed it; looked at for a
// point in the addressable space alone.
PointOccupancy StaticOccupancy(const SceneSnapshot& scene, const Eigen::Vector3d& p_W,
                               std::optional<LogOdds> stored);
void AddObject(const SceneSnapshot& scene, const SceneAtTime::Placed& placed,
               const Eigen::Vector3d& p_W, PointOccupancy& answer);

// One answer per point. times: one for all, or one per point.
std::vector<PointOccupancy> OccupancyOf(const SceneSnapshot& scene,
                                        std::span<const Eigen::Vector3d> points_W,
                                        std::span<const Time> times);

// Where a ray first meets something.
struct RayAnswer {
  std::optional<double> first_hit_m;  // distance to the first occupied voxel or solid
  std::optional<double>
      first_unknown_m;  // to the first voxel that is neither free nor occupied, if before the hit
  ObjectId object = kStaticLabel;  // what was hit
};

// Steps through the static map's voxels from origin_W along direction_W (any length) up to
// max_range_m; within each voxel crossed, moving objects are sampled at the segment's middle.
RayAnswer CastQueryRay(const SceneAtTime& scene, const Eigen::Vector3d& origin_W,
                       const Eigen::Vector3d& direction_W, double max_range_m);

}  // namespace clearway
