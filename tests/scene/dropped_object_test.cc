// What remains of objects that are not seen for long.
#include <gtest/gtest.h>

#include "clearway/scene/occupancy.h"
#include "clearway/scene/scene_builder.h"
#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::AddObject;
using testing_support::AddPoint;
using testing_support::At;
using testing_support::BoxSurface;
using testing_support::FrameAt;

class DroppedObjectTest : public testing::Test {
 protected:
  DroppedObjectTest() {
    SceneParams params;
    params.object_lifetime = std::chrono::seconds(2);
    Begin(params, {});
  }
  // Object 3 stands before a wall that was seen first, so that the space about it is known free.
  void Begin(const SceneParams& params, std::vector<ObjectMotion> motions) {
    dut_ = std::make_unique<SceneBuilder>(params, FrameLimits{}, pool_);
    Frame wall = FrameAt(0);
    for (double y = -1; y <= 1; y += 0.02) {
      for (double z = -1; z <= 1; z += 0.02) AddPoint(wall, kStaticLabel, {6, y, z});
    }
    EXPECT_TRUE(dut_->Apply(wall).ok());
    Frame object = FrameAt(1);
    AddObject(object, 3, Pose::Translation(3, 0, 0), BoxSurface({0.6, 0.6, 0.6}, 0.05));
    object.motions = std::move(motions);
    EXPECT_TRUE(dut_->Apply(object).ok());
  }
  SpaceStatus StatusAt(const Eigen::Vector3d& p_W) {
    const ScenePtr scene = dut_->Publish();
    return SceneAtTime(*scene, scene->stamp).At(p_W).status;
  }
  ThreadPool pool_{1};
  std::unique_ptr<SceneBuilder> dut_;
};

TEST_F(DroppedObjectTest, IsOccupiedWhileItLives) {
  ASSERT_TRUE(dut_->Apply(FrameAt(3)).ok());
  EXPECT_EQ(StatusAt({3, 0, 0}), SpaceStatus::kOccupied);
}

TEST_F(DroppedObjectTest, ItsSolidIsUnknownAfterwards) {
  const auto report = dut_->Apply(FrameAt(3.1));
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->objects_dropped, 1u);
  EXPECT_EQ(dut_->Publish()->FindObject(3), nullptr);
  for (double x = 2.72; x < 3.29; x += 0.05) {
    EXPECT_EQ(StatusAt({x, 0.01, 0.02}), SpaceStatus::kUnknownSpace) << x;
  }
  EXPECT_EQ(StatusAt({2, 0, 0}), SpaceStatus::kFree);
}

TEST_F(DroppedObjectTest, NewRaysFreeItAgain) {
  Frame wall = FrameAt(3.1);
  AddPoint(wall, kStaticLabel, {6, 0.001, 0.001});
  ASSERT_TRUE(dut_->Apply(wall).ok());
  EXPECT_EQ(StatusAt({3, 0.001, 0.001}), SpaceStatus::kFree);
}

TEST_F(DroppedObjectTest, SoIsTheSolidOfOneThatBeginsAnew) {
  SceneParams params;
  params.horizon = std::chrono::milliseconds(200);
  Begin(params, {{3, Pose::Translation(0, 0.1, 0), At(0.9)}});
  Frame back = FrameAt(2);
  AddPoint(back, 3, {0, 4, 0});
  const auto report = dut_->Apply(back);
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->objects_dropped, 1u);
  EXPECT_EQ(report->objects_created, 1u);
  EXPECT_EQ(StatusAt({3, 0.01, 0.02}), SpaceStatus::kUnknownSpace);
}

TEST_F(DroppedObjectTest, ComesBackUnderItsIdAsANewObject) {
  Frame back = FrameAt(10);
  AddPoint(back, 3, {2, 0, 0});
  const auto report = dut_->Apply(back);
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->objects_created, 1u);
  EXPECT_EQ(dut_->Publish()->FindObject(3)->first_seen, At(10));
}

}  // namespace
}  // namespace clearway
