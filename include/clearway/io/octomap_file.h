// OctoMap's files in and out; what they keep and lose is in docs/formats.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "clearway/io/byte_sink.h"
#include "clearway/map/voxel_map.h"
#include "clearway/scene/occupancy.h"

namespace clearway {

// .bt keeps the three-way state alone, .ot the log-odds.
enum class OctomapFormat { kBinary, kFull };

// Guards against files that would not fit into memory.
struct OctomapLimits {
  std::uint64_t max_bytes = std::uint64_t{1} << 30;
  // Of the map in memory, which stores whole blocks of 512 voxels in 1.2 kB each: 1.2 GB.
  std::int64_t max_voxels = std::int64_t{1} << 29;
};

// A map that was read.
struct OctomapFile {
  OctomapFormat format = OctomapFormat::kBinary;
  std::string tree_type;  // as the header says: "OcTree", "ColorOcTree", ...
  VoxelMap map;           // in the frame of the file; its resolution is the file's
  // Voxels whose log-odds were beyond the model's clamps by more than 0.001 and were pulled in.
  std::int64_t clamped_voxels = 0;
  std::vector<std::string> unknown_keys;  // of the header
};

// What Resample makes at most: 100 m x 100 m x 13 m of known space in voxels of 0.1 m. The map
// takes 0.3 GB then, and while it is made 0.6 GB.
inline constexpr std::int64_t kMaxResampledVoxels = std::int64_t{1} << 27;

// The map in voxels of another size, of which none claims to know more: a voxel is occupied if any
// voxel of `map` that it overlaps is, free if all of it lies in free voxels, else unknown. What is
// occupied or free gets the model's clamps as log-odds. Overlaps thinner than a thousandth of the
// smaller voxel are rounding. RESOURCE_EXHAUSTED, before memory is taken, if it would have more
// than max_voxels, and if whole blocks of it would.
absl::StatusOr<VoxelMap> Resample(const VoxelMap& map, double resolution_m,
                                  std::int64_t max_voxels = kMaxResampledVoxels);

// Reads `.bt` and `.ot` of OcTree, ColorOcTree and OcTreeStamped (colours and stamps are left out),
// told apart by their first line. Pruned leaves are expanded to voxels. A voxel's state is that of
// OctoMap at the model's threshold; .bt gives the clamps as log-odds. The whole file must be one
// tree: INVALID_ARGUMENT names the line of the header, or the byte, at which it is cut off, goes on
// after its end, nests deeper than 16 levels, or holds a value that is no number;
// RESOURCE_EXHAUSTED what exceeds the limits, before memory is taken; CANCELLED soon after
// `cancelled`, which is asked every so often, has become true. `name` names the file in messages.
absl::StatusOr<OctomapFile> ParseOctomap(
    const std::string& name, std::string_view bytes, const OccupancyModel& model = {},
    const OctomapLimits& limits = {},
    const std::function<bool()>& cancelled = [] { return false; });
absl::StatusOr<OctomapFile> ReadOctomap(const std::filesystem::path& path,
                                        const OccupancyModel& model = {},
                                        const OctomapLimits& limits = {});

// The file of a map, piece by piece: byte for byte what OctoMap's library makes of the pruned tree,
// but with all digits of the resolution. Takes some 60 bytes of memory for each block of the map.
// OUT_OF_RANGE if a voxel's index is outside OctoMap's 16 bits; CANCELLED once the sink wants no
// more, or soon after `cancelled`, which is asked every so often, has become true.
absl::Status WriteOctomap(
    const VoxelMap& map, OctomapFormat format, const ByteSink& sink,
    const std::function<bool()>& cancelled = [] { return false; });
// All of it.
absl::StatusOr<std::string> SerializeOctomap(const VoxelMap& map, OctomapFormat format);

// Writes `.bt` or `.ot`, by the path's extension; INVALID_ARGUMENT for another one.
absl::Status WriteOctomap(const std::filesystem::path& path, const VoxelMap& map);

// Writes the whole scene at its time: what FlattenScene makes of it.
absl::Status WriteSceneAsOctomap(const std::filesystem::path& path, const SceneAtTime& scene);

}  // namespace clearway
