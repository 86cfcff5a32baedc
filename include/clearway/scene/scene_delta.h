// The one difference type: what a mirror receives, what a full sync is, what a checkpoint holds.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/scene/scene_snapshot.h"

namespace clearway {

// The voxels of one block that differ.
struct BlockDelta {
  BlockKey key;
  BlockMask changed;
  BlockMask observed;             // of the changed voxels, those observed afterwards
  std::vector<LogOdds> log_odds;  // of `observed` voxels, by ascending index
  bool operator==(const BlockDelta&) const = default;
};

using MapDelta = std::vector<BlockDelta>;  // in BlockTree's order

// One object that is new or differs. All but the map, a known future and a known shape is sent
// whole: it is small.
struct ObjectDelta {
  ObjectId id = 0;
  std::vector<ObjectId> also;
  std::vector<Time> older_ids_told;
  ObjectId part_of = kStaticLabel;
  MapDelta map_O;  // against the map of the same id in `from`, or an empty one
  std::optional<Completion> completion;
  std::vector<StampedPose> history;
  std::vector<StampedPose> future;
  // Instead of `future`: that of `from` without the poses up to t_k. A future is long, and frames
  // shorten it.
  bool keeps_future = false;
  Twist future_velocity_O;
  bool given = false;
  std::shared_ptr<const Shape> given_shape;  // null: that of `from`, or none if it is not given
  std::optional<Twist> velocity_O;
  PositionBound bound;
  Time tracked_since, placed_at;
  bool estimated = false, reported = false;
  std::optional<Pose> T_B_O;
  Time first_seen;
  Time last_seen;
  std::int64_t frames_seen = 0;
  bool bridged = false;
};

// What turns version `from` into version `to`. From version 0, the empty scene, it is the whole
// scene. A value.
struct SceneDelta {
  std::uint64_t from_version = 0;
  std::uint64_t to_version = 0;
  Time stamp;
  std::optional<SceneParams> params;  // when from_version is 0 or they changed
  MapDelta static_map_W;
  std::optional<DynamicSpace> dynamic_W;  // when it differs
  std::vector<ObjectDelta> objects;       // ascending ids
  std::vector<ObjectId> removed;          // ascending ids
};

// How much of the voxels a delta tells.
enum class MapDetail {
  kLogOdds,
  // Free, occupied or unknown alone: of an observed voxel the log-odds are the model's clamp on its
  // side. Far fewer voxels differ between two scans.
  kStates,
};

// Takes time in proportion to the blocks written between the two. `from` null: the empty scene,
// version 0.
SceneDelta Diff(const SceneSnapshot* from, const SceneSnapshot& to,
                MapDetail detail = MapDetail::kLogOdds);

// What Diff tells, piece by piece: a whole scene as a value takes some twice its memory. Both
// scenes must outlive it. Any thread may call any method.
class SceneDifference {
 public:
  SceneDifference(const SceneSnapshot* from, const SceneSnapshot& to,
                  MapDetail detail = MapDetail::kLogOdds);
  SceneDifference(const SceneDifference&) = delete;
  SceneDifference& operator=(const SceneDifference&) = delete;

  // Without the static map's blocks and the objects.
  SceneDelta Head() const;
  // These call `take`, in the delta's order, as long as it is true; they return whether it always
  // was.
  bool ForEachBlock(const std::function<bool(BlockDelta)>& take) const;
  bool ForEachObject(const std::function<bool(ObjectDelta)>& take) const;

 private:
  const SceneSnapshot empty_;
  const SceneSnapshot& from_;
  const SceneSnapshot& to_;
  const MapDetail detail_;
};

// Apply(a, Diff(a, b)) == b, bit for bit. With kStates, where S(x) is Apply(null, Diff(null, x,
// kStates)), likewise Apply(S(a), Diff(a, b, kStates)) == S(b), and S(b) answers every question of
// status, collision and clearance as b does; its fused log-odds are its own. `base` null: the empty
// scene. FAILED_PRECONDITION if the delta starts from another version than base's; INVALID_ARGUMENT
// if it is not well formed (it may come from the network).
absl::StatusOr<SceneSnapshot> Apply(const SceneSnapshot* base, const SceneDelta& delta);

}  // namespace clearway
