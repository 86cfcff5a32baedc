#include <octomap/OcTree.h>

#include <charconv>
#include <iterator>
#include <sstream>

#include "absl/strings/str_cat.h"
#include "clearway/base/file.h"
#include "clearway/io/file_type.h"
#include "clearway/io/flatten_scene.h"
#include "clearway/io/octomap_file.h"

namespace clearway {
namespace {

constexpr std::int32_t kHalfWidth = 1 << 15;  // OctoMap's tree_max_val

bool Fits(VoxelKey key) {
  const auto fits = [](std::int32_t i) { return i >= -kHalfWidth && i < kHalfWidth; };
  return fits(key.x) && fits(key.y) && fits(key.z);
}

absl::Status CheckFits(const VoxelMap& map) {
  absl::Status status;
  map.blocks().ForEach([&](BlockKey key, const VoxelBlock&) {
    // Blocks are aligned to OctoMap's bounds: all of one fits or nothing does.
    const VoxelKey first = VoxelAt(key, 0);
    if (Fits(first) || !status.ok()) return;
    const double reach_m = kHalfWidth * map.grid().resolution_m();
    status = absl::OutOfRangeError(absl::StrCat(
        "the map has voxels about (", first.x, ", ", first.y, ", ", first.z,
        "); OctoMap addresses ", -kHalfWidth, " to ", kHalfWidth - 1, " along each axis, at ",
        map.grid().resolution_m(), " m that is ", reach_m, " m from the origin"));
  });
  return status;
}

// Inner nodes hold the maximum of their children, as OctoMap's searches expect.
void Fill(const VoxelMap& map, octomap::OcTree& tree) {
  // The map's values have been clamped by its own model; OctoMap must not clamp them again.
  tree.setClampingThresMin(1e-4);
  tree.setClampingThresMax(1 - 1e-4);
  map.blocks().ForEach([&](BlockKey key, const VoxelBlock& block) {
    block.observed.ForEach([&](int index) {
      const VoxelKey voxel = VoxelAt(key, index);
      const octomap::OcTreeKey octomap_key(static_cast<octomap::key_type>(voxel.x + kHalfWidth),
                                           static_cast<octomap::key_type>(voxel.y + kHalfWidth),
                                           static_cast<octomap::key_type>(voxel.z + kHalfWidth));
      tree.setNodeValue(octomap_key, static_cast<float>(Dequantized(block.log_odds[index])),
                        /*lazy_eval=*/true);
    });
  });
  tree.updateInnerOccupancy();
  tree.prune();
}

// The same with free and occupied alone: any two values on either side of OctoMap's threshold.
VoxelMap StatesOf(const VoxelMap& map) {
  VoxelMap states(map.grid().resolution_m());
  const OccupancyModel& model = states.model();
  map.blocks().ForEach([&](BlockKey key, const VoxelBlock& block) {
    VoxelBlock copy;
    block.observed.ForEach([&](int index) {
      copy.Set(index, block.occupied.Test(index) ? model.clamp_max : model.clamp_min, model);
    });
    states.PutBlock(key, copy);
  });
  return states;
}

// As OctoMap writes it, but with the resolution's digits in full (six would shift the grid), and
// without the message on stderr.
std::string Header(const octomap::OcTree& tree, OctomapFormat format) {
  char resolution[32];
  const auto end = std::to_chars(resolution, std::end(resolution), tree.getResolution()).ptr;
  return absl::StrCat(
      format == OctomapFormat::kBinary ? "# Octomap OcTree binary file" : "# Octomap OcTree file",
      "\n# (feel free to add / change comments, but leave the first line as it is!)\n#\n",
      "id OcTree\nsize ", tree.size(), "\nres ", std::string(resolution, end), "\ndata\n");
}

}  // namespace

absl::StatusOr<std::string> SerializeOctomap(const VoxelMap& map, OctomapFormat format) {
  const absl::Status status = CheckFits(map);
  if (!status.ok()) return status;
  std::ostringstream out(std::ios::binary);
  try {
    octomap::OcTree tree(map.grid().resolution_m());
    if (format == OctomapFormat::kBinary) {
      Fill(StatesOf(map), tree);
      out << Header(tree, format);
      tree.writeBinaryData(out);
    } else {
      Fill(map, tree);
      out << Header(tree, format);
      tree.writeData(out);
    }
  } catch (const std::exception& error) {  // memory above all
    return absl::InternalError(absl::StrCat("OctoMap: ", error.what()));
  }
  return std::move(out).str();
}

absl::Status WriteOctomap(const std::filesystem::path& path, const VoxelMap& map) {
  const std::string extension = LowerExtension(path);
  if (extension != ".bt" && extension != ".ot") {
    return absl::InvalidArgumentError(
        absl::StrCat(path.string(), ": the extension must be .bt or .ot"));
  }
  const absl::StatusOr<std::string> bytes =
      SerializeOctomap(map, extension == ".bt" ? OctomapFormat::kBinary : OctomapFormat::kFull);
  if (!bytes.ok()) {
    return absl::Status(bytes.status().code(),
                        absl::StrCat(path.string(), ": ", std::string(bytes.status().message())));
  }
  return WriteWholeFile(path, *bytes);
}

absl::Status WriteSceneAsOctomap(const std::filesystem::path& path, const SceneAtTime& scene) {
  const absl::StatusOr<VoxelMap> map = FlattenScene(scene);
  return map.ok() ? WriteOctomap(path, *map) : map.status();
}

}  // namespace clearway
