#include "wire/delta_wire.h"

#include <gtest/gtest.h>

#include "clearway/geometry/hull.h"
#include "clearway/scene/scene_builder.h"
#include "support/frames.h"
#include "support/random_given.h"
#include "wire/block_codec.h"
#include "wire/status.h"

namespace clearway {
namespace {

using testing_support::RandomFrames;

std::vector<v1::SceneDeltaPart> PartsOf(const SceneDifference& difference) {
  std::vector<v1::SceneDeltaPart> parts;
  EXPECT_TRUE(WriteDifference(difference, [&](const v1::SceneDeltaPart& part) {
    v1::SceneDeltaPart parsed;
    EXPECT_TRUE(parsed.ParseFromString(part.SerializeAsString()));
    EXPECT_LT(part.ByteSizeLong(), std::size_t{4} << 20);  // gRPC's default limit
    parts.push_back(std::move(parsed));
    return true;
  }));
  return parts;
}

absl::StatusOr<SceneDelta> Assemble(const std::vector<v1::SceneDeltaPart>& parts) {
  DeltaAssembler dut;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    auto delta = dut.Add(parts[i]);
    if (!delta.ok()) return delta.status();
    EXPECT_EQ(delta->has_value(), i + 1 == parts.size());
    if (delta->has_value()) return **std::move(delta);
  }
  return absl::InternalError("no last part");
}

// Versions of a scene that random frames make.
std::vector<ScenePtr> Scenes(int count, unsigned seed) {
  ThreadPool pool(1);
  SceneParams params;
  params.resolution_m = params.object_resolution_m = 0.2;
  params.solid = SolidMode::kCompletedHull;
  SceneBuilder builder(params, FrameLimits{}, pool);
  std::vector<ScenePtr> scenes = {builder.Publish()};
  RandomFrames frames(seed);
  testing_support::Random given(seed);
  while (static_cast<int>(scenes.size()) < count) {
    EXPECT_TRUE(builder.Apply(frames.Next()).ok());
    testing_support::ChangeGivenRandomly(builder, given);
    scenes.push_back(builder.Publish());
  }
  return scenes;
}

// A map of many random blocks: more than one part.
SceneSnapshot WideScene() {
  SceneSnapshot scene = SceneSnapshot::Empty(SceneParams{});
  scene.version = 3;
  testing_support::Random random(3);
  for (int i = 0; i < 5000; ++i) {
    VoxelBlock block;
    for (int v = 0; v < kVoxelsPerBlock; ++v) {
      block.Set(v, static_cast<LogOdds>(random.Integer(-8000, 14000)), scene.static_map_W.model());
    }
    scene.static_map_W.PutBlock({i % 100, i / 100, 0}, block);
  }
  return scene;
}

TEST(DeltaWire, Empty) {
  const SceneSnapshot empty = SceneSnapshot::Empty(SceneParams{});
  const auto dut = Assemble(PartsOf(SceneDifference(nullptr, empty)));
  ASSERT_TRUE(dut.ok()) << dut.status();
  const auto scene = Apply(nullptr, *dut);
  ASSERT_TRUE(scene.ok()) << scene.status();
  EXPECT_EQ(scene->Hash(), empty.Hash());
}

TEST(DeltaWire, AnyTwoVersionsComeTogetherAgain) {
  const std::vector<ScenePtr> scenes = Scenes(30, 11);
  for (std::size_t from = 0; from < scenes.size(); from += 3) {
    for (std::size_t to = from; to < scenes.size(); to += 4) {
      const auto dut = Assemble(PartsOf(SceneDifference(scenes[from].get(), *scenes[to])));
      ASSERT_TRUE(dut.ok()) << dut.status();
      const auto scene = Apply(scenes[from].get(), *dut);
      ASSERT_TRUE(scene.ok()) << scene.status();
      EXPECT_EQ(scene->version, scenes[to]->version);
      EXPECT_EQ(scene->Hash(), scenes[to]->Hash()) << from << " to " << to;
    }
  }
}

TEST(DeltaWire, ALargeSceneComesInPartsBelowTheMessageLimit) {
  const SceneSnapshot wide = WideScene();
  const auto parts = PartsOf(SceneDifference(nullptr, wide));
  EXPECT_GT(parts.size(), 1u);
  const auto dut = Assemble(parts);
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(Apply(nullptr, *dut)->Hash(), wide.Hash());
}

TEST(DeltaWire, StopsWhenNobodyTakesTheParts) {
  const SceneSnapshot wide = WideScene();
  int sent = 0;
  EXPECT_FALSE(
      WriteDifference(SceneDifference(nullptr, wide), [&](const auto&) { return ++sent < 2; }));
  EXPECT_EQ(sent, 2);
}

TEST(DeltaWire, RefusesPartsOutOfTurn) {
  auto parts = PartsOf(SceneDifference(nullptr, WideScene()));
  parts.erase(parts.begin() + 1);
  EXPECT_TRUE(absl::IsFailedPrecondition(Assemble(parts).status()));
}

TEST(DeltaWire, RefusesADeltaThatBeginsInTheMiddle) {
  auto parts = PartsOf(SceneDifference(nullptr, WideScene()));
  parts.erase(parts.begin());
  EXPECT_TRUE(absl::IsFailedPrecondition(Assemble(parts).status()));
}

TEST(DeltaWire, RefusesVoxelsOfAnObjectThatWasNotSent) {
  auto parts = PartsOf(SceneDifference(nullptr, *Scenes(10, 3).back()));
  parts[0].mutable_maps(0)->set_object_id(4711);
  const absl::Status status = Assemble(parts).status();
  EXPECT_TRUE(absl::IsInvalidArgument(status));
  EXPECT_EQ(FieldOf(status), "maps[0].object_id");
}

TEST(DeltaWire, RefusesDamagedVoxels) {
  const auto parts = PartsOf(SceneDifference(nullptr, *Scenes(10, 3).back()));
  const std::string good = parts[0].maps(0).zstd_block_deltas();
  for (std::size_t size = 0; size < good.size(); size += 7) {
    auto cut = parts;
    cut[0].mutable_maps(0)->set_zstd_block_deltas(good.substr(0, size));
    const absl::Status status = Assemble(cut).status();
    ASSERT_TRUE(absl::IsInvalidArgument(status)) << size;
    ASSERT_EQ(FieldOf(status), "maps[0].zstd_block_deltas");
  }
}

TEST(BlockCodec, Empty) {
  const auto dut = DecompressBlocks("x", CompressBlocks({}), 1, 100);
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_TRUE(dut->empty());
}

TEST(BlockCodec, TakesNoMemoryForWhatIsTooLarge) {
  const MapDelta blocks(100);
  const std::string bytes = CompressBlocks(blocks);
  EXPECT_TRUE(DecompressBlocks("x", bytes, 100, 1 << 20).ok());
  EXPECT_TRUE(absl::IsInvalidArgument(DecompressBlocks("x", bytes, 99, 1 << 20).status()));
  EXPECT_TRUE(absl::IsInvalidArgument(DecompressBlocks("x", bytes, 100, 1000).status()));
}

TEST(BlockCodec, RefusesMasksThatDisagreeWithTheValues) {
  MapDelta blocks(1);
  blocks[0].changed.Set(3);
  blocks[0].observed.Set(3);
  EXPECT_FALSE(DecompressBlocks("x", CompressBlocks(blocks), 10, 1000).ok());  // too few
  blocks[0].log_odds = {1, 2};
  EXPECT_FALSE(DecompressBlocks("x", CompressBlocks(blocks), 10, 1000).ok());  // too many
  blocks[0].log_odds = {1};
  EXPECT_TRUE(DecompressBlocks("x", CompressBlocks(blocks), 10, 1000).ok());
}

TEST(DeltaWire, GivenShapesAndFuturesSurvive) {
  ThreadPool pool(1);
  SceneBuilder builder({}, {}, pool);
  const auto mesh = std::make_shared<const Mesh>(HullAround(Cylinder{0.3, 1}));
  const std::vector<Shape> shapes{Sphere{1},          Box{{1, 2, 3}},       Capsule{0.2, 1},
                                  Cylinder{0.3, 1.8}, ConvexPolytope{mesh}, TriangleMesh{mesh}};
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    GivenObject given{static_cast<ObjectId>(i + 1), shapes[i], {Time{}, Pose{}}, {}, {}};
    given.future = {{Time{} + FromSeconds(1), Pose::Translation(1, 2, 3)}};
    ASSERT_TRUE(builder.AddObject(given).ok());
  }
  const ScenePtr scene = builder.Publish();
  const auto delta = Assemble(PartsOf(SceneDifference(nullptr, *scene)));
  ASSERT_TRUE(delta.ok()) << delta.status();
  const auto applied = Apply(nullptr, *delta);
  ASSERT_TRUE(applied.ok()) << applied.status();
  EXPECT_EQ(applied->Hash(), scene->Hash());
  EXPECT_TRUE(SameContent(*applied, *scene));
}

TEST(DeltaWire, BadFuturesAndShapesAreNamed) {
  v1::SceneDeltaPart part;
  v1::ObjectDelta* object = part.add_objects();
  object->set_object_id(1);
  object->mutable_given_shape();
  DeltaAssembler no_shape;
  EXPECT_EQ(FieldOf(no_shape.Add(part).status()), "objects[0].given_shape.shape");
  object->clear_given_shape();
  object->mutable_future()->add_stamps_ns(1);
  DeltaAssembler no_pose;
  EXPECT_EQ(FieldOf(no_pose.Add(part).status()),
            "objects[0].future.world_from_object.rotations_xyzw");
}

}  // namespace
}  // namespace clearway
