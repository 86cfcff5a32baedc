#include "scene/labelled_cloud.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

// Points of all kinds that are left out, and others.
Frame MixedFrame(Random& random) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  Frame frame;
  frame.T_W_S = random.AnyPose(3);
  for (int i = 0; i < 3'000; ++i) {
    Eigen::Vector3f p_S = random.Vector(8).cast<float>();
    if (i % 50 == 0) p_S[random.Integer(0, 2)] = i % 100 == 0 ? kNan : kInfinity;
    if (i % 70 == 0) p_S *= 1e6f;
    frame.points_S.push_back(p_S);
    frame.labels.push_back(i % 11 == 0 ? kIgnoreLabel : i % 5 == 0 ? 3 : kStaticLabel);
  }
  return frame;
}

void ExpectSame(const LabelledCloud& a, const LabelledCloud& b) {
  EXPECT_EQ(a.ends_W, b.ends_W);
  for (const Eigen::Vector3f& origin_W : b.origins_W) EXPECT_EQ(origin_W, a.origins_W.at(0));
  EXPECT_EQ(a.kinds, b.kinds);
  EXPECT_EQ(a.labels, b.labels);
  EXPECT_EQ(a.object_hits, b.object_hits);
}

// With a filter, though it holds no point, and with an origin for each point, every point is looked
// at closely.
TEST(PlaceCloud, TheQuickWayIsTheLongWay) {
  Random random(1);
  for (int i = 0; i < 4; ++i) {
    Frame frame = MixedFrame(random);
    SceneParams params;
    params.rays.max_range_m = 7;
    if (i % 2 == 0) params.bounds_W = {Eigen::Vector3d(-5, -6, -4), Eigen::Vector3d(5, 4, 6)};
    FrameReport quick, filtered, with_origins;
    const LabelledCloud cloud = PlaceCloud(frame, params, quick);
    frame.origins_S.assign(frame.points_S.size(), Eigen::Vector3f::Zero());
    ExpectSame(cloud, PlaceCloud(frame, params, with_origins));
    frame.origins_S.clear();
    params.self_filter_S = {{Eigen::Vector3d(90, 90, 90), Eigen::Vector3d(91, 91, 91)}};
    ExpectSame(cloud, PlaceCloud(frame, params, filtered));
    for (const FrameReport& report : {filtered, with_origins}) {
      EXPECT_EQ(report.points_used, quick.points_used);
      EXPECT_EQ(report.points_ignored, quick.points_ignored);
      EXPECT_EQ(report.points_not_finite, quick.points_not_finite);
      EXPECT_EQ(report.points_out_of_bounds, quick.points_out_of_bounds);
    }
    for (const std::size_t count : {quick.points_used, quick.points_ignored,
                                    quick.points_not_finite, quick.points_out_of_bounds}) {
      EXPECT_GT(count, 10);
    }
  }
}

// A hit there would make the robot's own place occupied.
TEST(PlaceCloud, PointsAtTheSensorAreLostReturns) {
  Frame frame;
  frame.T_W_S = Pose::Translation(3, 2, 1);
  frame.points_S = {{0, 0, 0}, {0, 0, 1e-6f}, {1, 0, 0}};
  frame.labels = {kStaticLabel, kStaticLabel, kStaticLabel};
  FrameReport report;
  EXPECT_EQ(PlaceCloud(frame, {}, report).ends_W.size(), 2u);
  EXPECT_EQ(report.points_not_finite, 1u);
  frame.origins_S = frame.points_S;  // whose rays are not known
  FrameReport with_origins;
  EXPECT_EQ(PlaceCloud(frame, {}, with_origins).ends_W.size(), 3u);
}

}  // namespace
}  // namespace clearway
