#include "clearway/io/ply.h"

#include <bit>
#include <cstring>
#include <vector>

#include "absl/strings/str_cat.h"
#include "clearway/base/file.h"
#include "clearway/io/world_origin.h"

namespace clearway {
namespace {

static_assert(std::endian::native == std::endian::little, "written as little endian");

constexpr char kBegin[] =
    "ply\nformat binary_little_endian 1.0\ncomment occupied voxels, in metres\n";
constexpr char kPosition[] = "property float x\nproperty float y\nproperty float z\n";
constexpr char kExactPosition[] = "property double x\nproperty double y\nproperty double z\n";
constexpr char kColorAndObject[] =
    "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty int object\n";
constexpr char kEnd[] = "end_header\n";
constexpr std::size_t kPositionBytes = 12, kColorAndObjectBytes = 7;

template <class T>
void Put(std::string& out, T value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// A face of the unit cube: the neighbour behind it and its corners (bits x, y, z),
// counter-clockwise seen from outside.
struct Face {
  VoxelKey step;
  std::array<int, 4> corners;
};
constexpr std::array<Face, 6> kFaces = {{{{-1, 0, 0}, {0, 4, 6, 2}},
                                         {{1, 0, 0}, {1, 3, 7, 5}},
                                         {{0, -1, 0}, {0, 1, 5, 4}},
                                         {{0, 1, 0}, {2, 6, 7, 3}},
                                         {{0, 0, -1}, {0, 2, 3, 1}},
                                         {{0, 0, 1}, {4, 5, 7, 6}}}};

// Keys of all blocks.
constexpr std::int32_t kFar = kMaxVoxelIndex;
constexpr BlockKey kFirstBlock{-kFar, -kFar, -kFar}, kLastBlock{kFar, kFar, kFar};

// Goes through the layers' occupied voxels once for each part of the file.
class PlyWriter {
 public:
  PlyWriter(std::span<const PlyLayer> layers, const ByteSink& sink)
      : layers_(layers), sink_(sink) {}

  // Both are false once the sink has said so.
  bool WritePoints() {
    std::int64_t vertices = 0;
    for (const PlyLayer& layer : layers_) vertices += layer.map_M->occupied_count();
    pending_ =
        absl::StrCat(kBegin, "element vertex ", vertices, "\n", kPosition, kColorAndObject, kEnd);
    ForEachOccupied([&](const PlyLayer& layer, VoxelKey key) {
      PutVertex(layer, layer.map_M->grid().CenterOf(key));
    });
    return Flush();
  }

  bool WriteCubes() {
    std::int64_t cubes = 0, faces = 0;
    ForEachExposed([&](const PlyLayer&, VoxelKey, unsigned exposed) {
      ++cubes;
      faces += std::popcount(exposed);
    });
    pending_ =
        absl::StrCat(kBegin, "element vertex ", kCorners * cubes, "\n", kPosition, kColorAndObject,
                     "element face ", faces, "\nproperty list uchar uint vertex_indices\n", kEnd);
    ForEachExposed([&](const PlyLayer& layer, VoxelKey key, unsigned) { PutCorners(layer, key); });
    std::uint32_t first = 0;
    ForEachExposed([&](const PlyLayer&, VoxelKey, unsigned exposed) {
      PutFaces(exposed, first);
      first += kCorners;
    });
    return Flush();
  }

 private:
  static constexpr std::size_t kPieceBytes = std::size_t{1} << 16;
  static constexpr int kCorners = 8;

  // Calls visit(layer, key) as long as the sink wants more.
  template <class Visit>
  void ForEachOccupied(Visit&& visit) {
    for (const PlyLayer& layer : layers_) {
      layer.map_M->blocks().AnyOccupiedIn(
          kFirstBlock, kLastBlock, [&](BlockKey key, const VoxelBlock& block) {
            block.occupied.ForEach([&](int index) { visit(layer, VoxelAt(key, index)); });
            if (pending_.size() >= kPieceBytes) Flush();
            return !go_on_;
          });
    }
  }

  // Likewise visit(layer, key, faces), a bit for each of kFaces, where there are any.
  template <class Visit>
  void ForEachExposed(Visit&& visit) {
    ForEachOccupied([&](const PlyLayer& layer, VoxelKey key) {
      unsigned exposed = 0;
      for (std::size_t f = 0; f < kFaces.size(); ++f) {
        const VoxelKey step = kFaces[f].step;
        const VoxelKey neighbour{key.x + step.x, key.y + step.y, key.z + step.z};
        if (layer.map_M->State(neighbour) != VoxelState::kOccupied) exposed |= 1u << f;
      }
      if (exposed != 0) visit(layer, key, exposed);
    });
  }

  void PutVertex(const PlyLayer& layer, const Eigen::Vector3d& p_M) {
    const Eigen::Vector3f p_W = (layer.T_W_M * p_M).cast<float>();
    for (int i = 0; i < 3; ++i) Put(pending_, p_W[i]);
    for (std::uint8_t channel : layer.color) Put(pending_, channel);
    Put(pending_, layer.object);
  }

  void PutCorners(const PlyLayer& layer, VoxelKey key) {
    const Aabb box = layer.map_M->grid().BoxOf(key);
    for (int i = 0; i < kCorners; ++i) {
      PutVertex(layer, {i & 1 ? box.max.x() : box.min.x(), i & 2 ? box.max.y() : box.min.y(),
                        i & 4 ? box.max.z() : box.min.z()});
    }
  }

  void PutFaces(unsigned exposed, std::uint32_t first) {
    for (std::size_t f = 0; f < kFaces.size(); ++f) {
      if ((exposed >> f & 1) == 0) continue;
      Put(pending_, std::uint8_t{4});
      for (int corner : kFaces[f].corners)
        Put(pending_, first + static_cast<std::uint32_t>(corner));
    }
  }

  bool Flush() {
    go_on_ = go_on_ && sink_(pending_);
    pending_.clear();
    return go_on_;
  }

  std::span<const PlyLayer> layers_;
  const ByteSink& sink_;
  std::string pending_;
  bool go_on_ = true;
};

}  // namespace

std::array<std::uint8_t, 3> PlyColorOf(ObjectId object) {
  // Okabe and Ito's palette, told apart by the colour-blind too.
  constexpr std::array<std::array<std::uint8_t, 3>, 7> kPalette = {{{230, 159, 0},
                                                                    {86, 180, 233},
                                                                    {0, 158, 115},
                                                                    {240, 228, 66},
                                                                    {0, 114, 178},
                                                                    {213, 94, 0},
                                                                    {204, 121, 167}}};
  if (object <= kStaticLabel) return PlyLayer().color;
  return kPalette[static_cast<std::size_t>(object) % kPalette.size()];
}

absl::Status WritePly(std::span<const PlyLayer> layers, PlyStyle style, const ByteSink& sink) {
  PlyWriter writer(layers, sink);
  const bool whole = style == PlyStyle::kPoints ? writer.WritePoints() : writer.WriteCubes();
  return whole ? absl::OkStatus() : absl::CancelledError("the PLY file was cancelled");
}

std::string SerializePly(std::span<const PlyLayer> layers, PlyStyle style) {
  std::string ply;
  const absl::Status never_cancelled = WritePly(layers, style, [&](std::string_view piece) {
    ply.append(piece);
    return true;
  });
  never_cancelled.IgnoreError();
  return ply;
}

absl::StatusOr<std::string> WithOriginAdded(std::string_view ply, const Eigen::Vector3d& origin_m) {
  constexpr std::size_t kRowBytes = kPositionBytes + kColorAndObjectBytes;
  const std::size_t end = ply.find(kEnd);
  const std::string_view header = ply.substr(0, end);
  const std::string_view rows =
      end == std::string_view::npos ? std::string_view() : ply.substr(end + sizeof(kEnd) - 1);
  const std::size_t count = rows.size() / kRowBytes;
  const std::string vertices = absl::StrCat("element vertex ", count, "\n");
  if (rows.size() % kRowBytes != 0 ||
      header != absl::StrCat(kBegin, vertices, kPosition, kColorAndObject)) {
    return absl::InvalidArgumentError("not a PLY file of occupied voxels as Clearway writes it");
  }
  std::string moved =
      absl::StrCat(kBegin, "comment origin ", OriginText(origin_m), " added to x, y, z\n", vertices,
                   kExactPosition, kColorAndObject, kEnd);
  moved.reserve(moved.size() + rows.size() + count * kPositionBytes);
  for (std::size_t row = 0; row < count; ++row) {
    const std::string_view bytes = rows.substr(row * kRowBytes, kRowBytes);
    Eigen::Vector3f p;
    std::memcpy(p.data(), bytes.data(), kPositionBytes);
    for (int i = 0; i < 3; ++i) Put(moved, origin_m[i] + p[i]);
    moved += bytes.substr(kPositionBytes);
  }
  return moved;
}

absl::Status WritePly(const std::filesystem::path& path, const VoxelMap& map, PlyStyle style) {
  PlyLayer layer;
  layer.map_M = &map;
  return WriteWholeFile(path, SerializePly({&layer, 1}, style));
}

absl::Status WriteSceneAsPly(const std::filesystem::path& path, const SceneAtTime& scene,
                             PlyStyle style) {
  std::vector<PlyLayer> layers(1);
  layers[0].map_M = &scene.scene().static_map_W;
  for (const SceneAtTime::Placed& placed : scene.objects()) {
    layers.push_back(
        {&placed.object->map_O, placed.T_W_O, placed.object->id, PlyColorOf(placed.object->id)});
  }
  return WriteWholeFile(path, SerializePly(layers, style));
}

}  // namespace clearway
