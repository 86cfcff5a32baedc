#include "clearway/report/truth.h"

#include <gtest/gtest.h>

#include <memory>

namespace clearway {
namespace {

using std::chrono::seconds;

Truth OfABox() {
  auto world = std::make_shared<World>();
  world->Add(Body::Single(7, "", Box{{2, 1, 1}}, FixedPose{Pose::Translation(5, 0, 0)}));
  return TruthOf(std::shared_ptr<const World>(world), Time(seconds(9)));
}

TEST(Truth, IsCarriedAlongWithItsWorld) {
  WorldCorrections corrections;
  corrections.Add(Time(seconds(1)), {});
  corrections.Add(Time(seconds(2)), Pose::Translation(0, 3, 0));
  const Truth dut = CarriedBy(corrections, OfABox());
  EXPECT_EQ(dut.end, OfABox().end);
  EXPECT_EQ(BoxOf(dut, 7, Time(seconds(1)))->T_W_B, Pose::Translation(5, 0, 0));
  EXPECT_EQ(BoxOf(dut, 7, Time(seconds(2)))->T_W_B, Pose::Translation(5, 3, 0));
  const Shape ball = Sphere{0.1};
  EXPECT_EQ(dut.touched(ball, Pose::Translation(5, 0, 0), Time(seconds(1))), 7);
  EXPECT_EQ(dut.touched(ball, Pose::Translation(5, 0, 0), Time(seconds(2))), std::nullopt);
  EXPECT_EQ(dut.touched(ball, Pose::Translation(5, 3, 0), Time(seconds(2))), 7);
}

}  // namespace
}  // namespace clearway
