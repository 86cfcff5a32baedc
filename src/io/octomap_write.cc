#include <charconv>
#include <cstring>
#include <iterator>

#include "absl/strings/str_cat.h"
#include "clearway/base/file.h"
#include "clearway/io/file_type.h"
#include "clearway/io/flatten_scene.h"
#include "clearway/io/octomap_file.h"
#include "io/octomap_nodes.h"

namespace clearway {
namespace {

constexpr std::int32_t kHalfWidth = kOctomapHalfWidth;

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

// As OctoMap writes it, but with the resolution's digits in full (six would shift the grid).
std::string Header(const OctomapNodes& nodes, double resolution_m, OctomapFormat format) {
  char resolution[32];
  const auto end = std::to_chars(resolution, std::end(resolution), resolution_m).ptr;
  return absl::StrCat(
      format == OctomapFormat::kBinary ? "# Octomap OcTree binary file" : "# Octomap OcTree file",
      "\n# (feel free to add / change comments, but leave the first line as it is!)\n#\n",
      "id OcTree\nsize ", nodes.Empty() ? 0 : nodes.root().count, "\nres ",
      std::string(resolution, end), "\ndata\n");
}

// Writes the nodes from the root down, as OctoMap's writeData and writeBinaryData do.
class Writer {
 public:
  Writer(const OctomapNodes& nodes, OctomapFormat format, const ByteSink& sink)
      : nodes_(nodes), format_(format), sink_(sink) {}

  // False once the sink has said so.
  bool Write(std::string_view header) {
    pending_.append(header);
    if (!nodes_.Empty()) {
      if (format_ == OctomapFormat::kFull) PutNode(nodes_.root());
      WriteBelow(OctomapNodes::kRootLevel, 0);
    }
    return Flush();
  }

 private:
  static constexpr std::size_t kPieceBytes = std::size_t{1} << 16;

  void WriteBelow(int level, std::size_t i) {
    if (level == 0) {
      WriteWithin(OctomapBlock(nodes_.block(i), format_), 0, 0);
      return;
    }
    std::size_t next = nodes_.FirstChildOf(level, i);
    const auto below = [&](std::size_t, bool leaf) {
      if (!leaf) WriteBelow(level - 1, next);
      ++next;
    };
    WriteChildren(nodes_.ChildrenOf(level, i), below);
  }

  void WriteWithin(const OctomapBlock& block, int level, std::size_t i) {
    const auto below = [&](std::size_t child, bool leaf) {
      if (!leaf) WriteWithin(block, level + 1, 8 * i + child);
    };
    WriteChildren(block.ChildrenOf(level, i), below);
  }

  // Which children a node has, and with below(child, leaf) each of them in turn.
  template <class Below>
  void WriteChildren(const OctomapChildren& children, Below&& below) {
    unsigned exists = 0, codes = 0;
    for (std::size_t c = 0; c < children.size(); ++c) {
      if (!children[c].exists()) continue;
      exists |= 1u << c;
      codes |= (!children[c].leaf ? 3u : children[c].log_odds >= 0 ? 2u : 1u) << 2 * c;
    }
    const bool full = format_ == OctomapFormat::kFull;
    pending_.push_back(static_cast<char>(full ? exists : codes & 0xff));
    if (!full) pending_.push_back(static_cast<char>(codes >> 8));
    if (pending_.size() >= kPieceBytes) Flush();
    for (std::size_t c = 0; c < children.size() && go_on_; ++c) {
      if (!children[c].exists()) continue;
      if (full) PutNode(children[c]);
      below(c, children[c].leaf);
    }
  }

  void PutNode(const OctomapNode& node) {
    char bytes[sizeof node.log_odds];
    std::memcpy(bytes, &node.log_odds, sizeof bytes);
    pending_.append(bytes, sizeof bytes);
    if (node.leaf) pending_.push_back(0);  // it has no children
  }

  bool Flush() {
    go_on_ = go_on_ && sink_(pending_);
    pending_.clear();
    return go_on_;
  }

  const OctomapNodes& nodes_;
  const OctomapFormat format_;
  const ByteSink& sink_;
  std::string pending_;
  bool go_on_ = true;
};

}  // namespace

absl::Status WriteOctomap(const VoxelMap& map, OctomapFormat format, const ByteSink& sink,
                          const std::function<bool()>& cancelled) {
  if (const absl::Status status = CheckFits(map); !status.ok()) return status;
  const OctomapNodes nodes(map, format, cancelled);
  const std::string header = Header(nodes, map.grid().resolution_m(), format);
  if (cancelled() || !Writer(nodes, format, sink).Write(header)) {
    return absl::CancelledError("the map's file was cancelled");
  }
  return absl::OkStatus();
}

absl::StatusOr<std::string> SerializeOctomap(const VoxelMap& map, OctomapFormat format) {
  std::string bytes;
  const auto append = [&](std::string_view piece) {
    bytes.append(piece);
    return true;
  };
  const absl::Status status = WriteOctomap(map, format, append);
  if (!status.ok()) return status;
  return bytes;
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
