#include "scene/label_filter.h"

#include <algorithm>
#include <vector>

#include "absl/container/flat_hash_map.h"
#include "absl/container/flat_hash_set.h"
#include "clearway/map/voxel_neighbours.h"
#include "scene/direction_grid.h"

namespace clearway {
namespace {

// As many points of other labels as it takes to outvote one.
constexpr std::uint32_t kFewestOthers = 3;

bool IsOutvoted(const DirectionGrid::Votes& votes) {
  return votes.others >= kFewestOthers && votes.others >= 2 * votes.fellows;
}

// Where the objects of a scene are predicted to be.
class PredictedObjects {
 public:
  PredictedObjects(const SceneObjects& objects, Time stamp, Duration horizon) {
    constexpr std::int64_t kFewestFrames = 3;  // before which nobody knows how it moves
    for (const auto& object : objects) {
      if (object->frames_seen < kFewestFrames || stamp - object->t_k() > horizon) continue;
      const Pose T_W_O = PredictPose(*object, stamp, horizon).T_W_O;
      placed_.push_back({Transformed(T_W_O, object->observed_box_O), Inverse(T_W_O), object.get()});
    }
  }

  // Whether one fills the point's voxel.
  bool Fill(const Eigen::Vector3d& p_W) const {
    return std::ranges::any_of(placed_, [&](const Placed& object) {
      if (!object.box_W.Contains(p_W)) return false;
      const VoxelMap& map_O = object.object->map_O;
      return map_O.State(map_O.grid().KeyOf(object.T_O_W * p_W)) == VoxelState::kOccupied;
    });
  }
  // Whether the box about one holds the point, or would if it were a voxel larger each way.
  bool MayHold(const Eigen::Vector3d& p_W) const {
    return std::ranges::any_of(placed_, [&](const Placed& object) {
      return object.box_W.Padded(object.object->map_O.grid().resolution_m()).Contains(p_W);
    });
  }
  // Empty for one of which nothing is predicted.
  Aabb BoxOf(ObjectId id) const {
    const auto found = std::ranges::find_if(
        placed_, [&](const Placed& object) { return object.object->IsCalled(id); });
    return found == placed_.end() ? Aabb() : found->box_W;
  }

