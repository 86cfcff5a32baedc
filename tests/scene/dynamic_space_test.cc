// Movers that nobody labelled, through the scene that makes dynamic space of them.
#include "clearway/scene/dynamic_space.h"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "clearway/scene/occupancy.h"
#include "clearway/scene/scene_builder.h"
#include "clearway/scene/scene_delta.h"
#include "support/wall_scans.h"

namespace clearway {
namespace {

using testing_support::AddPoint;
using testing_support::FrameAt;
using testing_support::kWall_m;
using testing_support::Panel;
using testing_support::Random;
using testing_support::ScanOfWall;

constexpr double kPeriod_s = 0.1;

class DynamicSpaceOfScene : public testing::Test {
 protected:
  DynamicSpaceOfScene() { params_.dynamic_life = std::chrono::milliseconds(450); }
  void SetUp() override { dut_.emplace(params_, FrameLimits{}, pool_); }

  void Apply(const Frame& frame) {
    const auto report = dut_->Apply(frame);
    ASSERT_TRUE(report.ok()) << report.status();
    report_ = *report;
    scene_ = dut_->Publish();
  }
  // Scans until a second has gone by: what they pass is known free.
  void KnowFree() {
    while (next_s_ < 1 - 1e-9) Look();
  }
  void Look(std::optional<Panel> panel = std::nullopt) {
    Apply(ScanOfWall(next_s_, panel));
    next_s_ += kPeriod_s;
  }
  PointOccupancy There(const Eigen::Vector3d& p_W) const {
    return SceneAtTime(*scene_, scene_->stamp).At(p_W);
  }
  VoxelState Lasting(const Eigen::Vector3d& p_W) const {
    const VoxelMap map = scene_->LastingMap();
    return map.State(map.grid().KeyOf(p_W));
  }
  std::size_t Count() const { return scene_->dynamic_W.voxels().size(); }

