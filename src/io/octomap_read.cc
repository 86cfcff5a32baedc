// Reads the octree itself rather than by OctoMap's library: that one trusts its input, recurses as
// deep as a file tells it to, and takes 80 bytes for each node.
#include <cmath>
#include <cstring>

#include "absl/strings/str_cat.h"
#include "clearway/base/file.h"
#include "clearway/io/octomap_file.h"
#include "io/octomap_header.h"

namespace clearway {
namespace {

constexpr int kDepth = 16;                    // levels below the root; voxels are the last
constexpr std::int32_t kHalfWidth = 1 << 15;  // of the root, in voxels
constexpr int kBlockDepth = kDepth - kBlockBits;
constexpr double kClampTolerance = 0.001;

// The lowest voxel of child `i` of a node of `depth` (OctoMap's computeChildIdx).
VoxelKey ChildBase(VoxelKey base, int depth, int i) {
  const std::int32_t width = 1 << (kDepth - depth - 1);
  return {base.x + (i & 1 ? width : 0), base.y + (i & 2 ? width : 0), base.z + (i & 4 ? width : 0)};
}

// Collects leaves, which come subtree by subtree, into blocks.
class MapFiller {
 public:
  MapFiller(VoxelMap& map, std::int64_t max_voxels, const std::function<bool()>& cancelled)
      : map_(map), max_blocks_(max_voxels / kVoxelsPerBlock), cancelled_(cancelled) {}

  // Fills the leaf's cube; false if the map would exceed its limit, or once cancelled.
  bool Fill(VoxelKey base, int depth, LogOdds value) {
    if (Cancelled()) return false;
    if (depth > kBlockDepth) return FillInBlock(base, kDepth - depth, value);
    const int levels = kBlockDepth - depth;
    if (!Reserve(std::int64_t{1} << (3 * levels))) return false;
    VoxelBlock block;
    for (int i = 0; i < kVoxelsPerBlock; ++i) block.Set(i, value, map_.model());
    const BlockKey first = BlockOf(base);
    const std::int32_t width = 1 << levels;
    for (std::int32_t z = 0; z < width; ++z) {
      for (std::int32_t y = 0; y < width; ++y) {
        for (std::int32_t x = 0; x < width; ++x) {
          if (Cancelled()) return false;
          map_.PutBlock({first.x + x, first.y + y, first.z + z}, block);
        }
      }
    }
    return true;
  }

  void Flush() {
    if (open_) map_.PutBlock(key_, block_);
    open_ = false;
  }

  bool cancelled() const { return is_cancelled_; }

 private:
  static constexpr int kFillsPerLook = 256;  // of a block at most

  bool Cancelled() {
    is_cancelled_ = is_cancelled_ || (++fills_ % kFillsPerLook == 0 && cancelled_());
    return is_cancelled_;
  }
  bool Reserve(std::int64_t blocks) {
    blocks_ += blocks;
    return blocks_ <= max_blocks_;
  }

  bool FillInBlock(VoxelKey base, int log2_width, LogOdds value) {
    const BlockKey key = BlockOf(base);
    if (!open_ || key != key_) {
      Flush();
      if (!Reserve(1)) return false;
      key_ = key;
      block_ = VoxelBlock();
      open_ = true;
    }
    const int width = 1 << log2_width;
    for (int i = 0; i < width * width * width; ++i) {
      const int x = i & (width - 1), y = i >> log2_width & (width - 1), z = i >> 2 * log2_width;
      block_.Set(IndexInBlock({base.x + x, base.y + y, base.z + z}), value, map_.model());
    }
    return true;
  }

  VoxelMap& map_;
  std::int64_t max_blocks_;
  const std::function<bool()>& cancelled_;
  std::int64_t blocks_ = 0, fills_ = 0;
  bool is_cancelled_ = false;
  bool open_ = false;
  BlockKey key_;
  VoxelBlock block_;
};

// Walks the nodes in the file's order, depth first.
class TreeReader {
 public:
  TreeReader(const std::string& name, std::string_view bytes, const OctomapHeader& header,
             const OctomapLimits& limits, const std::function<bool()>& cancelled, OctomapFile& file)
      : name_(name),
        bytes_(bytes),
        header_(header),
        limits_(limits),
        file_(file),
        filler_(file.map, limits.max_voxels, cancelled),
        at_(header.data_begin),
        extra_bytes_(header.tree_type == "ColorOcTree" ? 3 : 0) {}

  absl::Status Read() {
    if (header_.nodes > 0) {
      const VoxelKey root{-kHalfWidth, -kHalfWidth, -kHalfWidth};
      nodes_ = 1;
      const bool done =
          header_.format == OctomapFormat::kBinary ? BinaryNode(root, 0) : FullNode(root, 0);
      if (!done) return error_;
    }
    filler_.Flush();
    if (at_ != bytes_.size()) {
      Fail(absl::StrCat(bytes_.size() - at_, " bytes follow the end of the tree"));
    } else if (header_.format == OctomapFormat::kBinary && nodes_ != header_.nodes) {
      Fail(absl::StrCat(nodes_, " nodes; the header says ", header_.nodes));
    }
    return error_;
  }