 private:
  struct Placed {
    Aabb box_W;
    Pose T_O_W;
    const MovingObject* object;
  };
  std::vector<Placed> placed_;
};

// Whether a point with an object's label is rather what is around it, a single one at least among
// others.
bool IsDoubtedOfObject(std::size_t place, const DirectionGrid& directions) {
  constexpr std::uint32_t kFewestFellows = 2;
  if (!directions.MayHaveOthers(place)) return false;
  const DirectionGrid::Votes votes = directions.VotesOn(place);
  return IsOutvoted(votes) || (votes.fellows < kFewestFellows && votes.others > 0);
}

enum class Doubt { kNone, kLittle, kEnough };

// Whether a static point is rather an object's; if it is only beside one of an object's, or all
// alone where an object may be, there is little to say so.
Doubt DoubtOfStatic(std::size_t place, const Eigen::Vector3f& p_W, const DirectionGrid& directions,
                    const PredictedObjects& objects) {
  const bool may_have_others = directions.MayHaveOthers(place);
  const DirectionGrid::Votes votes =
      may_have_others ? directions.VotesOn(place) : DirectionGrid::Votes();
  if (IsOutvoted(votes)) return Doubt::kEnough;
  if (votes.others == 0) {
    const bool is_alone = !directions.HasFellow(place) && objects.MayHold(p_W.cast<double>());
    return is_alone ? Doubt::kLittle : Doubt::kNone;
  }
  // One alone is enough where an object is likely.
  const bool is_likely = objects.Fill(p_W.cast<double>()) || !directions.HasFellow(place);
  return is_likely ? Doubt::kEnough : Doubt::kLittle;
}

// How many points of an object lie in each cube of a coarse grid.
using PointCounts = absl::flat_hash_map<VoxelKey, std::size_t>;

VoxelKey CubeOf(const LabelledCloud& cloud, const VoxelGrid& cubes, std::uint32_t point) {
  return cubes.KeyOf(cloud.ends_W[point].cast<double>());
}

PointCounts CountsOf(const LabelledCloud& cloud, const VoxelGrid& cubes,
                     const std::vector<std::uint32_t>& points) {
  PointCounts counts;
  VoxelKey last;
  std::size_t* in_last = nullptr;  // points in a row are most often in one cube
  for (const std::uint32_t i : points) {
    const VoxelKey cube = CubeOf(cloud, cubes, i);
    if (in_last == nullptr || cube != last) in_last = &counts[cube];
    last = cube;
    ++*in_last;
  }
  return counts;
}

struct Cluster {
  std::vector<VoxelKey> cubes;
  std::size_t points = 0;
};

// Takes the cubes that hang together with one of them.
Cluster TakeCluster(VoxelKey start, PointCounts& counts) {
  Cluster cluster;
  const auto take = [&](VoxelKey key) {
    const auto entry = counts.find(key);
    if (entry == counts.end()) return;
    cluster.cubes.push_back(key);
    cluster.points += entry->second;
    counts.erase(entry);
  };
  take(start);
  for (std::size_t next = 0; next < cluster.cubes.size(); ++next) {
    const VoxelKey key = cluster.cubes[next];
    for (const VoxelKey near : WithNeighbours(key)) take(near);
  }
  return cluster;
}

// Leaves out the points of an object that lie apart from the others and are too few to be a part of
// it; if there are no others, those that are not where it is predicted. Returns how many.
std::size_t LeaveOutStray(const LabelledCloud& cloud, const VoxelGrid& cubes,
                          const Aabb& predicted_W, std::vector<std::uint32_t>& points) {
  constexpr std::size_t kFewest = 5;
  constexpr double kBeside_m = 0.2;
  PointCounts counts = CountsOf(cloud, cubes, points);
  absl::flat_hash_set<VoxelKey> kept;
  std::size_t points_kept = 0;
  while (!counts.empty()) {
    const Cluster cluster = TakeCluster(counts.begin()->first, counts);
    if (cluster.points < kFewest) continue;
    kept.insert(cluster.cubes.begin(), cluster.cubes.end());
    points_kept += cluster.points;
  }
  if (points_kept == points.size()) return 0;
  if (kept.empty()) {
    const Aabb near_W = predicted_W.Padded(kBeside_m);
    return std::erase_if(
        points, [&](std::uint32_t i) { return !near_W.Contains(cloud.ends_W[i].cast<double>()); });
  }
  return std::erase_if(points,
                       [&](std::uint32_t i) { return !kept.contains(CubeOf(cloud, cubes, i)); });
}

}  // namespace

LabelDoubts LeaveOutDoubtful(const SceneObjects& objects, Time stamp, const SceneParams& params,
                             LabelledCloud& cloud) {
  constexpr double kVoxelsAcross = 16;  // a cube
  LabelDoubts doubts;
  if (cloud.object_hits.empty()) return doubts;
  const DirectionGrid directions(cloud);
  const PredictedObjects predicted(objects, stamp, params.horizon);
  std::vector<char> is_doubted(cloud.ends_W.size());
  for (std::size_t place = 0; place < directions.size(); ++place) {
    if (directions.IsCopy(place)) continue;
    const std::uint32_t i = directions.IndexOf(place);
    RayEnd& kind = cloud.kinds[i];
    if (kind == RayEnd::kBlock) {
      is_doubted[i] = IsDoubtedOfObject(place, directions);
      continue;
    }
    const Doubt doubt = DoubtOfStatic(place, cloud.ends_W[i], directions, predicted);
    if (doubt == Doubt::kLittle) doubts.believed_W.push_back(cloud.ends_W[i]);
    if (doubt != Doubt::kEnough) continue;
    kind = RayEnd::kBlock;
    ++doubts.doubted;
  }
  const VoxelGrid cubes(kVoxelsAcross * params.resolution_m);
  for (auto& [id, points] : cloud.object_hits) {
    doubts.doubted += std::erase_if(points, [&](std::uint32_t i) { return is_doubted[i]; });
    doubts.doubted += LeaveOutStray(cloud, cubes, predicted.BoxOf(id), points);
  }
  std::erase_if(cloud.object_hits, [](const auto& entry) { return entry.second.empty(); });
  return doubts;
}

}  // namespace clearway
