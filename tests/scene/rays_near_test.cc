// The rays of a frame that pass near an object.
#include "scene/rays_near.h"

#include <gtest/gtest.h>

#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

// Far from the world's origin and from the box, where single precision is coarse.
class RaysWithinTest : public testing::TestWithParam<bool> {
 protected:
  LabelledCloud AnyCloud() {
    const Eigen::Vector3d sensor_W(900, -700, 2);
    LabelledCloud cloud;
    if (GetParam()) cloud.origins_W = {sensor_W.cast<float>()};
    for (int i = 0; i < 20'000; ++i) {
      if (!GetParam()) cloud.origins_W.push_back((sensor_W + random_.Vector(5)).cast<float>());
      const Eigen::Vector3d towards_W = T_W_O_.translation + random_.Vector(2) - sensor_W;
      cloud.ends_W.push_back((sensor_W + random_.Uniform(-0.5, 1.5) * towards_W).cast<float>());
      cloud.kinds.push_back(static_cast<RayEnd>(i % 3));
      cloud.labels.push_back(kStaticLabel);
    }
    return cloud;
  }

  Random random_{3};
  Pose T_W_O_ = Pose::Translation(960, -650, 1) * random_.AnyPose(0.5);
};

// Ray by ray.
TEST_P(RaysWithinTest, AreThoseThatTheBoxClips) {
  const Aabb box_O{{-0.4, -0.2, -0.9}, {1.2, 0.3, 0.8}};
  const Pose T_O_W = Inverse(T_W_O_);
  for (int round = 0; round < 5; ++round) {
    const LabelledCloud cloud = AnyCloud();
    const ClippedRays dut = RaysWithin(box_O, T_W_O_, cloud, {});
    std::size_t found = 0;
    for (std::size_t i = 0; i < cloud.ends_W.size(); ++i) {
      const Eigen::Vector3f& origin_W = cloud.origins_W[GetParam() ? 0 : i];
      const Eigen::Vector3d origin_O = T_O_W * origin_W.cast<double>();
      const Eigen::Vector3d ray_O = T_O_W * cloud.ends_W[i].cast<double>() - origin_O;
      const auto [begin, end] = Clip(box_O, origin_O, ray_O, {0, 1});
      if (begin > end) continue;
      ASSERT_LT(found, dut.ends_O.size());
      EXPECT_EQ(dut.of[found], i);
      EXPECT_EQ(dut.origins_O[found], (origin_O + begin * ray_O).cast<float>());
      EXPECT_EQ(dut.ends_O[found], (origin_O + end * ray_O).cast<float>());
      const bool is_blocked = end == 1 && cloud.kinds[i] != RayEnd::kClear;
      EXPECT_EQ(dut.kinds[found], is_blocked ? RayEnd::kBlock : RayEnd::kClear);
      ++found;
    }
    EXPECT_EQ(dut.ends_O.size(), found);
    EXPECT_GT(found, 300u);
    EXPECT_LT(found, 10'000u);
  }
}

INSTANTIATE_TEST_SUITE_P(FromOneOriginOrMany, RaysWithinTest, testing::Bool());

TEST(RaysWithin, OfAnEmptyCloud) {
  LabelledCloud cloud;
  cloud.origins_W = {{1, 2, 3}};
  EXPECT_TRUE(RaysWithin({{0, 0, 0}, {1, 1, 1}}, Pose(), cloud, {}).ends_O.empty());
}

}  // namespace
}  // namespace clearway
