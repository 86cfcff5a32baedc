#include "clearway/io/octomap_file.h"

#include <octomap/ColorOcTree.h>

#include "clearway/io/lidar_folder.h"
#include "clearway/scene/scene_builder.h"
#include "io/octomap_example.h"
#include "support/data_folder.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

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

TEST(OctomapFile, HeadersAreReadByWordsAsOctomapDoes) {
  const std::string whole = Serialized(ExampleMap(), OctomapFormat::kBinary);
  const std::size_t res = whole.find("res 0.1\n"), data = whole.find("data\n");
  const auto with = [&](std::size_t at, std::size_t size, const std::string& text) {
    return std::string(whole).replace(at, size, text);
  };
  const struct {
    std::string bytes;
    std::vector<std::string> unknown_keys;
  } cases[] = {{with(res, 4, "res\t"), {}},
               {with(res, 0, "   "), {}},
               {with(res, 4, "res\n\n  "), {}},
               {with(data, 0, "frame_id map\n"), {"frame_id"}},
               {with(data, 0, "# data of a robot\nframe_id data\nowner\n"), {"frame_id", "owner"}}};
  const auto plain = ParseOctomap("m.bt", whole);
  ASSERT_TRUE(plain.ok()) << plain.status();
  for (const auto& [bytes, unknown_keys] : cases) {
    const std::string header = bytes.substr(0, bytes.find("data\n"));
    const auto dut = ParseOctomap("m.bt", bytes);
    ASSERT_TRUE(dut.ok()) << dut.status() << header;
    EXPECT_EQ(dut->map, plain->map) << header;
    EXPECT_EQ(dut->unknown_keys, unknown_keys) << header;
    const auto tree = ReadByOctomap(bytes, OctomapFormat::kBinary);
    ASSERT_NE(tree, nullptr) << header;
    EXPECT_EQ(StateDifferences(dut->map, *tree), 0) << header;
  }
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

// Blocks of one value are written as leaves; byte for byte what OctoMap prunes single voxels to.
TEST(OctomapFile, LargeLeavesAreThoseThatOctomapPrunesTo) {
  VoxelMap map(0.1);
  VoxelBlock full, mixed;
  for (int i = 0; i < kVoxelsPerBlock; ++i) full.Set(i, map.model().clamp_min, map.model());
  for (int i = 0; i < 8; ++i) map.PutBlock({i % 2, i / 2 % 2, i / 4}, full);
  map.PutBlock({-3, 5, 0}, full);
  mixed = full;
  mixed.Set(77, map.model().clamp_max, map.model());
  map.PutBlock({-1, 0, 0}, mixed);
  mixed = full;
  mixed.Forget(5);
  map.PutBlock({-1, -1, 0}, mixed);
  octomap::OcTree tree(0.1);
  tree.setClampingThresMin(1e-4);
  tree.setClampingThresMax(1 - 1e-4);
  map.blocks().ForEach([&](BlockKey key, const VoxelBlock& block) {
    block.observed.ForEach([&](int index) {
      tree.setNodeValue(KeyFor(VoxelAt(key, index)),
                        static_cast<float>(Dequantized(block.log_odds[index])), true);
    });
  });
  tree.updateInnerOccupancy();
  tree.prune();
  std::ostringstream binary, whole;
  tree.writeBinaryData(binary);
  tree.writeData(whole);
  EXPECT_TRUE(Serialized(map, OctomapFormat::kBinary).ends_with("data\n" + binary.str()));
  EXPECT_TRUE(Serialized(map, OctomapFormat::kFull).ends_with("data\n" + whole.str()));
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

class RealOctomap : public ::testing::TestWithParam<const char*> {};

TEST_P(RealOctomap, HasTheStatesThatOctomapReads) {
  const auto path = DataPath(GetParam());
  if (!path) GTEST_SKIP() << "no recorded data";
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
  if (!path) GTEST_SKIP() << "no recorded data";
  const auto dut = ReadOctomap(*path);
  ASSERT_TRUE(dut.ok()) << dut.status();
  const auto data_of = [](const std::string& bytes) { return bytes.substr(bytes.find("size")); };
  EXPECT_EQ(data_of(Serialized(dut->map, OctomapFormat::kBinary)), data_of(BytesOf(*path)));
}

TEST(OctomapFile, ARealScanGoesThroughBothFormats) {
  const auto path = DataPath("kitti0000_fov");
  if (!path) GTEST_SKIP() << "no recorded data";
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
