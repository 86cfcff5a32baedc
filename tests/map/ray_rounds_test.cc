#include "map/ray_rounds.h"

#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

std::vector<RaySegment> RandomRays(std::size_t count, Random& random) {
  std::vector<RaySegment> rays;
  for (std::size_t i = 0; i < count; ++i) {
    rays.push_back({random.Vector(1).cast<float>(), random.Vector(30).cast<float>()});
  }
  return rays;
}

void Fill(const std::vector<RaySegment>& rays, RayRounds& dut) {
  dut.Clear();
  for (const RaySegment& ray : rays) dut.Add(ray);
  dut.Finish();
}

// Those that go somewhere.
std::vector<RaySegment> RaysOf(const RayRounds& dut, std::size_t round) {
  std::vector<RaySegment> rays;
  for (const RaySegments& eight : dut.round(round)) {
    for (int lane = 0; lane < kLanes; ++lane) {
      const RaySegment ray = SegmentIn(eight, lane);
      if (ray.origin != ray.end) rays.push_back(ray);
    }
  }
  return rays;
}

using Numbers = std::array<float, 6>;
Numbers NumbersOf(const RaySegment& ray) {
  return {ray.origin.x(), ray.origin.y(), ray.origin.z(), ray.end.x(), ray.end.y(), ray.end.z()};
}

std::map<Numbers, int> Counted(const std::vector<RaySegment>& rays) {
  std::map<Numbers, int> counts;
  for (const RaySegment& ray : rays) ++counts[NumbersOf(ray)];
  return counts;
}

TEST(RayRounds, DealsEveryRayOnce) {
  Random random(1);
  RayRounds dut;  // kept from one cloud to the next
  for (const std::size_t count : {1, 12, 13, 103, 104, 105, 500, 1040, 3}) {
    const std::vector<RaySegment> rays = RandomRays(count, random);
    Fill(rays, dut);
    EXPECT_EQ(dut.size(), count);
    std::vector<RaySegment> dealt;
    for (std::size_t round = 0; round < RayRounds::kCount; ++round) {
      for (const RaySegment& ray : RaysOf(dut, round)) dealt.push_back(ray);
    }
    EXPECT_EQ(Counted(dealt), Counted(rays)) << count;
  }
}

// One of thirteen rays in a row, three that lie apart from it and each other, and the rest.
TEST(RayRounds, TheFirstOnesLieApart) {
  Random random(2);
  const std::vector<RaySegment> rays = RandomRays(10 * RayRounds::kInARow * kLanes, random);
  RayRounds dut;
  Fill(rays, dut);
  std::map<Numbers, std::size_t> places;
  for (std::size_t i = 0; i < rays.size(); ++i) places[NumbersOf(rays[i])] = i;
  const auto in_row = [&](std::size_t round) {
    std::map<std::size_t, std::size_t> counts;
    for (const RaySegment& ray : RaysOf(dut, round)) {
      ++counts[places.at(NumbersOf(ray)) % RayRounds::kInARow];
    }
    return counts;
  };
  const std::size_t rows = rays.size() / RayRounds::kInARow;
  EXPECT_EQ(in_row(0), (std::map<std::size_t, std::size_t>{{0, rows}}));
  EXPECT_EQ(in_row(1), (std::map<std::size_t, std::size_t>{{4, rows}, {8, rows}, {11, rows}}));
  EXPECT_EQ(in_row(2).size(), 9u);
}

TEST(RayRounds, BoxesAreAroundAllRays) {
  Random random(3);
  for (const std::size_t count : {1, 50, 104, 333}) {
    const std::vector<RaySegment> rays = RandomRays(count, random);
    RayRounds dut;
    Fill(rays, dut);
    Eigen::AlignedBox3f origins, ends;
    for (const RaySegment& ray : rays) {
      origins.extend(ray.origin);
      ends.extend(ray.end);
    }
    if (count % (RayRounds::kInARow * kLanes) != 0) ends.extend(rays[count / 104 * 104].origin);
    const RayBoxes boxes = dut.BoxesAround();
    EXPECT_EQ(boxes.origins.min(), origins.min());
    EXPECT_EQ(boxes.origins.max(), origins.max());
    EXPECT_EQ(boxes.ends.min(), ends.min());
    EXPECT_EQ(boxes.ends.max(), ends.max());
  }
}

TEST(RayRounds, TheMainAxisIsThatOfTheLargestComponent) {
  EXPECT_EQ(MainAxis({3, -2, 1}), 0);
  EXPECT_EQ(MainAxis({1, -2, 1}), 1);
  EXPECT_EQ(MainAxis({1, 2, -3}), 2);
  EXPECT_EQ(MainAxis({2, 2, 2}), 0);
  EXPECT_EQ(MainAxis({1, 2, 2}), 1);
}

}  // namespace
}  // namespace clearway
