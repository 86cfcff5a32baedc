// Motions of objects that go by several ids.
#include <gtest/gtest.h>

#include "scene/other_ids_scene.h"

namespace clearway {
namespace {

using testing_support::At;
using testing_support::FrameAt;

// The tracker has the newest id, the segmentation still the first one.
TEST_F(OtherIds, AMotionUnderAnyOfThemCounts) {
  for (const auto& [labelled, moved] : {std::pair<ObjectId, ObjectId>{5, 9}, {9, 5}}) {
    dut_.emplace(params_, FrameLimits{}, pool_);
    LoseAndSeeAgain();
    Frame frame = FrameAt(4.5);
    See(frame, labelled, 4.5, false);
    frame.motions.front().id = moved;
    Apply(frame);
    ASSERT_EQ(scene().objects.size(), 1u);
    EXPECT_FALSE(scene().objects[0]->bridged);
    EXPECT_EQ(scene().objects[0]->t_k(), At(4.5));
    EXPECT_EQ(scene().objects[0]->placed_at, At(4.5));
  }
}

TEST_F(OtherIds, OfTwoMotionsThatOfTheSeenIdCounts) {
  LoseAndSeeAgain();
  const Eigen::Vector3d before_W = scene().objects[0]->history.back().T_W_O.translation;
  Frame frame = FrameAt(4.5);
  See(frame, 5, 4.5, false);
  frame.motions.push_back({9, Pose::Translation(0, 5, 0), At(4.4)});
  const auto report = dut_->Apply(frame);
  ASSERT_TRUE(report.ok()) << report.status();
  EXPECT_EQ(report->motions_conflicting, 1u);
  ASSERT_EQ(report->issues.size(), 1u);
  EXPECT_EQ(report->issues[0].kind, ObjectIssueKind::kMotionConflict);
  EXPECT_EQ(report->issues[0].id, 9);
  const ScenePtr now = dut_->Publish();
  EXPECT_NEAR(now->objects[0]->history.back().T_W_O.translation.x() - before_W.x(), 0.8, 1e-6);
}

TEST_F(OtherIds, OfTwoMotionsOfNoSeenIdThatOfTheNewestCounts) {
  LoseAndSeeAgain();
  const Eigen::Vector3d before_W = scene().objects[0]->history.back().T_W_O.translation;
  Frame frame = FrameAt(4.5);
  frame.motions.push_back({5, Pose::Translation(0, 5, 0), At(4.4)});
  frame.motions.push_back({9, Pose::Translation(0.8, 0, 0), At(4.4)});
  const auto report = dut_->Apply(frame);
  ASSERT_TRUE(report.ok()) << report.status();
  ASSERT_EQ(report->issues.size(), 1u);
  EXPECT_EQ(report->issues[0].id, 5);
  const ScenePtr now = dut_->Publish();
  EXPECT_NEAR(now->objects[0]->history.back().T_W_O.translation.x() - before_W.x(), 0.8, 1e-6);
}

}  // namespace
}  // namespace clearway
