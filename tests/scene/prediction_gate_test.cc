#include "scene/prediction_gate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "clearway/scene/scene_builder.h"
#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::AddObject;
using testing_support::BoxSurface;
using testing_support::FrameAt;

class PredictionGate : public testing::Test {
 protected:
  // What the scene makes of a box of that size at the pose, shown once from all sides.
  std::shared_ptr<const MovingObject> Shown(const Eigen::Vector3d& size_m, const Pose& T_W_B) {
    SceneBuilder builder(SceneParams{}, FrameLimits{}, pool_);
    Frame frame = FrameAt(0);
    AddObject(frame, 1, T_W_B, BoxSurface(size_m, 0.1));
    EXPECT_TRUE(builder.Apply(frame).ok());
    return builder.Publish()->objects.front();
  }
  static std::vector<Eigen::Vector3d> Points(const Eigen::Vector3d& size_m,
                                             const Eigen::Vector3d& center_W) {
    std::vector<Eigen::Vector3d> points = BoxSurface(size_m, 0.1);
    for (Eigen::Vector3d& p : points) p += center_W;
    return points;
  }
  static GateOffset Offset(const MovingObject& object, const std::vector<Eigen::Vector3d>& points) {
    return OffsetFrom(object, object.history.back().T_W_O, points);
  }
  ThreadPool pool_{1};
};

TEST_F(PredictionGate, Empty) {
  const auto object = Shown({4, 2, 2}, Pose::Translation(9, 3, 1));
  EXPECT_EQ(Offset(*object, {}).off_W, Eigen::Vector3d::Zero());
}

TEST_F(PredictionGate, PointsWithinTheBoxAreNotOff) {
  const auto object = Shown({4, 2, 2}, Pose::Translation(9, 3, 1));
  EXPECT_EQ(Offset(*object, Points({4, 2, 2}, {9, 3, 1})).off_W, Eigen::Vector3d::Zero());
  EXPECT_EQ(Offset(*object, Points({1, 2, 1}, {10.4, 3, 1})).off_W, Eigen::Vector3d::Zero());
}

TEST_F(PredictionGate, PointsBesideTheBoxAreOffByWhatTheyExceedIt) {
  const auto object = Shown({4, 2, 2}, Pose::Translation(9, 3, 1));
  const GateOffset offset = Offset(*object, Points({4, 2, 2}, {9, 6, 1}));
  EXPECT_LT((offset.off_W - Eigen::Vector3d(0, 3, 0)).norm(), 0.25);
  EXPECT_NEAR(offset.half_size_m, 1, 0.15);
  EXPECT_TRUE(MeetsPrediction(offset, 2.2));
  EXPECT_FALSE(MeetsPrediction(offset, 1.5));
}

TEST_F(PredictionGate, AViewOfMoreOfTheObjectIsNotOff) {
  const auto rear = Shown({0.2, 2, 1}, Pose::Translation(9, 3, 1));
  EXPECT_EQ(Offset(*rear, Points({4, 2, 2}, {11, 3, 1})).off_W, Eigen::Vector3d::Zero());
}

TEST_F(PredictionGate, AFewStraysDoNotCount) {
  const auto object = Shown({1, 1, 1}, Pose::Translation(9, 3, 1));
  auto points = Points({1, 1, 1}, {9, 3, 1});
  for (std::size_t i = 0; i < points.size() / 40; ++i) points.push_back({30, 3, 1});
  EXPECT_EQ(Offset(*object, points).off_W, Eigen::Vector3d::Zero());
}

TEST_F(PredictionGate, OffsetsTurnWithTheObject) {
  auto object = *Shown({4, 2, 2}, Pose::Translation(9, 3, 1));
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()));
  Pose T_W_O = object.history.back().T_W_O;
  T_W_O = {turn * T_W_O.rotation, T_W_O.translation};
  std::vector<Eigen::Vector3d> points_W;
  const Eigen::Vector3d aside_W = turn * Eigen::Vector3d(0, 5, 0);
  for (const Eigen::Vector3d& p : Points({4, 2, 2}, {9, 3, 1})) {
    points_W.push_back(T_W_O * (Inverse(object.history.back().T_W_O) * p) + aside_W);
  }
  EXPECT_LT((OffsetFrom(object, T_W_O, points_W).off_W - aside_W).norm(), 0.25);
}

}  // namespace
}  // namespace clearway
