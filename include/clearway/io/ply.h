// PLY files of occupied voxels, for viewers (MeshLab, CloudCompare, Open3D).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "clearway/geometry/pose.h"
#include "clearway/io/byte_sink.h"
#include "clearway/map/voxel_map.h"
#include "clearway/scene/occupancy.h"

namespace clearway {

enum class PlyStyle {
  kPoints,  // a vertex at each voxel's centre
  kCubes,   // the faces between occupied voxels and others
};

// One map in the picture.
struct PlyLayer {
  const VoxelMap* map_M = nullptr;  // must outlive the call
  Pose T_W_M;
  ObjectId object = kStaticLabel;
  std::array<std::uint8_t, 3> color = {160, 160, 160};  // red, green, blue
};

// A colour for an object, the same in every file; grey for the static map.
std::array<std::uint8_t, 3> PlyColorOf(ObjectId object);

// Binary little endian PLY, in W: vertices with x, y, z (float, metres), red, green, blue (uchar)
// and object (int); faces of four vertices, counter-clockwise seen from outside.
std::string SerializePly(std::span<const PlyLayer> layers, PlyStyle style);
// The same piece by piece. CANCELLED once the sink wants no more.
absl::Status WritePly(std::span<const PlyLayer> layers, PlyStyle style, const ByteSink& sink);

// What SerializePly made of points, with the origin added to each of them: x, y, z become doubles,
// so that the coordinates of UTM keep their decimals; a comment names the origin. INVALID_ARGUMENT
// for other bytes.
absl::StatusOr<std::string> WithOriginAdded(std::string_view ply, const Eigen::Vector3d& origin_m);

// UNAVAILABLE if the file cannot be written.
absl::Status WritePly(const std::filesystem::path& path, const VoxelMap& map, PlyStyle style);
// The static map and every object in its own colour, at the scene's time: an object beyond the
// horizon where it was last placed.
absl::Status WriteSceneAsPly(const std::filesystem::path& path, const SceneAtTime& scene,
                             PlyStyle style);

}  // namespace clearway
