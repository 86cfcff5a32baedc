// Queries to a server, each one call. Answers carry the version they were computed on.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "clearway/client/connection.h"
#include "clearway/scene/occupancy.h"

namespace clearway {

// Which version a query wants; by default the newest. A plain value.
struct SceneQuery {
  std::uint64_t min_version = 0;  // wait for at least this one
  std::string lease_id;           // or the one that this lease holds
};

// Every answer's first part.
struct Versioned {
  std::uint64_t version = 0;
  Time stamp;
};

struct ServerStatus : Versioned {
  std::string scene_hash;  // if asked for
  double uptime_s = 0;
  bool draining = false;
  std::uint64_t frames_applied = 0, frames_refused = 0;
  std::uint64_t points_used = 0, points_not_finite = 0;
  std::uint64_t queued_frames = 0;
  std::uint64_t objects = 0;
  std::uint64_t static_observed_voxels = 0, static_occupied_voxels = 0;
  Aabb static_box_W;  // around the observed blocks
  std::uint64_t robots = 0, leases = 0, follow_streams = 0, push_streams = 0;
};

struct ObjectInfo {
  ObjectId id = 0;
  Pose T_W_O;  // at t_k
  Time t_k;
  std::optional<Twist> velocity_O;
  double speed_mps = 0;
  Aabb box_O;  // around the occupied voxels
  Aabb box_W;  // around that, where the object is at t_k
  std::int64_t observed_voxels = 0, occupied_voxels = 0;
  Time first_seen, last_seen;
  std::int64_t frames_seen = 0;
  bool at_rest = false, bridged = false;
};
struct ObjectList : Versioned {
  std::vector<ObjectInfo> objects;  // ascending ids
};

struct PointAnswers : Versioned {
  std::vector<PointOccupancy> points;  // in the order of the question
};

struct BoxOccupancy : Versioned {
  double cell_m = 0;
  Eigen::Vector3d origin_W;                    // corner of the first cell
  std::array<std::uint32_t, 3> cell_counts{};  // along x, y, z
  struct Counts {
    std::uint64_t free = 0, unknown_space = 0, beyond_horizon = 0, occupied = 0, out_of_bounds = 0;
  };
  std::vector<Counts> counts;      // one per time
  std::vector<SpaceStatus> cells;  // if asked for: time-major, then z, y, x (x fastest)
};

struct SliceQuestion {
  double z_m = 0;
  Eigen::Vector2d min_W, max_W;
  std::optional<double> cell_m;  // by default the static map's resolution
};
struct SliceOccupancy : Versioned {
  double cell_m = 0;
  std::uint32_t columns = 0, rows = 0;
  std::vector<SpaceStatus> cells;  // time-major, then y, x (x fastest)
  std::vector<ObjectId> objects;
};

struct RayAnswers : Versioned {
  std::vector<RayAnswer> rays;
};

struct PredictedPoses : Versioned {
  std::vector<ObjectId> objects;
  std::vector<PredictedPose> poses;  // object-major
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

// Typed calls. A cheap handle; any thread may call any method. Every call may fail as its transport
// does (UNAVAILABLE, DEADLINE_EXCEEDED) beside what is named.
class SceneClient {
 public:
  explicit SceneClient(std::shared_ptr<Connection> connection)
      : connection_(std::move(connection)) {}

  absl::StatusOr<ServerInfo> GetServerInfo() const;
  absl::StatusOr<ServerStatus> GetStatus(bool include_hash = false) const;

  absl::StatusOr<ObjectList> ListObjects(const SceneQuery& query = {}) const;
  // NOT_FOUND for an unknown id.
  absl::StatusOr<ObjectInfo> GetObject(ObjectId id, const SceneQuery& query = {}) const;
  // ids empty: all objects.
  absl::StatusOr<PredictedPoses> PredictPoses(std::span<const ObjectId> ids,
                                              std::span<const Time> times,
                                              const SceneQuery& query = {}) const;

  // times: one for all, or one per point.
  absl::StatusOr<PointAnswers> OccupancyOfPoints(std::span<const Eigen::Vector3f> points_W,
                                                 std::span<const Time> times,
                                                 const SceneQuery& query = {}) const;
  absl::StatusOr<BoxOccupancy> OccupancyOfBox(const Aabb& box_W, std::span<const Time> times,
                                              bool include_cells,
                                              const SceneQuery& query = {}) const;
  absl::StatusOr<SliceOccupancy> OccupancyOfSlice(const SliceQuestion& slice,
                                                  std::span<const Time> times,
                                                  const SceneQuery& query = {}) const;
  // times: one for all, or one per ray.
  absl::StatusOr<RayAnswers> CastRays(std::span<const Eigen::Vector3f> origins_W,
                                      std::span<const Eigen::Vector3f> directions_W,
                                      std::span<const Time> times, double max_range_m,
                                      const SceneQuery& query = {}) const;

  // Calls `sink` with the file's bytes in order; its error ends the call.
  absl::StatusOr<Versioned> ExportMap(const ExportTarget& target, MapFormat format,
                                      const std::function<absl::Status(std::string_view)>& sink,
                                      const SceneQuery& query = {}) const;

  // The version in which the change is.
  absl::StatusOr<Versioned> LoadPrior(MapFormat format, std::string_view file_bytes) const;
  absl::StatusOr<Versioned> ClearRegion(const Aabb& box_W) const;
  absl::StatusOr<Versioned> SetKeepOut(std::span<const Aabb> boxes_W) const;
  absl::StatusOr<Versioned> Reset() const;

 private:
  std::shared_ptr<Connection> connection_;
};

}  // namespace clearway
