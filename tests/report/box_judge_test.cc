// A scene judged by recorded boxes.
#include "clearway/report/box_judge.h"

#include <gtest/gtest.h>

#include "clearway/report/true_bodies.h"
#include "clearway/scene/scene_builder.h"
#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::AddObject;
using testing_support::At;
using testing_support::BoxSurface;
using testing_support::FrameAt;

const Eigen::Vector3d kSize_m(2, 1, 1);
const std::map<ObjectId, Eigen::Vector3d> kSizes_m = {{7, kSize_m}};

// Object 7 goes 2 m/s along x, until 3 s.
Pose PoseAt(Time t) { return Pose::Translation(5 + 2 * ToSeconds(t - At(0)), 0.03, 1.02); }
Truth OneBox() {
  Truth truth;
  truth.end = At(3);
  truth.boxes = [](Time t) {
    if (t > At(3)) return std::vector<TrueBox>{};
    return std::vector<TrueBox>{{7, kSize_m, PoseAt(t)}};
  };
  return truth;
}

// Of two seconds in which the object is seen to have that size.
BoxJudge JudgeOf(const Eigen::Vector3d& seen_size_m) {
  ThreadPool pool(1);
  SceneParams params;
  params.resolution_m = params.object_resolution_m = 0.1;
  SceneBuilder builder(params, {}, pool);
  BoxJudge dut(OneBox(), kSizes_m, {std::chrono::milliseconds(500)});
  for (std::size_t k = 0; k < 20; ++k) {
    Frame frame = FrameAt(0.1 * static_cast<double>(k));
    AddObject(frame, 7, PoseAt(frame.stamp), BoxSurface(seen_size_m, 0.05));
    frame.poses.push_back({7, PoseAt(frame.stamp)});
    EXPECT_TRUE(builder.Apply(frame).ok());
    dut.Add(k + 1, frame, *builder.Publish());  // solids not of the first: it has no motion yet
  }
  EXPECT_EQ(dut.ResidueIn(*builder.Publish()).occupied, 0);
  EXPECT_GT(dut.ResidueIn(*builder.Publish()).passed, 1000);  // it passed 4 m
  return dut;
}

TEST(BoxJudge, FindsNothingWrongWithABox) {
  const BoxJudge dut = JudgeOf(kSize_m);
  const auto fits = dut.Fits();
  const ObjectFit& fit = fits.at(7);
  EXPECT_LE(fit.Accuracy_m(), 0.05 + 1e-6);
  EXPECT_EQ(fit.Completeness(), 1);
  EXPECT_EQ(fit.growth.size(), 20u);
  EXPECT_GT(dut.overlaps().at(7)[0].FScore(), 0.99);
}

// Of a post of 0.2 m in its middle each side is 0.4 m from the next face.
TEST(BoxJudge, MeasuresHowFarTheMapIsFromTheBox) {
  const auto fits = JudgeOf({0.2, 0.2, 0.2}).Fits();
  EXPECT_NEAR(fits.at(7).Accuracy_m(), 0.4, 0.06);
}

TEST(TrueBodies, OfBoxesAreKnownWhereTheTruthTellsThem) {
  const TrueBodies dut(OneBox(), kSizes_m);
  ASSERT_NE(dut.Find(7), nullptr);
  EXPECT_EQ(dut.Find(8), nullptr);
  EXPECT_EQ(dut.T_W_B(7, At(1)), PoseAt(At(1)));
  EXPECT_FALSE(dut.T_W_B(7, At(4)));
  EXPECT_FALSE(dut.T_W_B(8, At(1)));
}

TEST(TrueBodies, OfNoSizeAreNotKnown) {
  const TrueBodies dut(OneBox(), {});
  EXPECT_EQ(dut.Find(7), nullptr);
}

}  // namespace
}  // namespace clearway
