// Answers to queries, as values.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "clearway/scene/object_extent.h"
#include "clearway/scene/occupancy.h"
#include "clearway/wire/server_info.h"

namespace clearway {

// Which version a query wants; by default the newest. A plain value.
struct SceneQuery {
  std::uint64_t min_version = 0;  // wait for at least this one
  std::string lease_id = {};      // or the one that this lease holds
};

struct ObjectInfo {
  ObjectId id = 0;
  std::vector<ObjectId> also;  // see MovingObject
  Pose T_W_O;                  // at t_k
  Time t_k;
  std::optional<Twist> velocity_O;
  double speed_mps = 0;
  std::optional<PositionBound> bound;  // none of given objects
  Aabb box_O;                          // around the occupied voxels or the given shape
  ObjectExtent extent;
  Aabb box_W;  // around that, where the object is at t_k
  std::int64_t observed_voxels = 0, occupied_voxels = 0;
  Time first_seen, last_seen;
  std::int64_t frames_seen = 0;
  bool at_rest = false, bridged = false;
  PoseSource pose_source = PoseSource::kFirstSight;
  bool given = false;
  std::optional<Time> future_end;
  ObjectId part_of = kStaticLabel;  // see MovingObject
  // Its parts, by ascending ids; boxes and extent are then around all of them, and last_seen is the
  // newest of theirs.
  std::vector<ObjectInfo> parts;
};
struct ObjectList : Versioned {
  std::vector<ObjectInfo> objects;  // ascending ids; parts of others are with these
};

struct PointAnswers : Versioned {
  std::vector<PointOccupancy> points;  // in the order of the question
};

struct BoxOccupancy : Versioned {
  double cell_m = 0;
  Eigen::Vector3d origin_W = Eigen::Vector3d::Zero();  // corner of the first cell
  std::array<std::uint32_t, 3> cell_counts{};          // along x, y, z
  struct Counts {
    std::uint64_t free = 0, unknown_space = 0, beyond_horizon = 0, occupied = 0, out_of_bounds = 0;
    bool operator==(const Counts&) const = default;
  };
  std::vector<Counts> counts;      // one per time
  std::vector<SpaceStatus> cells;  // if asked for: time-major, then z, y, x (x fastest)
};

struct SliceQuestion {
  double z_m = 0;
  Eigen::Vector2d min_W = Eigen::Vector2d::Zero(), max_W = Eigen::Vector2d::Zero();
  std::optional<double> cell_m;  // by default the static map's resolution
};
// Cell (column, row) has its centre at min_W + (column + 0.5, row + 0.5) * cell_m.
struct SliceOccupancy : Versioned {
  double cell_m = 0;
  std::uint32_t columns = 0, rows = 0;
  std::vector<SpaceStatus> cells;  // time-major, then y, x (x fastest)
  std::vector<ObjectId> objects;   // parallel to the cells
};

struct RayAnswers : Versioned {
  std::vector<RayAnswer> rays;
};

struct PredictedPoses : Versioned {
  std::vector<ObjectId> objects;
  std::vector<PredictedPose> poses;  // object-major: time t of object i at i * times + t
};

// A version held by a lease.
struct LeaseGrant : Versioned {
  std::string id;
  Duration ttl{0};
};

enum class MapFormat { kBt = 1, kOt = 2, kPly = 3 };

// Which map to export: the static map, one object's in O, or everything at a time.
struct StaticMapTarget {};
struct ObjectTarget {
  ObjectId id = 0;
};
struct SceneAtTarget {
  Time time;
};
using ExportTarget = std::variant<StaticMapTarget, ObjectTarget, SceneAtTarget>;

}  // namespace clearway
