#include <octomap/OcTree.h>

#include <algorithm>
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

// OctoMap's tree, into which whole blocks of one value go as the leaves that pruning would make of
// them: it takes some 50 bytes a node, and large maps are mostly such blocks.
class Tree : public octomap::OcTree {
 public:
  using OcTree::OcTree;

  // Nothing of the block's cube may be there yet.
  void AddBlock(const octomap::OcTreeKey& key, float log_odds) {
    if (root == nullptr) {
      root = new octomap::OcTreeNode();
      ++tree_size;
    }
    octomap::OcTreeNode* node = root;
    for (int level = static_cast<int>(tree_depth) - 1; level >= kBlockBits; --level) {
      const unsigned child = octomap::computeChildIdx(key, level);
      node =
          nodeChildExists(node, child) ? getNodeChild(node, child) : createNodeChild(node, child);
    }
    node->setLogOdds(log_odds);
    size_changed = true;
  }

  // OctoMap's own ends at the first level, from the voxels up, of which it prunes nothing.
  void PruneAllLevels() {
    if (root == nullptr) return;
    unsigned pruned = 0;
    for (unsigned depth = tree_depth - 1; depth > 0; --depth) pruneRecurs(root, 0, depth, pruned);
  }
};

// What is written of a block's observed voxels.
float ValueOf(const VoxelBlock& block, int index, OctomapFormat format) {
  if (format == OctomapFormat::kFull) return static_cast<float>(Dequantized(block.log_odds[index]));
  // Free and occupied alone: any two values on either side of OctoMap's threshold, which is 0.
  return block.occupied.Test(index) ? 1.0F : -1.0F;
}

bool IsUniform(const VoxelBlock& block, OctomapFormat format) {
  if (block.observed.Count() != kVoxelsPerBlock) return false;
  if (format == OctomapFormat::kBinary) {
    return !block.occupied.Any() || block.occupied.Count() == kVoxelsPerBlock;
  }
  return std::ranges::count(block.log_odds, block.log_odds[0]) == kVoxelsPerBlock;
}

// Inner nodes hold the maximum of their children, as OctoMap's searches expect.
void Fill(const VoxelMap& map, OctomapFormat format, Tree& tree) {
  // The map's values have been clamped by its own model; OctoMap must not clamp them again.
  tree.setClampingThresMin(1e-4);
  tree.setClampingThresMax(1 - 1e-4);
  const auto key_of = [](VoxelKey voxel) {
    return octomap::OcTreeKey(static_cast<octomap::key_type>(voxel.x + kHalfWidth),
                              static_cast<octomap::key_type>(voxel.y + kHalfWidth),
                              static_cast<octomap::key_type>(voxel.z + kHalfWidth));
  };
  map.blocks().ForEach([&](BlockKey key, const VoxelBlock& block) {
    if (IsUniform(block, format)) {
      tree.AddBlock(key_of(VoxelAt(key, 0)), ValueOf(block, 0, format));
      return;
    }
    block.observed.ForEach([&](int index) {
      tree.setNodeValue(key_of(VoxelAt(key, index)), ValueOf(block, index, format),
                        /*lazy_eval=*/true);
    });
  });
  tree.updateInnerOccupancy();
  tree.PruneAllLevels();
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
    Tree tree(map.grid().resolution_m());
    Fill(map, format, tree);
    out << Header(tree, format);
    if (format == OctomapFormat::kBinary) {
      tree.writeBinaryData(out);
    } else {
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
