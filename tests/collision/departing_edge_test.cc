#include "collision/departing_edge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "collision/random_motions.h"
#include "collision/random_world.h"

namespace clearway {
namespace {

TEST(LinkReaches, AreTheFarthestPointsOfShapesOrOfTheirCores) {
  const Robot robot{
      "any",
      {{"ball", {{Sphere{0.5}, Pose::Translation(1, 0, 0)}}},
       {"capsule", {{Capsule{0.1, 2}, Pose{}}}},
       {"boxes", {{Box{{2, 2, 2}}, Pose{}}, {Sphere{1}, Pose::Translation(0, 3, 4)}}}}};
  const std::vector<double> dut = LinkReaches(robot);
  ASSERT_EQ(dut.size(), 3u);
  EXPECT_DOUBLE_EQ(dut[0], 1);
  EXPECT_DOUBLE_EQ(dut[1], 1);
  EXPECT_DOUBLE_EQ(dut[2], 5);
}

// The poses of the only motion at t, and in which leg that is.
std::size_t PosesAt(const Asked& motion, Time t, std::vector<Pose>& T_W_L) {
  const std::size_t knots = motion.motions.times.size();
  T_W_L = StatesAt(motion, 0, knots, {t}).T_W_L;
  std::size_t leg = 0;
  while (leg + 2 < knots && motion.motions.times[leg + 1] <= t) ++leg;
  return leg;
}

// A corner of each link's box, which is the farthest from the link's origin.
const Eigen::Vector3d kCorner_L(0.3, -0.2, 0.4);

// How far a link's corner is from the motion, as a share of what it may stray: for whoever departs
// in the interval, at a time when he is on the way.
double LargestShare(RandomWorld& random, const Asked& edge, const Asked& motion,
                    const TimeInterval& departures, Time since) {
  double largest = 0;
  std::vector<Pose> is_W, asked_W;
  const double apart_s = ToSeconds(departures.until - departures.from);
  const double lasts_s = ToSeconds(edge.motions.times.back() - Time());
  for (int i = 0; i < 300; ++i) {
    const double share = i < 100 ? i % 2 : random.Uniform(0, 1);  // the ends are the worst
    const Time departure = departures.from + FromSeconds(share * apart_s);
    const Duration on_the_way = FromSeconds(random.Uniform(0, 1) * lasts_s);
    const Time t = departure + on_the_way;
    if (t < since) continue;
    EXPECT_LE(motion.motions.times.front(), t);
    EXPECT_GE(motion.motions.times.back(), t);
    PosesAt(edge, Time() + on_the_way, is_W);
    const std::size_t leg = PosesAt(motion, t, asked_W);
    for (std::size_t l = 0; l < edge.links; ++l) {
      const double apart_m = (is_W[l] * kCorner_L - asked_W[l] * kCorner_L).norm();
      const double may_m = motion.motions.deviations_m[leg * edge.links + l];
      largest = std::max(largest, apart_m / (may_m + 1e-9));
    }
  }
  return largest;
}

// No further than it says, and not much less at worst.
TEST(DepartingEdge, IsNeverFurtherFromTheMotionThanItsDeviations) {
  double largest = 0;
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    RandomWorld random(9000 + seed);
    const Robot robot{"boxes",
                      {{"a", {{Box{2 * kCorner_L.cwiseAbs()}, Pose{}}}},
                       {"b", {{Box{2 * kCorner_L.cwiseAbs()}, Pose{}}}}}};
    Asked edge = RandomMotions(random, robot, 1);
    const Duration begins = edge.motions.times[0].time_since_epoch();
    for (Time& t : edge.motions.times) t -= begins;
    const DepartingEdge dut(edge.motions, 0, edge.motions.times.size(), LinkReaches(robot));
    const Time from = TestTime(random.Uniform(-5, 5));
    const TimeInterval departures{from, from + FromSeconds(random.Uniform(0, 1))};
    const Time since = random.Below(2) ? Time::min() : from + FromSeconds(random.Uniform(0, 0.5));
    Asked motion{{}, edge.links};
    dut.AppendMotion(departures, since, motion.motions);
    ASSERT_TRUE(Validate(motion.motions, robot).ok()) << Validate(motion.motions, robot);
    for (const double deviation_m : motion.motions.deviations_m) {
      EXPECT_LE(deviation_m, dut.MostDeviation(departures));
    }
    EXPECT_EQ(motion.motions.times.back(), dut.ArrivalAfter(departures.until));
    largest = std::max(largest, LargestShare(random, edge, motion, departures, since));
  }
  EXPECT_LE(largest, 1);
  EXPECT_GE(largest, 0.95);
}

// What each leg strays by itself counts as long as the robot may be on it.
TEST(DepartingEdge, StraysAsTheLegsThatItMayBeOn) {
  MotionBatch edges{{4}, {}, std::vector<Pose>(4), {0.1, 0.4, 0.2, 0}};
  for (int k = 0; k < 4; ++k) edges.times.push_back(Time() + FromSeconds(k));
  const DepartingEdge dut(edges, 0, 4, {0});
  MotionBatch motions;
  dut.AppendMotion({TestTime(0), TestTime(1)}, Time::min(), motions);
  EXPECT_EQ(motions.deviations_m, (std::vector<double>{0.1, 0.4, 0.4, 0.4, 0.2, 0}));
  motions = {};
  dut.AppendMotion({TestTime(0), TestTime(0)}, Time::min(), motions);
  EXPECT_EQ(motions.deviations_m, edges.deviations_m);
}

TEST(DepartingEdge, IsAtItsPlaces) {
  MotionBatch edges{{3}, {}, {}, {}};
  for (int k = 0; k < 3; ++k) {
    edges.times.push_back(Time() + FromSeconds(k));
    edges.T_W_L.push_back(Pose::Translation(k * k, 0, 0));
  }
  const DepartingEdge dut(edges, 0, 3, {0});
  std::vector<Pose> T_W_L;
  for (const double s : {0.0, 0.5, 1.0, 1.5, 2.0}) dut.AppendPlace(FromSeconds(s), T_W_L);
  for (std::size_t i = 0; i < 5; ++i) {
    const double expected_m[] = {0, 0.5, 1, 2.5, 4};
    EXPECT_NEAR(T_W_L[i].translation.x(), expected_m[i], 1e-12);
  }
}

}  // namespace
}  // namespace clearway
