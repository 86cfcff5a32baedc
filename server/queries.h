// The queries of the wire, computed on one version. Pure functions; any thread may call them.
#pragma once

#include <functional>
#include <span>

#include "absl/status/statusor.h"
#include "clearway/wire/answers.h"
#include "server/versions.h"

namespace clearway {

// Long work looks at `gone` every so often, and then ends with CANCELLED.

// Around the observed blocks: quicker than around the voxels.
Aabb BoxAroundBlocks(const VoxelMap& map);

// A point in each column. `times_ns`: one for all, or one per point. Calls answer(i, occupancy) for
// each point in turn.
absl::Status AskPoints(const SceneSnapshot& scene, Eigen::Map<const Eigen::Matrix3Xf> points_W,
                       std::span<const std::int64_t> times_ns, const Gone& gone,
                       const std::function<void(std::size_t, const PointOccupancy&)>& answer);

// RESOURCE_EXHAUSTED for more than `max_cells` cells over all times.
absl::StatusOr<BoxOccupancy> AskBox(const SceneSnapshot& scene, const Aabb& box_W,
                                    std::span<const Time> times, bool include_cells,
                                    std::uint64_t max_cells, const Gone& gone);
absl::StatusOr<SliceOccupancy> AskSlice(const SceneSnapshot& scene, const SliceQuestion& slice,
                                        std::span<const Time> times, std::uint64_t max_cells,
                                        const Gone& gone);

// RESOURCE_EXHAUSTED, before the first is cast, for rays that would pass more than `max_voxels`
// voxels if they hit nothing.
absl::StatusOr<RayAnswers> AskRays(const SceneSnapshot& scene,
                                   std::span<const Eigen::Vector3f> origins_W,
                                   std::span<const Eigen::Vector3f> directions_W,
                                   std::span<const Time> times, double max_range_m,
                                   std::uint64_t max_voxels, const Gone& gone);

// NOT_FOUND for an unknown id; ids empty: all objects. RESOURCE_EXHAUSTED for more than
// `max_poses`.
absl::StatusOr<PredictedPoses> AskPoses(const SceneSnapshot& scene, std::span<const ObjectId> ids,
                                        std::span<const Time> times, std::uint64_t max_poses,
                                        const Gone& gone);

}  // namespace clearway
