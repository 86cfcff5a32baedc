#include "clearway/report/prediction_score.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "report/test_scene.h"

namespace clearway {
namespace {

using std::chrono::seconds;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

// Object 7 goes 1 m/s along x, and its box's middle is not its map's origin.
Truth GoingAhead(Time end) {
  Truth truth;
  truth.end = end;
  truth.boxes = [](Time t) {
    const double x_m = -2 + ToSeconds(t - Time(seconds(10)));
    return std::vector<TrueBox>{{7, {2, 1, 1}, Pose::Translation(x_m, 0.3, 0)}};
  };
  return truth;
}

// The scene takes it for so fast.
SceneSnapshot SceneWith(double speed_mps, bool bridged = false) {
  SceneSnapshot scene = TestScene();
  auto object = BoxObject(7, {2, 1, 1}, Pose::Translation(-2, 0, 0), scene.stamp);
  object->velocity_O = Twist{.linear = {speed_mps, 0, 0}};
  object->bridged = bridged;
  scene.objects = {object};
  return scene;
}

TEST(PredictionScore, IsHowFarTheBoxIsFromWhereItWasPredicted) {
  PredictionScore dut(GoingAhead(Time(seconds(13))), {seconds(1), seconds(2), seconds(4)});
  dut.Add(SceneWith(1));
  dut.Add(SceneWith(0.5));
  dut.Add(SceneWith(1.25));
  const auto errors = dut.Errors();
  ASSERT_EQ(errors.size(), 1u);
  const std::vector<PredictionErrors>& of_object = errors.at(7);
  ASSERT_EQ(of_object.size(), 3u);
  EXPECT_EQ(of_object[1].ahead, seconds(2));
  const auto near = [](double error_m) { return DoubleNear(error_m, 1e-9); };
  EXPECT_THAT(of_object[0].errors_m, ElementsAre(near(0), near(0.25), near(0.5)));
  EXPECT_THAT(of_object[1].errors_m, ElementsAre(near(0), near(0.5), near(1)));
  EXPECT_THAT(of_object[2].errors_m, IsEmpty());  // nobody knows where it is then
  EXPECT_NEAR(of_object[0].Median(), 0.25, 1e-9);
  EXPECT_NEAR(of_object[0].Quantile(0.95), 0.5, 1e-9);
  EXPECT_TRUE(std::isnan(of_object[2].Median()));
}

TEST(PredictionScore, TellsByHowMuchItIsTurned) {
  PredictionScore dut(GoingAhead(Time(seconds(13))), {seconds(1), seconds(2)});
  for (const double turn_radps : {0.0, -0.1, 0.2}) {
    SceneSnapshot scene = SceneWith(1);
    auto object = std::make_shared<MovingObject>(*scene.objects[0]);
    object->velocity_O->angular = {0, 0, turn_radps};
    scene.objects = {object};
    dut.Add(scene);
  }
  const std::vector<PredictionErrors> of_object = dut.Errors().at(7);
  const auto near = [](double turn_rad) { return DoubleNear(turn_rad, 1e-6); };
  EXPECT_THAT(of_object[0].turns_rad, ElementsAre(near(0), near(0.1), near(0.2)));
  EXPECT_NEAR(of_object[1].TurnQuantile_rad(0.5), 0.2, 1e-6);
}

TEST(PredictionScore, CountsOnlyWhatWasSeenAndHasATruth) {
  PredictionScore dut(GoingAhead(Time(seconds(13))), {seconds(1)});
  dut.Add(SceneWith(1, /*bridged=*/true));
  SceneSnapshot later = SceneWith(1);
  later.stamp += seconds(1);  // without object 7
  dut.Add(later);
  SceneSnapshot another = SceneWith(1);
  another.objects = {BoxObject(8, {1, 1, 1}, {}, another.stamp)};
  dut.Add(another);
  EXPECT_THAT(dut.Errors(), IsEmpty());
}

}  // namespace
}  // namespace clearway
