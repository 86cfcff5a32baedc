// What tells two objects apart that were seen in turn. See rivals_test.cc for what follows from it.
#include "scene/same_object.h"

#include <gtest/gtest.h>

#include <numbers>
#include <set>
#include <vector>

#include "clearway/scene/scene_builder.h"
#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::AddObject;
using testing_support::At;
using testing_support::BoxSurface;
using testing_support::FrameAt;

constexpr double kPeriod_s = 0.1;
const Eigen::Vector3d kCar_m{4.4, 1.8, 1.4};

// Of a car's surface, one flank.
std::vector<Eigen::Vector3d> Flank(std::vector<Eigen::Vector3d> points) {
  std::erase_if(points, [](const auto& p) { return p.y() > 0.05 - kCar_m.y() / 2; });
  return points;
}

// 1 is seen, then hidden for 1 s, then seen as 2.
class SameObject : public testing::Test {
 protected:
  // Goes from `T_W_B` along B's x. Only its motions are told, so that O lies as W does.
  void See(ObjectId id, const Pose& T_W_B, double speed_mps, double from_s,
           const std::vector<Eigen::Vector3d>& points_B) {
    constexpr int kFrames = 10;
    for (int k = 0; k < kFrames; ++k) {
      const double now_s = from_s + k * kPeriod_s;
      const auto carried_by = [&](double seconds) {
        const Eigen::Vector3d way_W_m = T_W_B.rotation * Eigen::Vector3d(speed_mps * seconds, 0, 0);
        return Pose{.translation = way_W_m};
      };
      Frame frame = FrameAt(now_s);
      AddObject(frame, id, carried_by(now_s) * T_W_B, points_B);
      if (!known_.insert(id).second)
        frame.motions.push_back({id, carried_by(kPeriod_s), At(now_s - kPeriod_s)});
      ASSERT_TRUE(dut_.Apply(frame).ok());
    }
  }
  bool MayBeTheSame() {
    const ScenePtr scene = dut_.Publish();
    return DistanceIfSame_m(*scene->FindObject(1), *scene->FindObject(2), {}).has_value();
  }

  const std::vector<Eigen::Vector3d> car_ = BoxSurface(kCar_m, 0.08);

 private:
  std::set<ObjectId> known_;
  ThreadPool pool_{1};
  SceneBuilder dut_{{}, {}, pool_};
};

struct Way {
  double yaw_deg, speed_mps;
};

class SameCar : public SameObject, public testing::WithParamInterface<Way> {
 protected:
  void SeeAgain(const std::vector<Eigen::Vector3d>& points_B) {
    const auto [yaw_deg, speed_mps] = GetParam();
    const double yaw_rad = yaw_deg * std::numbers::pi / 180;
    const Pose T_W_B = Exp({.angular = {0, 0, yaw_rad}});
    See(1, T_W_B, speed_mps, 0, car_);
    See(2, T_W_B, speed_mps, 2, points_B);
  }
};

TEST_P(SameCar, MayBeItSeenFromOneSide) {
  SeeAgain(Flank(car_));
  EXPECT_TRUE(MayBeTheSame());
}

INSTANTIATE_TEST_SUITE_P(HoweverItLiesInItsFrame, SameCar,
                         testing::Values(Way{0, 0}, Way{30, 0}, Way{45, 0}, Way{90, 0}, Way{0, 8},
                                         Way{30, 8}, Way{45, 8}, Way{60, 8}, Way{90, 8}));

TEST_P(SameCar, MayBeItSeenFromBehind) {
  auto points_B = car_;
  std::erase_if(points_B, [](const auto& p) { return p.x() > 0.1 - kCar_m.x() / 2; });
  SeeAgain(points_B);
  EXPECT_TRUE(MayBeTheSame());
}

// Of a pedestrian half of the back and half of a side.
TEST_F(SameObject, MayBeSeenInPart) {
  const auto pedestrian = BoxSurface({0.6, 0.6, 1.75}, 0.06);
  See(1, {}, 1.5, 0, pedestrian);
  auto points_B = pedestrian;
  std::erase_if(points_B, [](const auto& p) { return p.x() > 0 || p.y() > 0; });
  See(2, {}, 1.5, 2, points_B);
  EXPECT_TRUE(MayBeTheSame());
}

// How it goes later says nothing of where it was when it was first seen.
TEST_F(SameObject, MayBeTheSameThoughItGoesFasterByNow) {
  const auto pedestrian = BoxSurface({0.6, 0.6, 1.75}, 0.06);
  See(1, {}, 1.5, 0, pedestrian);
  See(2, Pose::Translation(0.54, 0, 0), 0.9, 5, pedestrian);  // as if it had gone so all the time
  See(2, Pose::Translation(-3, 0, 0), 1.5, 6, pedestrian);
  EXPECT_TRUE(MayBeTheSame());
}

// What goes along an axis of its frame is known by its lengths.
TEST_F(SameObject, IsNotOneOfOtherLengths) {
  See(1, Pose{}, 8, 0, car_);
  See(2, Pose{}, 8, 2, BoxSurface({1.7, 0.5, 1.8}, 0.08));
  EXPECT_FALSE(MayBeTheSame());
}

}  // namespace
}  // namespace clearway
