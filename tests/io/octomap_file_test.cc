#include "clearway/io/octomap_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>

#include <cstring>
#include <memory>
#include <random>
#include <sstream>

#include "clearway/io/lidar_folder.h"
#include "clearway/scene/scene_builder.h"
#include "support/data_folder.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using ::testing::HasSubstr;

constexpr std::int32_t kHalfWidth = 1 << 15;

// Voxels of every value in random places, on both sides of the origin, and a solid cube that
// OctoMap prunes.
VoxelMap ExampleMap() {
  VoxelMap map(0.1);
  std::mt19937 random(7);
  std::uniform_int_distribution<int> place(-40, 40), value(-8192, 14381);
  for (int i = 0; i < 3000; ++i) {
    map.Set({place(random), place(random), place(random)}, static_cast<LogOdds>(value(random)));
  }
  for (int i = 0; i < 32 * 32 * 32; ++i) {
    map.Set({64 + i % 32, i / 32 % 32, i / 1024}, map.model().clamp_max);
  }
  return map;
}

std::unique_ptr<octomap::OcTree> ReadByOctomap(const std::string& bytes, OctomapFormat format) {
  std::istringstream in(bytes);
  if (format == OctomapFormat::kBinary) {
    auto tree = std::make_unique<octomap::OcTree>(1.0);
    return tree->readBinary(in) ? std::move(tree) : nullptr;
  }
  return std::unique_ptr<octomap::OcTree>(
      dynamic_cast<octomap::OcTree*>(octomap::AbstractOcTree::read(in)));
}

octomap::OcTreeKey KeyFor(VoxelKey key) {
  return {static_cast<octomap::key_type>(key.x + kHalfWidth),
          static_cast<octomap::key_type>(key.y + kHalfWidth),
          static_cast<octomap::key_type>(key.z + kHalfWidth)};
}

// Calls visit(key, log_odds) for each voxel of the tree, pruned ones expanded.
template <class Tree, class Visit>
void ForEachVoxel(const Tree& tree, Visit&& visit) {
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    const octomap::OcTreeKey first = leaf.getIndexKey();
    const std::int32_t width = 1 << (16 - leaf.getDepth());
    for (std::int32_t i = 0; i < width * width * width; ++i) {
      visit(VoxelKey{first[0] - kHalfWidth + i % width, first[1] - kHalfWidth + i / width % width,
                     first[2] - kHalfWidth + i / width / width},
            leaf->getLogOdds());
    }
  }
}

std::int64_t StateDifferences(const VoxelMap& map, const octomap::OcTree& tree) {
  std::int64_t differences = 0, voxels = 0;
  ForEachVoxel(tree, [&](VoxelKey key, float log_odds) {
    ++voxels;
    const VoxelState state = log_odds >= 0 ? VoxelState::kOccupied : VoxelState::kFree;
    differences += map.State(key) != state;
  });
  return differences + std::abs(voxels - map.observed_count());
}

std::string Serialized(const VoxelMap& map, OctomapFormat format) {
  const auto bytes = SerializeOctomap(map, format);
  EXPECT_TRUE(bytes.ok()) << bytes.status();
  return bytes.value_or("");
}

std::string ErrorOf(const std::string& bytes) {
  const auto file = ParseOctomap("m.bt", bytes);
  EXPECT_EQ(file.status().code(), absl::StatusCode::kInvalidArgument);
  return std::string(file.status().message());
}

const std::string kHeader = "# Octomap OcTree binary file\nid OcTree\nsize 2\nres 0.1\ndata\n";

TEST(OctomapFile, Empty) {
  for (const OctomapFormat format : {OctomapFormat::kBinary, OctomapFormat::kFull}) {
    const auto dut = ParseOctomap("m", Serialized(VoxelMap(0.2), format));
    ASSERT_TRUE(dut.ok()) << dut.status();
    EXPECT_EQ(dut->map.observed_count(), 0);
    EXPECT_EQ(dut->map.grid().resolution_m(), 0.2);
  }
}

TEST(OctomapFile, FullFormatKeepsLogOdds) {
  const VoxelMap map = ExampleMap();
  const auto dut = ParseOctomap("m.ot", Serialized(map, OctomapFormat::kFull));
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->format, OctomapFormat::kFull);
  EXPECT_EQ(dut->clamped_voxels, 0);
  EXPECT_EQ(dut->map, map);
}

