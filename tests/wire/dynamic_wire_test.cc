#include "wire/dynamic_wire.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "clearway/scene/scene_delta.h"
#include "support/random.h"
#include "wire/delta_wire.h"

namespace clearway {
namespace {

using v1::SceneDeltaPart;

// So many voxels in a row, all of them occupied for a while only.
SceneSnapshot SceneOf(int voxels) {
  SceneSnapshot scene = SceneSnapshot::Empty(SceneParams{});
  scene.version = 3;
  scene.stamp = TimeFromNanoseconds(5'000'000'000);
  testing_support::Random random(1);
  std::vector<DynamicVoxel> dynamic;
  for (int i = 0; i < voxels; i += kVoxelsPerBlock) {
    const BlockKey key{i / kVoxelsPerBlock - 7, 0, 0};
    VoxelBlock block;
    for (int v = 0; v < std::min(voxels - i, kVoxelsPerBlock); ++v) {
      block.Set(v, 1000, scene.static_map_W.model());
      const Time last_hit = scene.stamp - Duration(random.Integer(0, 400'000'000));
      const Time first_hit = last_hit - Duration(random.Integer(0, 2'000'000'000));
      dynamic.push_back({VoxelAt(key, v), first_hit, last_hit});
    }
    scene.static_map_W.PutBlock(key, block);
  }
  scene.dynamic_W = DynamicSpace(dynamic);
  return scene;
}

std::vector<SceneDeltaPart> PartsOf(const SceneDifference& difference) {
  std::vector<SceneDeltaPart> parts;
  EXPECT_TRUE(WriteDifference(difference, [&](const SceneDeltaPart& part) {
    EXPECT_LT(part.ByteSizeLong(), std::size_t{4} << 20);  // gRPC's default limit
    parts.push_back(part);
    return true;
  }));
  return parts;
}

absl::StatusOr<SceneDelta> Assemble(const std::vector<SceneDeltaPart>& parts) {
  DeltaAssembler assembler;
  for (const SceneDeltaPart& part : parts) {
    auto delta = assembler.Add(part);
    if (!delta.ok()) return delta.status();
    if (delta->has_value()) return **std::move(delta);
  }
  return absl::InternalError("no last part");
}

TEST(DynamicWire, ComesTogetherAgain) {
  for (const int voxels : {0, 1, 700, 400'000}) {
    const SceneSnapshot scene = SceneOf(voxels);
    const auto dut = Assemble(PartsOf(SceneDifference(nullptr, scene)));
    ASSERT_TRUE(dut.ok()) << dut.status();
    const auto applied = Apply(nullptr, *dut);
    ASSERT_TRUE(applied.ok()) << applied.status();
    EXPECT_TRUE(SameContent(*applied, scene)) << voxels;
  }
}

TEST(DynamicWire, GoesAway) {
  const SceneSnapshot before = SceneOf(700);
  SceneSnapshot after = before;
  after.version = 4;
  after.dynamic_W = {};
  const auto dut = Assemble(PartsOf(SceneDifference(&before, after)));
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_TRUE(SameContent(*Apply(&before, *dut), after));
}

TEST(DynamicWire, StaysWhereNothingDiffers) {
  const SceneSnapshot before = SceneOf(700);
  SceneSnapshot after = before;
  after.version = 4;
  const auto parts = PartsOf(SceneDifference(&before, after));
  EXPECT_EQ(parts.at(0).dynamic_size(), 0);
  EXPECT_TRUE(SameContent(*Apply(&before, *Assemble(parts)), after));
}

TEST(DynamicWire, RefusesWhatIsDamaged) {
  const auto parts = PartsOf(SceneDifference(nullptr, SceneOf(5)));
  const auto refused = [&](auto&& spoil) {
    auto spoilt = parts;
    spoil(spoilt[0]);
    return std::string(Assemble(spoilt).status().message());
  };
  EXPECT_THAT(refused([](auto& part) { part.mutable_dynamic(0)->add_keys(3); }),
              testing::HasSubstr("dynamic: has arrays of different lengths"));
  EXPECT_THAT(refused([](auto& part) { part.mutable_dynamic(0)->add_first_hit_ago_ns(3); }),
              testing::HasSubstr("dynamic: has arrays of different lengths"));
  EXPECT_THAT(refused([](auto& part) {
                part.mutable_dynamic(0)->set_first_hit_ago_ns(2, std::uint64_t{1} << 63);
              }),
              testing::HasSubstr("dynamic.first_hit_ago_ns: is too long"));
  EXPECT_THAT(refused([](auto& part) { part.set_dynamic_changed(false); }),
              testing::HasSubstr("dynamic: is said not to differ"));
}

}  // namespace
}  // namespace clearway
