#include "clearway/sim/forgetful_tracker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/frames.h"

namespace clearway {
namespace {

using testing::ElementsAre;
using testing::Pair;
using testing_support::AddPoint;
using testing_support::At;
using testing_support::FrameAt;

constexpr ObjectId kNew = ForgetfulTracker::kFirstNewId;

// A frame in which the simulation tells motions of both 1 and 2.
Frame Showing(double seconds, const std::vector<ObjectId>& seen) {
  Frame frame = FrameAt(seconds);
  AddPoint(frame, kStaticLabel, {1, 0, 0});
  AddPoint(frame, kIgnoreLabel, {2, 0, 0});
  for (const ObjectId id : seen) AddPoint(frame, id, {3, 0, 0});
  for (const ObjectId id : {1, 2}) frame.motions.push_back({id, Pose(), At(seconds - 0.1)});
  return frame;
}

std::vector<ObjectId> MotionsOf(const Frame& frame) {
  std::vector<ObjectId> ids;
  for (const ObjectMotion& motion : frame.motions) ids.push_back(motion.id);
  return ids;
}

TEST(ForgetfulTracker, GivesNewIdsAfterLongGapsAlone) {
  ForgetfulTracker dut(FromSeconds(0.25));
  EXPECT_THAT(dut.Retold(Showing(0, {1, 2})).labels, ElementsAre(0, -1, 1, 2));
  EXPECT_THAT(dut.Retold(Showing(0.2, {1})).labels, ElementsAre(0, -1, 1));
  EXPECT_THAT(dut.Retold(Showing(0.4, {1, 2})).labels, ElementsAre(0, -1, 1, kNew));
  EXPECT_THAT(dut.Retold(Showing(0.6, {2, 1})).labels, ElementsAre(0, -1, kNew, 1));
  EXPECT_THAT(dut.Retold(Showing(1.0, {1, 2})).labels, ElementsAre(0, -1, kNew + 1, kNew + 2));
  EXPECT_THAT(dut.true_ids(), ElementsAre(Pair(1, 1), Pair(2, 2), Pair(kNew, 2), Pair(kNew + 1, 1),
                                          Pair(kNew + 2, 2)));
}

TEST(ForgetfulTracker, TellsMotionsOfWhatItFollows) {
  ForgetfulTracker dut(FromSeconds(0.25));
  EXPECT_THAT(MotionsOf(dut.Retold(Showing(0, {1}))), ElementsAre());
  EXPECT_THAT(MotionsOf(dut.Retold(Showing(0.1, {1, 2}))), ElementsAre(1));
  EXPECT_THAT(MotionsOf(dut.Retold(Showing(0.2, {2}))), ElementsAre(2));
  EXPECT_THAT(MotionsOf(dut.Retold(Showing(0.5, {1, 2}))), ElementsAre());
  EXPECT_THAT(MotionsOf(dut.Retold(Showing(0.6, {1, 2}))), ElementsAre(kNew, kNew + 1));
}

// The tracker did not look in between, but knows where it was.
TEST(ForgetfulTracker, TellsMotionsSinceItLastSawTheObject) {
  ForgetfulTracker dut(FromSeconds(0.25));
  const auto moving = [](double seconds, const std::vector<ObjectId>& seen) {
    Frame frame = Showing(seconds, seen);
    for (ObjectMotion& motion : frame.motions) motion.H_W = Pose::Translation(0, motion.id, 0);
    return frame;
  };
  (void)dut.Retold(moving(0.1, {1, 2}));
  (void)dut.Retold(moving(0.2, {1}));
  const Frame told = dut.Retold(moving(0.3, {1, 2}));
  ASSERT_EQ(told.motions.size(), 2u);
  EXPECT_EQ(told.motions[0].from, At(0.2));
  EXPECT_EQ(told.motions[0].H_W.translation, Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(told.motions[1].from, At(0.1));
  EXPECT_EQ(told.motions[1].H_W.translation, Eigen::Vector3d(0, 4, 0));
}

TEST(ForgetfulTracker, TellsPartsByTheirNewestIds) {
  ForgetfulTracker dut(FromSeconds(0.25));
  const auto parts = [&](double seconds, const std::vector<ObjectId>& seen) {
    Frame frame = Showing(seconds, seen);
    frame.parts = {{2, 1}};
    return dut.Retold(frame).parts;
  };
  EXPECT_EQ(parts(0, {1, 2}), (std::vector<ObjectPart>{{2, 1}}));
  EXPECT_TRUE(parts(0.2, {1}).empty());
  EXPECT_EQ(parts(0.4, {1, 2}), (std::vector<ObjectPart>{{kNew, 1}}));
  EXPECT_EQ(parts(1.0, {1, 2}), (std::vector<ObjectPart>{{kNew + 2, kNew + 1}}));
}

TEST(ForgetfulTracker, TellsPosesOfWhatItSees) {
  ForgetfulTracker dut(FromSeconds(0.25));
  (void)dut.Retold(Showing(0, {1}));
  Frame frame = Showing(1, {1});
  frame.motions.clear();
  frame.poses = {{1, Pose::Translation(1, 2, 3)}, {2, Pose()}};
  const Frame told = dut.Retold(frame);
  ASSERT_EQ(told.poses.size(), 1u);
  EXPECT_EQ(told.poses[0].id, kNew);
  EXPECT_EQ(told.poses[0].T_W_B.translation, Eigen::Vector3d(1, 2, 3));
}

}  // namespace
}  // namespace clearway