TEST(OctomapFile, BinaryFormatKeepsStates) {
  const VoxelMap map = ExampleMap();
  const auto dut = ParseOctomap("m.bt", Serialized(map, OctomapFormat::kBinary));
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->format, OctomapFormat::kBinary);
  EXPECT_EQ(dut->map.observed_count(), map.observed_count());
  EXPECT_EQ(dut->map.occupied_count(), map.occupied_count());
  map.blocks().ForEach([&](BlockKey key, const VoxelBlock& block) {
    const VoxelBlock* const read = dut->map.blocks().Find(key);
    ASSERT_NE(read, nullptr);
    EXPECT_EQ(read->occupied, block.occupied);
    EXPECT_EQ(read->observed, block.observed);
  });
}

TEST(OctomapFile, OctomapReadsWhatWeWrite) {
  const VoxelMap map = ExampleMap();
  for (const OctomapFormat format : {OctomapFormat::kBinary, OctomapFormat::kFull}) {
    const auto tree = ReadByOctomap(Serialized(map, format), format);
    ASSERT_NE(tree, nullptr);
    EXPECT_EQ(tree->getResolution(), 0.1);
    EXPECT_EQ(StateDifferences(map, *tree), 0);
    if (format != OctomapFormat::kFull) continue;
    ForEachVoxel(*tree, [&](VoxelKey key, float log_odds) {
      ASSERT_NEAR(Dequantized(*map.Find(key)), log_odds, 0.001);
    });
  }
}

TEST(OctomapFile, InnerNodesHoldTheirChildrensMaximum) {
  VoxelMap map(0.1);
  map.Set({0, 0, 0}, map.model().clamp_max);
  map.Set({1, 0, 0}, map.model().clamp_min);
  const auto tree = ReadByOctomap(Serialized(map, OctomapFormat::kFull), OctomapFormat::kFull);
  ASSERT_NE(tree, nullptr);
  const auto* const inner = tree->search(KeyFor({1, 0, 0}), 15);
  ASSERT_NE(inner, nullptr);
  EXPECT_TRUE(tree->isNodeOccupied(inner));
}

TEST(OctomapFile, KeepsAResolutionOfManyDigits) {
  VoxelMap map(1.0 / 30.0);
  map.Set({1, 2, 3}, 0);
  const auto dut = ParseOctomap("m.bt", Serialized(map, OctomapFormat::kBinary));
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->map.grid().resolution_m(), 1.0 / 30.0);
}

TEST(OctomapFile, ReadsWhatOctomapWrites) {
  octomap::ColorOcTree tree(0.05);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(-3, 3);
  for (int i = 0; i < 2000; ++i) {
    const octomap::point3d p(place(random), place(random), place(random));
    tree.updateNode(p, i % 3 != 0);
    tree.setNodeColor(p.x(), p.y(), p.z(), 10, 20, 30);
  }
  tree.updateInnerOccupancy();
  std::ostringstream out;
  tree.write(out);
  const auto dut = ParseOctomap("m.ot", out.str());
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->tree_type, "ColorOcTree");
  std::int64_t voxels = 0;
  ForEachVoxel(tree, [&](VoxelKey key, float log_odds) {
    ++voxels;
    ASSERT_TRUE(dut->map.Find(key).has_value());
    EXPECT_NEAR(Dequantized(*dut->map.Find(key)), log_odds, 0.001);
    EXPECT_EQ(dut->map.State(key) == VoxelState::kOccupied, log_odds >= 0);
  });
  EXPECT_EQ(voxels, dut->map.observed_count());
}

TEST(OctomapFile, ValuesNearTheThresholdKeepTheirSide) {
  octomap::OcTree tree(0.1);
  tree.setNodeValue(KeyFor({0, 0, 0}), -1e-6f);
  tree.setNodeValue(KeyFor({5, 0, 0}), 0.0f);
  std::ostringstream out;
  tree.write(out);
  const auto dut = ParseOctomap("m.ot", out.str());
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->map.State({0, 0, 0}), VoxelState::kFree);
  EXPECT_EQ(dut->map.State({5, 0, 0}), VoxelState::kOccupied);
}

TEST(OctomapFile, CountsWhatTheModelClamps) {
  octomap::OcTree tree(0.1);
  tree.setClampingThresMax(0.999);
  tree.setNodeValue(KeyFor({0, 0, 0}), 6.0f);
  std::ostringstream out;
  tree.write(out);
  const auto dut = ParseOctomap("m.ot", out.str());
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->clamped_voxels, 1);
  EXPECT_EQ(dut->map.Find({0, 0, 0}), dut->map.model().clamp_max);
}

