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

class PlyBuilder {
 public:
  void AddPoints(const PlyLayer& layer) {
    ForEachOccupied(*layer.map_M,
                    [&](VoxelKey key) { AddVertex(layer, layer.map_M->grid().CenterOf(key)); });
  }

  void AddCubes(const PlyLayer& layer) {
    ForEachOccupied(*layer.map_M, [&](VoxelKey key) { AddCube(layer, key); });
  }

  std::string Build(PlyStyle style) const {
    std::string ply =
        absl::StrCat(kBegin, "element vertex ", vertex_count_, "\n", kPosition, kColorAndObject);
    if (style == PlyStyle::kCubes) {
      absl::StrAppend(&ply, "element face ", face_count_,
                      "\nproperty list uchar uint vertex_indices\n");
    }
    ply += kEnd;
    return ply + vertices_ + faces_;
  }

 private:
  template <class Visit>
  static void ForEachOccupied(const VoxelMap& map, Visit&& visit) {
    map.blocks().ForEach([&](BlockKey key, const VoxelBlock& block) {
      block.occupied.ForEach([&](int index) { visit(VoxelAt(key, index)); });
    });
  }

  void AddVertex(const PlyLayer& layer, const Eigen::Vector3d& p_M) {
    const Eigen::Vector3f p_W = (layer.T_W_M * p_M).cast<float>();
    for (int i = 0; i < 3; ++i) Put(vertices_, p_W[i]);
    for (std::uint8_t channel : layer.color) Put(vertices_, channel);
    Put(vertices_, layer.object);
    ++vertex_count_;
  }

  void AddCube(const PlyLayer& layer, VoxelKey key) {
    const std::uint32_t first = vertex_count_;
    bool exposed = false;
    for (const Face& face : kFaces) {
      const VoxelKey neighbour{key.x + face.step.x, key.y + face.step.y, key.z + face.step.z};
      if (layer.map_M->State(neighbour) == VoxelState::kOccupied) continue;
      exposed = true;
      Put(faces_, std::uint8_t{4});
      for (int corner : face.corners) Put(faces_, first + static_cast<std::uint32_t>(corner));
      ++face_count_;
    }
    if (!exposed) return;
    const Aabb box = layer.map_M->grid().BoxOf(key);
    for (int i = 0; i < 8; ++i) {
      AddVertex(layer, {i & 1 ? box.max.x() : box.min.x(), i & 2 ? box.max.y() : box.min.y(),
                        i & 4 ? box.max.z() : box.min.z()});
    }
  }

  std::string vertices_;
  std::string faces_;
  std::uint32_t vertex_count_ = 0;
  std::uint32_t face_count_ = 0;
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

std::string SerializePly(std::span<const PlyLayer> layers, PlyStyle style) {
  PlyBuilder builder;
  for (const PlyLayer& layer : layers) {
    style == PlyStyle::kPoints ? builder.AddPoints(layer) : builder.AddCubes(layer);
  }
  return builder.Build(style);
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