  ThreadPool pool_{2};
  SceneParams params_;
  std::optional<SceneBuilder> dut_;
  FrameReport report_;
  ScenePtr scene_;
  double next_s_ = 0;
};

TEST_F(DynamicSpaceOfScene, WhatLongWasFreeIsOccupiedAtOnce) {
  KnowFree();
  EXPECT_EQ(Count(), 0u);
  const Panel panel{5, 0};
  Look(panel);
  EXPECT_EQ(There(panel.Middle()).status, SpaceStatus::kOccupied);
  EXPECT_TRUE(There(panel.Middle()).dynamic);
  EXPECT_EQ(There(panel.Middle()).object, kStaticLabel);
  EXPECT_EQ(Lasting(panel.Middle()), VoxelState::kFree);
  EXPECT_GE(Count(), 36u);
  EXPECT_EQ(report_.voxels_dynamic, Count());
  const Eigen::Vector3d wall(kWall_m + 0.05, 1.5, 0.5);
  EXPECT_EQ(There(wall).status, SpaceStatus::kOccupied);
  EXPECT_FALSE(There(wall).dynamic);
}

TEST_F(DynamicSpaceOfScene, WithoutItTheMapIsLateAndRemembers) {
  params_.dynamic_life = Duration::zero();
  SetUp();
  KnowFree();
  const Panel panel{5, 0};
  Look(panel);
  EXPECT_EQ(There(panel.Middle()).status, SpaceStatus::kFree);
  for (int i = 0; i < 5; ++i) Look(panel);
  EXPECT_EQ(There(panel.Middle()).status, SpaceStatus::kOccupied);
  Look();
  EXPECT_EQ(There(panel.Middle()).status, SpaceStatus::kOccupied);
}

TEST_F(DynamicSpaceOfScene, IsFreeAsSoonAsARayPasses) {
  KnowFree();
  for (int i = 0; i < 10; ++i) Look(Panel{5, 0});
  Look();
  EXPECT_EQ(There(Panel{5, 0}.Middle()).status, SpaceStatus::kFree);
  EXPECT_EQ(Count(), 0u);
}

TEST_F(DynamicSpaceOfScene, LeavesNoTrail) {
  KnowFree();
  for (double y_m = -1.2; y_m < 1.2; y_m += 0.15) Look(Panel{5, y_m});
  Look();
  const VoxelMap& map = scene_->static_map_W;
  map.blocks().ForEach([&](BlockKey key, const VoxelBlock& block) {
    block.occupied.ForEach(
        [&](int index) { EXPECT_GT(map.grid().CenterOf(VoxelAt(key, index)).x(), kWall_m); });
  });
}

// It is behind something, or the sensor looks elsewhere.
TEST_F(DynamicSpaceOfScene, IsUnknownWhenNotSeenForItsLife) {
  KnowFree();
  const Panel panel{5, 0};
  Look(panel);
  const std::size_t count = Count();
  for (int i = 0; i < 4; ++i) {
    Look(Panel{2, 0, 0.5});
    EXPECT_EQ(There(panel.Middle()).status, SpaceStatus::kOccupied) << i;
    EXPECT_GE(Count(), count);
  }
  Look(Panel{2, 0, 0.5});
  EXPECT_EQ(There(panel.Middle()).status, SpaceStatus::kUnknownSpace);
  EXPECT_EQ(Lasting(panel.Middle()), VoxelState::kUnknown);
}

TEST_F(DynamicSpaceOfScene, IsStaticOnceItHasStayed) {
  params_.dynamic_settle = std::chrono::seconds(1);
  SetUp();
  KnowFree();
  const Panel panel{5, 0};
  for (int i = 0; i < 10; ++i) Look(panel);
  EXPECT_GT(Count(), 0u);
  Look(panel);
  EXPECT_EQ(Count(), 0u);
  EXPECT_EQ(There(panel.Middle()).status, SpaceStatus::kOccupied);
  EXPECT_EQ(Lasting(panel.Middle()), VoxelState::kOccupied);
  Look(Panel{2, 0, 0.5});
  next_s_ += 5;
  Look(Panel{2, 0, 0.5});
  EXPECT_EQ(There(panel.Middle()).status, SpaceStatus::kOccupied);
}

// What is dynamic needs no company to stay so, and its own settled parts do not end it.
TEST_F(DynamicSpaceOfScene, LastsAsLongAsItIsHit) {
  KnowFree();
  for (int i = 0; i < 10; ++i) Look(Panel{5, 0, 0.15});
  std::vector<VoxelKey> late;
  for (int i = 0; i < 30; ++i) {
    Look(Panel{5, 0});
    for (const DynamicVoxel& voxel : scene_->dynamic_W.voxels()) {
      if (i == 0) late.push_back(voxel.key);
    }
    for (const VoxelKey key : late) {
      ASSERT_EQ(scene_->static_map_W.State(key), VoxelState::kOccupied) << i;
    }
  }
  EXPECT_GT(late.size(), 20u);
  EXPECT_EQ(Count(), 0u);
}

TEST_F(DynamicSpaceOfScene, LastsWhereASingleRayHitsIt) {
  KnowFree();
  Look(Panel{5, 0});
  for (int i = 0; i < 12; ++i) {
    Frame frame = FrameAt(next_s_);
    AddPoint(frame, kStaticLabel, Panel{5, 0}.Middle());
    Apply(frame);
    next_s_ += kPeriod_s;
    EXPECT_TRUE(There(Panel{5, 0}.Middle()).dynamic) << i;
  }
  EXPECT_EQ(Count(), 1u);
}

// Two things that pass the same place are not one that stays.
TEST_F(DynamicSpaceOfScene, IsNotStaticForBeingHitTwice) {
  params_.dynamic_life = std::chrono::seconds(5);
  SetUp();
  KnowFree();
  const Panel panel{5, 0};
  Look(panel);
  for (int i = 0; i < 25; ++i) Look(Panel{2, 0, 0.5});
  Look(panel);
  EXPECT_TRUE(There(panel.Middle()).dynamic);
  EXPECT_EQ(Lasting(panel.Middle()), VoxelState::kFree);
}

TEST_F(DynamicSpaceOfScene, GivesWayToAPriorMap) {
  for (const int more : {0, 1}) {
    SetUp();
    next_s_ = 0;
    KnowFree();
    const Panel panel{5, 0};
    Look(panel);
    VoxelMap prior(params_.resolution_m, params_.Model());
    const auto value = static_cast<LogOdds>(prior.model().AfterHit(prior.model().occupied) + more);
    prior.Set(prior.grid().KeyOf(panel.Middle()), value);
    ASSERT_TRUE(dut_->LoadPrior(prior).ok());
    scene_ = dut_->Publish();
    EXPECT_FALSE(There(panel.Middle()).dynamic);
    EXPECT_EQ(Lasting(panel.Middle()), VoxelState::kOccupied);
    EXPECT_GT(Count(), 0u);
  }
}

TEST_F(DynamicSpaceOfScene, NeedsMoreThanAHitOrTwo) {
  KnowFree();
  Frame frame = FrameAt(next_s_);
  AddPoint(frame, kStaticLabel, {5.05, 0.05, 0.05});
  AddPoint(frame, kStaticLabel, {5.05, 0.15, 0.05});
  AddPoint(frame, kStaticLabel, {7.05, 0.05, 0.05});
  Apply(frame);
  EXPECT_EQ(Count(), 0u);
}

// There hits come of noise.
TEST_F(DynamicSpaceOfScene, IsNotNextToSurfaces) {
  KnowFree();
  Look(Panel{kWall_m - 0.2, 0});
  EXPECT_EQ(Count(), 0u);
  Look(Panel{kWall_m - 0.3, 0});
  EXPECT_GT(Count(), 0u);
}

TEST_F(DynamicSpaceOfScene, IsNotWhereNobodyKnewWhatIs) {
  Look(Panel{5, 0});
  Look(Panel{5, 0});
  EXPECT_EQ(Count(), 0u);
  EXPECT_EQ(There(Panel{5, 0}.Middle()).status, SpaceStatus::kOccupied);
}

TEST_F(DynamicSpaceOfScene, GoesWithWhatTheMapForgets) {
  KnowFree();
  Look(Panel{5, 0});
  const std::size_t all = Count();
  dut_->ClearRegion({{0, 0, -5}, {20, 5, 5}});
  scene_ = dut_->Publish();
  EXPECT_GT(Count(), 0u);
  EXPECT_LT(Count(), all);
  dut_->Reset();
  EXPECT_TRUE(dut_->Publish()->dynamic_W.voxels().empty());
}

TEST_F(DynamicSpaceOfScene, RollsWithTheWindow) {
  params_.keep_distance_m = 4;
  SetUp();
  KnowFree();
  Look(Panel{3, 0});
  ASSERT_GT(Count(), 0u);
  Frame frame = FrameAt(next_s_);
  frame.T_W_S = Pose::Translation(0, 50, 0);
  AddPoint(frame, kStaticLabel, {3, 0, 0});
  Apply(frame);
  EXPECT_EQ(Count(), 0u);
  EXPECT_EQ(report_.voxels_dynamic, 0u);
}

// Where an object was that is dropped, nobody knows what is, dynamic space or not.
TEST_F(DynamicSpaceOfScene, GoesWithADroppedObject) {
  params_.dynamic_life = std::chrono::seconds(5);
  params_.object_lifetime = std::chrono::seconds(1);
  SetUp();
  KnowFree();
  const Panel panel{5, 0}, nearer{2, 0, 0.5};
  Look(panel);
  Frame labelled = ScanOfWall(next_s_, panel);
  for (std::size_t i = 0; i < labelled.labels.size(); ++i) {
    if (labelled.points_S[i].x() < 9) labelled.labels[i] = 7;
  }
  Apply(labelled);
  next_s_ += kPeriod_s;
  for (int i = 0; i < 9; ++i) Look(nearer);
  ASSERT_EQ(scene_->objects.size(), 1u);
  ASSERT_TRUE(There(panel.Middle()).dynamic);
  for (int i = 0; i < 3; ++i) Look(nearer);
  EXPECT_TRUE(scene_->objects.empty());
  EXPECT_FALSE(There(panel.Middle()).dynamic);
  EXPECT_EQ(Lasting(panel.Middle()), VoxelState::kUnknown);
}

// As in the docs: the map without the mover, but where it hid something.
TEST_F(DynamicSpaceOfScene, TheLastingMapIsAsIfNothingWasThere) {
  KnowFree();
  const VoxelMap before = scene_->static_map_W;
  for (double y_m = -1.2; y_m < 0; y_m += 0.15) Look(Panel{5, y_m});
  const VoxelMap lasting = scene_->LastingMap();
  lasting.blocks().ForEach([&](BlockKey key, const VoxelBlock& block) {
    block.observed.ForEach(
        [&](int index) { EXPECT_EQ(block.State(index), before.State(VoxelAt(key, index))); });
  });
}

TEST_F(DynamicSpaceOfScene, IsInDifferencesAndHashes) {
  KnowFree();
  const ScenePtr before = scene_;
  Look(Panel{5, 0});
  const ScenePtr with = scene_;
  Look(Panel{5, 0.2});
  for (const auto& [from, to] : {std::pair(before, with), {with, scene_}, {scene_, before}}) {
    const SceneDelta delta = Diff(from.get(), *to);
    EXPECT_TRUE(delta.dynamic_W);
    const auto applied = clearway::Apply(from.get(), delta);
    ASSERT_TRUE(applied.ok()) << applied.status();
    EXPECT_TRUE(SameContent(*applied, *to));
    EXPECT_EQ(applied->Hash(), to->Hash());
  }
  EXPECT_FALSE(Diff(scene_.get(), *scene_).dynamic_W);
  SceneSnapshot other = *with;
  other.dynamic_W = {};
  EXPECT_FALSE(SameContent(other, *with));
  EXPECT_NE(other.Hash(), with->Hash());
}

TEST_F(DynamicSpaceOfScene, DifferencesThatAreWrongAreRefused) {
  KnowFree();
  Look(Panel{5, 0});
  const std::span<const DynamicVoxel> right = scene_->dynamic_W.voxels();
  const auto refused = [&](const std::function<void(std::vector<DynamicVoxel>&)>& spoil,
                           const std::string& what) {
    std::vector<DynamicVoxel> voxels(right.begin(), right.end());
    spoil(voxels);
    SceneDelta delta = Diff(nullptr, *scene_);
    delta.dynamic_W = DynamicSpace(voxels);
    const auto applied = clearway::Apply(nullptr, delta);
    ASSERT_FALSE(applied.ok()) << what;
    EXPECT_NE(applied.status().message().find(what), std::string::npos) << applied.status();
  };
  refused([](auto& v) { std::swap(v[0], v[1]); }, "dynamic[1]: out of order");
  refused([](auto& v) { v[1] = v[0]; }, "dynamic[1]: out of order");
  refused([](auto& v) { v[0].key = {-200, -200, -200}; }, "dynamic[0]: is not occupied");
  refused([](auto& v) { v[0].key.x = -(1 << 21); }, "dynamic[0]: address out of range");
  refused([](auto& v) { v[2].first_hit += Duration(1); }, "dynamic[2]: was last hit before");
}

// Whatever comes: dynamic space is occupied, and the differences of versions tell it.
TEST_F(DynamicSpaceOfScene, IsOccupiedAndToldWhateverComes) {
  std::size_t all = 0;
  for (const unsigned seed : {1u, 2u, 3u}) {
    SetUp();
    Random random(seed);
    next_s_ = 0;
    KnowFree();
    ScenePtr before = dut_->Publish();
    for (int k = 0; k < 60; ++k) {
      if (random.Integer(0, 9) == 0) next_s_ += random.Uniform(0, 1);
      if (random.Integer(0, 9) == 0) {
        const Eigen::Vector3d corner(5, random.Uniform(-2, 2), -2);
        dut_->ClearRegion({corner, corner + Eigen::Vector3d(3, 0.5, 4)});
      }
      const bool shown = random.Integer(0, 3) > 0;
      const Panel panel{random.Uniform(4, 6), random.Uniform(-1, 1), random.Uniform(0.1, 0.5)};
      Look(shown ? std::optional(panel) : std::nullopt);
      for (const DynamicVoxel& voxel : scene_->dynamic_W.voxels()) {
        EXPECT_EQ(scene_->static_map_W.State(voxel.key), VoxelState::kOccupied);
        EXPECT_EQ(scene_->dynamic_W.Find(voxel.key), &voxel);
        EXPECT_LE(voxel.first_hit, voxel.last_hit);
        EXPECT_LE(scene_->stamp - voxel.last_hit, params_.dynamic_life);
      }
      const auto applied = clearway::Apply(before.get(), Diff(before.get(), *scene_));
      ASSERT_TRUE(applied.ok()) << applied.status();
      EXPECT_TRUE(SameContent(*applied, *scene_));
      before = scene_;
      all += Count();
    }
  }
  EXPECT_GT(all, 1000u);
}

}  // namespace
}  // namespace clearway