 private:
  // Two bits for each child: 1 free, 2 occupied, 3 a node of its own.
  bool BinaryNode(VoxelKey base, int depth) {
    if (bytes_.size() - at_ < 2) return Fail("the file is cut off");
    const unsigned codes =
        static_cast<unsigned char>(bytes_[at_]) | static_cast<unsigned char>(bytes_[at_ + 1]) << 8;
    if (codes == 0) return Fail("an inner node without children");
    at_ += 2;
    for (int i = 0; i < 8; ++i) {
      const unsigned code = codes >> 2 * i & 3;
      nodes_ += code != 0;
      if (code == 3 && depth + 1 == kDepth) return Fail("nodes nest deeper than 16 levels");
      if (code == 0 || code == 3) continue;
      const OccupancyModel& model = file_.map.model();
      if (!Leaf(ChildBase(base, depth, i), depth + 1,
                code == 1 ? model.clamp_min : model.clamp_max)) {
        return false;
      }
    }
    for (int i = 0; i < 8; ++i) {
      if ((codes >> 2 * i & 3) == 3 && !BinaryNode(ChildBase(base, depth, i), depth + 1)) {
        return false;
      }
    }
    return true;
  }

  // The log-odds as float32, a colour if the tree has them, and one bit for each child.
  bool FullNode(VoxelKey base, int depth) {
    if (bytes_.size() - at_ < 5 + extra_bytes_) return Fail("the file is cut off");
    float log_odds;
    std::memcpy(&log_odds, bytes_.data() + at_, sizeof log_odds);
    const unsigned children = static_cast<unsigned char>(bytes_[at_ + 4 + extra_bytes_]);
    if (children == 0 && std::isnan(log_odds)) return Fail("log-odds that are not a number");
    if (children != 0 && depth == kDepth) return Fail("nodes nest deeper than 16 levels");
    at_ += 5 + extra_bytes_;
    if (children == 0) return Leaf(base, depth, Stored(log_odds, depth));
    for (int i = 0; i < 8; ++i) {
      if ((children >> i & 1) != 0 && !FullNode(ChildBase(base, depth, i), depth + 1)) return false;
    }
    return true;
  }

  // Rounds to the map's steps, on the side of the threshold where OctoMap has the value.
  LogOdds Stored(double log_odds, int depth) {
    const OccupancyModel& model = file_.map.model();
    const LogOdds value = std::clamp(Quantized(log_odds), model.clamp_min, model.clamp_max);
    if (!(std::abs(Dequantized(value) - log_odds) <= kClampTolerance)) {
      file_.clamped_voxels += std::int64_t{1} << 3 * (kDepth - depth);
    }
    if (log_odds >= Dequantized(model.occupied)) return std::max(value, model.occupied);
    return std::min<LogOdds>(value, model.occupied - 1);
  }

  bool Leaf(VoxelKey base, int depth, LogOdds value) {
    if (filler_.Fill(base, depth, value)) return true;
    if (filler_.cancelled()) {
      error_ = absl::CancelledError(absl::StrCat(name_, ": reading it was cancelled"));
      return false;
    }
    error_ = absl::ResourceExhaustedError(absl::StrCat(
        name_, ", byte ", at_, ": the tree fills more than ", limits_.max_voxels / kVoxelsPerBlock,
        " blocks of 8 x 8 x 8 voxels, the limit"));
    return false;
  }

  bool Fail(const std::string& why) {
    error_ = absl::InvalidArgumentError(absl::StrCat(name_, ", byte ", at_, ": ", why));
    return false;
  }

  const std::string& name_;
  std::string_view bytes_;
  const OctomapHeader& header_;
  const OctomapLimits& limits_;
  OctomapFile& file_;
  MapFiller filler_;
  std::size_t at_;
  std::size_t extra_bytes_;
  std::uint64_t nodes_ = 0;
  absl::Status error_;
};

}  // namespace

absl::StatusOr<OctomapFile> ParseOctomap(const std::string& name, std::string_view bytes,
                                         const OccupancyModel& model, const OctomapLimits& limits,
                                         const std::function<bool()>& cancelled) {
  const absl::StatusOr<OctomapHeader> header = ParseOctomapHeader(name, bytes);
  if (!header.ok()) return header.status();
  OctomapFile file{header->format, header->tree_type, VoxelMap(header->resolution_m, model), 0,
                   header->unknown_keys};
  const absl::Status status = TreeReader(name, bytes, *header, limits, cancelled, file).Read();
  if (!status.ok()) return status;
  return file;
}

absl::StatusOr<OctomapFile> ReadOctomap(const std::filesystem::path& path,
                                        const OccupancyModel& model, const OctomapLimits& limits) {
  const absl::StatusOr<std::string> bytes = ReadWholeFile(path, limits.max_bytes);
  if (!bytes.ok()) return bytes.status();
  return ParseOctomap(path.string(), *bytes, model, limits);
}

}  // namespace clearway
