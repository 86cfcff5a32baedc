// Depth images pushed as such, against the same frames' points.
#include <gtest/gtest.h>

#include <mutex>

#include "clearway/client/error_details.h"
#include "clearway/client/frame_sender.h"
#include "support/frames.h"
#include "support/random.h"
#include "support/test_server.h"

namespace clearway {
namespace {

using testing_support::TestServer;

// A camera that looks along W's x at a wall with a box before it, which moves to the left.
struct Shot {
  Frame frame;
  DepthImage image;
};

Shot ShotOf(int k) {
  Shot shot{testing_support::FrameAt(1 + 0.1 * k), {}};
  Eigen::Matrix3d R_W_S;
  R_W_S << 0, 0, 1,  //
      -1, 0, 0,      //
      0, -1, 0;
  shot.frame.T_W_S = {Eigen::Quaterniond(R_W_S), {0.01 * k, 0, 1}};
  DepthImage& image = shot.image;
  image.width = 64;
  image.height = 48;
  image.depth_unit_m = 0.0002;
  image.fx = image.fy = 55.5;
  image.cx = 31.5;
  image.cy = 23.5;
  testing_support::Random random(100 + k);
  for (int row = 0; row < 48; ++row) {
    for (int column = 0; column < 64; ++column) {
      const bool box = std::abs(column - (40 - k)) < 8 && row > 20;
      const int depth = (box ? 10'000 : 25'000) + random.Integer(-20, 20);
      image.depth.push_back(random.Integer(0, 20) == 0 ? 0 : static_cast<std::uint16_t>(depth));
      image.instance_mask.push_back(box ? 2 : row < 2 ? 1 : 0);
    }
  }
  image.mask_labels = {kStaticLabel, kIgnoreLabel, 300};
  if (k > 0) {
    const Pose H_W = Pose::Translation(0, 2.0 / 55.5, 0);
    shot.frame.motions = {{300, H_W, shot.frame.stamp - FromSeconds(0.1)}};
  }
  return shot;
}

Frame PointsOf(const Shot& shot) {
  Frame frame = shot.frame;
  SetPoints(shot.image, frame);
  return frame;
}

class DepthSenderTest : public testing::Test {
 protected:
  TestServer images_, points_;
  FrameSender dut_{images_.Connect()}, other_{points_.Connect()};
};

TEST_F(DepthSenderTest, ImagesMakeTheSceneThatTheirPointsMake) {
  for (int k = 0; k < 8; ++k) {
    const Shot shot = ShotOf(k);
    const auto image = dut_.Push(shot.frame, shot.image), points = other_.Push(PointsOf(shot));
    ASSERT_TRUE(image.ok()) << image.status();
    ASSERT_TRUE(points.ok()) << points.status();
    EXPECT_EQ(image->version, points->version);
    EXPECT_GT(image->report.points_used, 2500u);
    EXPECT_EQ(image->report.points_used, points->report.points_used);
    EXPECT_GT(image->report.points_ignored, 0u);
    EXPECT_EQ(image->report.points_ignored, points->report.points_ignored);
    EXPECT_EQ(images_.Newest()->Hash(), points_.Newest()->Hash());
  }
  const ScenePtr scene = images_.Newest();
  ASSERT_EQ(scene->objects.size(), 1u);
  EXPECT_TRUE(SameContent(*scene, *points_.Newest()));
}

TEST_F(DepthSenderTest, SoDoesAStream) {
  std::mutex mutex;
  int answers = 0;
  ASSERT_TRUE(dut_.OpenStream([&](const std::string&, std::uint64_t, const auto& ack) {
                    std::lock_guard lock(mutex);
                    EXPECT_TRUE(ack.ok()) << ack.status();
                    ++answers;
                  })
                  .ok());
  for (int k = 0; k < 8; ++k) {
    const Shot shot = ShotOf(k);
    // Points and images may take turns.
    ASSERT_TRUE((k % 3 == 2 ? dut_.Send(PointsOf(shot)) : dut_.Send(shot.frame, shot.image)).ok());
    ASSERT_TRUE(other_.Push(PointsOf(shot)).ok());
  }
  EXPECT_TRUE(dut_.CloseStream().ok());
  EXPECT_EQ(answers, 8);
  EXPECT_EQ(images_.Newest()->Hash(), points_.Newest()->Hash());
}

TEST_F(DepthSenderTest, WhatIsWrongWithAnImageTheServerSays) {
  Shot shot = ShotOf(0);
  const std::string before = images_.Newest()->Hash();
  shot.image.depth.pop_back();
  absl::Status status = dut_.Push(shot.frame, shot.image).status();
  EXPECT_EQ(DetailsOf(status).field, "frame.depth_image.depth") << status;
  status = dut_.Push(PointsOf(ShotOf(0)), ShotOf(0).image).status();
  EXPECT_EQ(DetailsOf(status).field, "frame.depth_image") << status;
  EXPECT_TRUE(absl::IsFailedPrecondition(dut_.Send(shot.frame, shot.image)));
  EXPECT_EQ(images_.Newest()->Hash(), before);
}

}  // namespace
}  // namespace clearway
