#include "clearway/sim/missed_objects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace clearway {
namespace {

TEST(MissedObjects, ArePartOfTheStaticWorld) {
  Frame frame;
  frame.labels = {0, 3, 4, 3, kIgnoreLabel, 5};
  frame.points_S.resize(frame.labels.size());
  frame.motions = {{3, {}, {}}, {4, {}, {}}};
  frame.poses = {{5, {}}, {6, {}}};
  const Frame dut = WithoutObjects(frame, {3, 5});
  EXPECT_THAT(dut.labels, testing::ElementsAre(0, 0, 4, 0, kIgnoreLabel, 0));
  ASSERT_EQ(dut.motions.size(), 1u);
  EXPECT_EQ(dut.motions[0].id, 4);
  ASSERT_EQ(dut.poses.size(), 1u);
  EXPECT_EQ(dut.poses[0].id, 6);
  EXPECT_EQ(WithoutObjects(frame, {}).labels, frame.labels);
}

TEST(MissedObjects, AreNoPartsOfOthers) {
  Frame frame;
  frame.parts = {{3, 1}, {4, 1}, {5, 2}};
  EXPECT_EQ(WithoutObjects(frame, {2, 3}).parts, (std::vector<ObjectPart>{{4, 1}}));
}

TEST(MissedParts, ArePartOfARigidWhole) {
  Frame frame;
  frame.labels = {0, 1, 2, 3, kIgnoreLabel, 5};
  frame.points_S.resize(frame.labels.size());
  frame.motions = {{1, Pose::Translation(1, 0, 0), {}}, {2, {}, {}}};
  frame.poses = {{3, {}}, {5, {}}};
  frame.parts = {{2, 1}, {3, 1}, {5, kStaticLabel}};
  const Frame dut = WithoutParts(frame);
  EXPECT_THAT(dut.labels, testing::ElementsAre(0, 1, 1, 1, kIgnoreLabel, 5));
  ASSERT_EQ(dut.motions.size(), 1u);
  EXPECT_EQ(dut.motions[0].H_W.translation.x(), 1);
  ASSERT_EQ(dut.poses.size(), 1u);
  EXPECT_EQ(dut.poses[0].id, 5);
  EXPECT_TRUE(dut.parts.empty());
}

}  // namespace
}  // namespace clearway
