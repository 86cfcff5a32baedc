// Queries to a server, each one call. Answers carry the version they were computed on.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "clearway/client/connection.h"
#include "clearway/scene/given_object.h"
#include "clearway/wire/answers.h"

namespace clearway {

// The version in which a part of the static map is unknown.
struct ClearedRegion : Versioned {
  std::uint64_t voxels_cleared = 0;  // that were free or occupied before
  std::uint64_t voxels_in_box = 0;   // known or not
};

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

  // Holds a version against being forgotten, for `ttl` after this call or its last renewal.
  absl::StatusOr<LeaseGrant> AcquireLease(Duration ttl, const SceneQuery& query = {}) const;
  absl::StatusOr<LeaseGrant> RenewLease(const std::string& lease_id, Duration ttl) const;
  absl::Status ReleaseLease(const std::string& lease_id) const;

  // The version in which the change is.
  absl::StatusOr<Versioned> LoadPrior(MapFormat format, std::string_view file_bytes) const;
  // Of voxels whose centre lies in the box (VoxelGrid::CentersIn).
  absl::StatusOr<ClearedRegion> ClearRegion(const Aabb& box_W) const;
  absl::StatusOr<Versioned> SetKeepOut(std::span<const Aabb> boxes_W) const;
  absl::StatusOr<Versioned> Reset() const;
  // What is told of objects, see SceneBuilder: all of a call or none.
  absl::StatusOr<Versioned> AddObjects(std::span<const GivenObject> objects) const;
  absl::StatusOr<Versioned> RemoveObjects(std::span<const ObjectId> ids) const;
  absl::StatusOr<Versioned> SetFutures(std::span<const ObjectFuture> futures) const;

 private:
  std::shared_ptr<Connection> connection_;
};

}  // namespace clearway
