#include "scene/second_look.h"

#include <gtest/gtest.h>

#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::At;

constexpr double kThen_s = 1;

// One voxel of an object that was a metre along x then, and two by now.
class ForgetFilledTest : public testing::Test {
 protected:
  ForgetFilledTest() {
    VoxelMap map_O(0.1);
    map_O.Set({5, 5, 5}, map_O.model().clamp_max);
    MovingObject object = WithMap({}, map_O);
    object.history = {{At(kThen_s), Pose::Translation(1, 0, 0)},
                      {At(kThen_s + 0.1), Pose::Translation(2, 0, 0)}};
    objects_[1] = std::make_shared<const MovingObject>(object);
  }
  static constexpr VoxelKey kVoxel{15, 5, 5};  // where the object's was then
  Eigen::Vector3f PointIn(VoxelKey voxel) const {
    return static_map_W_.grid().CenterOf(voxel).cast<float>();
  }
  void Hit(VoxelKey voxel, int times) {
    LogOdds value = 0;
    for (int i = 0; i < times; ++i) value = static_map_W_.model().AfterHit(value);
    static_map_W_.Set(voxel, value);
  }
  VoxelState AfterLookAt(VoxelKey voxel, double at_s = kThen_s) {
    ForgetFilled(std::vector{PointIn(voxel)}, At(at_s), objects_, static_map_W_);
    return static_map_W_.State(voxel);
  }

  ObjectMap objects_;
  VoxelMap static_map_W_{0.1};
};

TEST_F(ForgetFilledTest, WhatWasHitOnce) {
  Hit(kVoxel, 1);
  EXPECT_EQ(AfterLookAt(kVoxel), VoxelState::kUnknown);
}

TEST_F(ForgetFilledTest, NotWhatWasHitAgain) {
  Hit(kVoxel, 2);
  EXPECT_EQ(AfterLookAt(kVoxel), VoxelState::kOccupied);
}

TEST_F(ForgetFilledTest, NotWhatIsFreeOrBesideTheObject) {
  static_map_W_.Set(kVoxel, static_map_W_.model().miss);
  EXPECT_EQ(AfterLookAt(kVoxel), VoxelState::kFree);
  constexpr VoxelKey kBeside{17, 5, 5};
  Hit(kBeside, 1);
  EXPECT_EQ(AfterLookAt(kBeside), VoxelState::kOccupied);
}

TEST_F(ForgetFilledTest, NotWhereTheObjectIsNowOrAtATimeThatNobodyKnows) {
  constexpr VoxelKey kNow{25, 5, 5};
  Hit(kNow, 1);
  EXPECT_EQ(AfterLookAt(kNow), VoxelState::kOccupied);
  Hit(kVoxel, 1);
  EXPECT_EQ(AfterLookAt(kVoxel, kThen_s - 0.1), VoxelState::kOccupied);
  EXPECT_EQ(AfterLookAt(kVoxel, kThen_s + 0.05), VoxelState::kOccupied);
}

TEST_F(ForgetFilledTest, BetweenTwoPosesIfAsked) {
  constexpr VoxelKey kBetween{20, 5, 5};
  Hit(kBetween, 1);
  const auto look = [&](double at_s) {
    ForgetFilled(std::vector{PointIn(kBetween)}, At(at_s), objects_, static_map_W_,
                 /*between_poses=*/true);
    return static_map_W_.State(kBetween);
  };
  EXPECT_EQ(look(kThen_s - 0.05), VoxelState::kOccupied);  // before its first pose
  EXPECT_EQ(look(kThen_s + 0.15), VoxelState::kOccupied);  // after its last
  EXPECT_EQ(look(kThen_s + 0.05), VoxelState::kUnknown);
}

TEST_F(ForgetFilledTest, AWorldWithoutObjects) {
  objects_.clear();
  Hit(kVoxel, 1);
  EXPECT_EQ(AfterLookAt(kVoxel), VoxelState::kOccupied);
}

}  // namespace
}  // namespace clearway