TEST(OctomapFile, WritesByExtension) {
  TemporaryFolder folder;
  const VoxelMap map = ExampleMap();
  ASSERT_TRUE(WriteOctomap(folder / "m.bt", map).ok());
  ASSERT_TRUE(WriteOctomap(folder / "m.ot", map).ok());
  EXPECT_EQ(ReadOctomap(folder / "m.bt")->format, OctomapFormat::kBinary);
  EXPECT_EQ(ReadOctomap(folder / "m.ot")->format, OctomapFormat::kFull);
  EXPECT_EQ(WriteOctomap(folder / "m.oct", map).code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(WriteOctomap(folder / "no/folder/m.bt", map).code(), absl::StatusCode::kUnavailable);
  EXPECT_EQ(ReadOctomap(folder / "none.bt").status().code(), absl::StatusCode::kNotFound);
}

TEST(OctomapFile, RefusesVoxelsThatOctomapCannotAddress) {
  VoxelMap map(0.1);
  map.Set({32767, -32768, 0}, 100);
  EXPECT_TRUE(SerializeOctomap(map, OctomapFormat::kFull).ok());
  map.Set({0, 32768, 0}, 100);
  const auto bytes = SerializeOctomap(map, OctomapFormat::kFull);
  EXPECT_EQ(bytes.status().code(), absl::StatusCode::kOutOfRange);
  EXPECT_THAT(std::string(bytes.status().message()),
              AllOf(HasSubstr("32768"), HasSubstr("-32768 to 32767"), HasSubstr("3276.8 m")));
}

TEST(OctomapFile, RefusesFilesCutOffAtAnyByte) {
  VoxelMap map(0.1);
  for (int i = 0; i < 40; ++i) map.Set({i, i * i % 7, i / 3}, static_cast<LogOdds>(100 * i - 900));
  for (const OctomapFormat format : {OctomapFormat::kBinary, OctomapFormat::kFull}) {
    const std::string whole = Serialized(map, format);
    ASSERT_TRUE(ParseOctomap("m", whole).ok());
    for (std::size_t size = 0; size < whole.size(); ++size) {
      const auto dut = ParseOctomap("m", whole.substr(0, size));
      EXPECT_EQ(dut.status().code(), absl::StatusCode::kInvalidArgument) << size;
    }
    EXPECT_THAT(ErrorOf(whole + "x"), HasSubstr("1 bytes follow the end of the tree"));
  }
}

TEST(OctomapFile, SurvivesAnyDamagedByte) {
  OctomapLimits limits;
  limits.max_voxels = 1 << 24;  // a damaged bit can make a leaf of half the world
  const std::string whole = Serialized(ExampleMap(), OctomapFormat::kFull);
  std::mt19937 random(5);
  for (int i = 0; i < 300; ++i) {
    std::string damaged = whole;
    damaged[random() % (i % 2 == 0 ? 200 : whole.size())] ^= static_cast<char>(1 << random() % 8);
    const auto dut = ParseOctomap("m", damaged, {}, limits);
    EXPECT_TRUE(dut.ok() || !dut.status().message().empty());
  }
}

TEST(OctomapFile, RefusesBadHeadersNamingTheLine) {
  EXPECT_THAT(ErrorOf("ply\nformat ascii 1.0\n"), HasSubstr("m.bt, line 1: does not start with"));
  EXPECT_THAT(ErrorOf("# Octomap OcTree binary file\nid Tree\nsize 1\nres 1\ndata\n"),
              HasSubstr("line 5: id is none of"));
  EXPECT_THAT(ErrorOf("# Octomap OcTree binary file\nid OcTree\nsize x\nres 1\ndata\n"),
              HasSubstr("line 3: size"));
  EXPECT_THAT(ErrorOf("# Octomap OcTree binary file\nid OcTree\nres 1\ndata\n"),
              HasSubstr("no size"));
  EXPECT_THAT(ErrorOf("# Octomap OcTree binary file\nid OcTree\nsize 1\nres -1\ndata\n"),
              HasSubstr("res is missing or not above 0"));
  EXPECT_THAT(ErrorOf("# Octomap OcTree binary file\nid OcTree\nsize 1\nres nan\ndata\n"),
              HasSubstr("res is missing or not above 0"));
  EXPECT_THAT(ErrorOf("# Octomap OcTree binary file\nsomething else\ndata\n"),
              HasSubstr("line 2: none of id, size, res, data"));
}

TEST(OctomapFile, RefusesTreesThatOctomapWouldReadBeyondBounds) {
  EXPECT_THAT(ErrorOf(kHeader + std::string(100000, '\xff')),
              HasSubstr("nodes nest deeper than 16 levels"));
  EXPECT_THAT(ErrorOf(kHeader + std::string(2, '\0')), HasSubstr("an inner node without children"));
  std::string full = "# Octomap OcTree file\nid OcTree\nsize 1\nres 0.1\ndata\n";
  const float nan = std::numeric_limits<float>::quiet_NaN();
  full.append(reinterpret_cast<const char*>(&nan), 4).push_back('\0');
  EXPECT_THAT(ErrorOf(full), HasSubstr("log-odds that are not a number"));
}

TEST(OctomapFile, RefusesAWrongNumberOfNodes) {
  VoxelMap map(0.1);
  map.Set({0, 0, 0}, 0);
  std::string bytes = Serialized(map, OctomapFormat::kBinary);
  ASSERT_THAT(bytes, HasSubstr("size 17\n"));
  bytes.replace(bytes.find("size 17"), 7, "size 18");
  EXPECT_THAT(ErrorOf(bytes), HasSubstr("17 nodes; the header says 18"));
}

TEST(OctomapFile, RefusesATreeThatExpandsBeyondTheLimit) {
  const std::string bytes = kHeader + std::string("\x01\x00", 2);  // an eighth of all space
  const auto dut = ParseOctomap("m.bt", bytes);
  EXPECT_EQ(dut.status().code(), absl::StatusCode::kResourceExhausted);
  EXPECT_THAT(std::string(dut.status().message()), HasSubstr("more than 536870912 voxels"));
}

class RealOctomap : public ::testing::TestWithParam<const char*> {};

TEST_P(RealOctomap, HasTheStatesThatOctomapReads) {
  const auto path = DataPath(GetParam());
  if (!path) return;
  const auto dut = ReadOctomap(*path);
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_GT(dut->map.occupied_count(), 100'000);
  octomap::OcTree tree(1.0);  // reads the occupancy of a ColorOcTree's .bt too
  ASSERT_TRUE(tree.readBinary(path->string()));
  EXPECT_EQ(dut->map.grid().resolution_m(), tree.getResolution());
  EXPECT_EQ(StateDifferences(dut->map, tree), 0);
}

INSTANTIATE_TEST_SUITE_P(Files, RealOctomap,
                         ::testing::Values("octomap/geb079.bt", "octomap/fr_079.bt",
                                           "octomap/freiburg1_360.bt"));

TEST(OctomapFile, WritesARealFileAgainByteForByte) {
  const auto path = DataPath("octomap/geb079.bt");
  if (!path) return;
  const auto dut = ReadOctomap(*path);
  ASSERT_TRUE(dut.ok()) << dut.status();
  const auto data_of = [](const std::string& bytes) { return bytes.substr(bytes.find("size")); };
  EXPECT_EQ(data_of(Serialized(dut->map, OctomapFormat::kBinary)), data_of(BytesOf(*path)));
}

TEST(OctomapFile, ARealScanGoesThroughBothFormats) {
  const auto path = DataPath("kitti0000_fov");
  if (!path) return;
  const auto lidar = OpenLidarFolder(*path);
  ASSERT_TRUE(lidar.ok()) << lidar.status();
  ThreadPool pool(1);
  SceneBuilder builder({}, {}, pool);
  ASSERT_TRUE(builder.Apply(*lidar->frames.read(0)).ok());
  const VoxelMap map = builder.Publish()->static_map_W;
  const auto full = ParseOctomap("m.ot", Serialized(map, OctomapFormat::kFull));
  ASSERT_TRUE(full.ok()) << full.status();
  EXPECT_EQ(full->map, map);
  const auto binary =
      ReadByOctomap(Serialized(map, OctomapFormat::kBinary), OctomapFormat::kBinary);
  ASSERT_NE(binary, nullptr);
  EXPECT_EQ(StateDifferences(map, *binary), 0);
}

}  // namespace
}  // namespace clearway
