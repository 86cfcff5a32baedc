// Nobody is known again as one that is clearly larger or smaller.
#include "scene/other_shape.h"

#include <gtest/gtest.h>

#include <utility>

#include "scene/seen_through.h"

namespace clearway {
namespace {

using OtherShape = SeenThrough;

const RoadUserShape kTrolley{
    {{{-0.6, -0.3, -0.9}, {0.6, 0.3, -0.3}}, {{-0.6, -0.3, -0.9}, {-0.5, 0.3, 0.2}}}};
const RoadUserShape kCrate{{{{-0.6, -0.3, -0.9}, {0.6, 0.3, 0.2}}}};

RoadUserShape Raised(RoadUserShape shape, double by_m) {
  const Eigen::Vector3d by = by_m * Eigen::Vector3d::UnitZ();
  for (Aabb& box_B : shape.boxes_B) box_B = {box_B.min + by, box_B.max + by};
  return shape;
}

// By four or five voxels.
TEST_F(OtherShape, IsThatOfOneMuchSmallerOrLarger) {
  const RoadUserShape longer{{{{-0.85, -0.2, -0.9}, {1.25, 0.2, 0.85}}}};
  const RoadUserShape car{{{{-2.2, -0.8, -1.5}, {2.2, 0.8, -0.2}}}};
  const RoadUserShape hatchback{{{{-1.8, -0.8, -1.5}, {2.2, 0.8, -0.2}}}};
  using Pair = std::pair<RoadUserShape, RoadUserShape>;
  for (const auto& [lost, young] : {Pair{kPedestrian, kChild},
                                    {kChild, kPedestrian},
                                    {kBox, longer},
                                    {longer, kBox},
                                    {car, hatchback},
                                    {hatchback, car},
                                    {CarWithRoofAt(-0.2), CarWithRoofAt(0.2)},
                                    {CarWithRoofAt(0.2), CarWithRoofAt(-0.2)}}) {
    BeginAnew();
    LoseAndSee(lost, young);
    EXPECT_FALSE(Same(1, 2)) << lost.boxes_B[0].max << young.boxes_B[0].max;
    BeginAnew();
    LoseAndSee(lost, lost);
    EXPECT_TRUE(Same(1, 2)) << lost.boxes_B[0].max;
  }
}

// Rays pass just above a flat roof, within the voxels that it lies in.
TEST_F(OtherShape, IsNotThatOfOneWhoseRoofRaysGraze) {
  for (int height_cm = -20; height_cm <= 10; height_cm += 2) {
    BeginAnew();
    const RoadUserShape car = CarWithRoofAt(0.01 * height_cm);
    unseen_faces_.clear();
    See(1, car, 0, 20);
    unseen_faces_ = {{0, 0, 1}, {0, 0, -1}, {0, 1, 0}};
    See(2, car, 30, 50);
    EXPECT_TRUE(Same(1, 2)) << height_cm;
  }
}

// Of a trolley with a handle at its rear, what it carries would fill what rays passed over it.
TEST_F(OtherShape, IsThatOfOneWhoFillsItsGaps) {
  LoseAndSee(kTrolley, kCrate);
  EXPECT_FALSE(Same(1, 2));
  BeginAnew();
  LoseAndSee(kTrolley, kTrolley);
  EXPECT_TRUE(Same(1, 2));
}

// What lies behind comes in sight when the lost one has been known for long.
TEST_F(OtherShape, IsToldByWhatWasSeenLate) {
  const RoadUserShape chest{{{{-0.6, -0.3, -0.9}, {0.6, 0.3, 0}}}};
  RoadUserShape loaded = chest;
  loaded.boxes_B.push_back({{-0.1, -0.3, 0}, {0.1, 0.3, 0.3}});
  sky_until_ = 25;
  ahead_m_ = -3;
  See(1, chest, 0, 45);
  See(2, loaded, 55, 75);
  EXPECT_FALSE(Same(1, 2));
  BeginAnew();
  See(1, chest, 0, 45);
  See(2, chest, 55, 75);
  EXPECT_TRUE(Same(1, 2));
}

// What stands higher is no other view of what stood on the ground.
TEST_F(OtherShape, IsThatOfOneWhoStandsHigher) {
  LoseAndSee(kPedestrian, Raised(kPedestrian, 0.3));
  EXPECT_FALSE(Same(1, 2));
}

// Either alone is tolerated: that much higher, or without the load that the lost one had.
TEST_F(OtherShape, IsToldByDoubtsThatAddUp) {
  RoadUserShape loaded = kTrolley;
  loaded.boxes_B.push_back({{-0.5, -0.3, -0.3}, {0, 0.3, 0}});
  const RoadUserShape raised = Raised(kTrolley, 0.2);
  LoseAndSee(loaded, kTrolley);
  EXPECT_TRUE(Same(1, 2));
  BeginAnew();
  LoseAndSee(kTrolley, raised);
  EXPECT_TRUE(Same(1, 2));
  BeginAnew();
  LoseAndSee(loaded, raised);
  EXPECT_FALSE(Same(1, 2));
}

// What is between beams that are wide apart may be another's: so nobody is known by them, wherever
// the frame is that the source tells their rays in.
TEST_F(OtherShape, IsNotToldByFewBeams) {
  struct Case {
    RoadUserShape lost, young;
    double beams_apart_deg;
    bool is_known;
  };
  const RoadUserShape raised = Raised(kPedestrian, 0.3);
  for (const auto& [lost, young, beams_apart_deg, is_known] :
       {Case{raised, kPedestrian, 0.4, false}, Case{raised, kPedestrian, 3, false},
        Case{kPedestrian, kPedestrian, 0.4, true}, Case{kPedestrian, kPedestrian, 3, false}}) {
    for (const double origins_off_m : {0, 30}) {
      BeginAnew();
      beams_apart_deg_ = beams_apart_deg;
      origins_off_m_ = origins_off_m;
      LoseAndSee(lost, young);
      EXPECT_EQ(Same(1, 2), is_known)
          << lost.boxes_B[0].max << beams_apart_deg << ' ' << origins_off_m;
    }
  }
}

// The beams of one sensor are 0.05 m apart nearby, and 0.26 m far off: nothing is told of what lies
// between, nor of whoever else might.
TEST_F(OtherShape, IsNotToldWhereBeamsMissHeights) {
  beams_reach_deg_ = 0.1;
  const auto is_known = [&](double farther_x, double beams_apart_deg) {
    BeginAnew();
    farther_x_ = farther_x;
    beams_apart_deg_ = beams_apart_deg;
    LoseAndSee(kPedestrian, kPedestrian);
    return Same(1, 2);
  };
  EXPECT_TRUE(is_known(1, 0.5));
  EXPECT_FALSE(is_known(5, 0.5));
  EXPECT_TRUE(is_known(5, 0.2));
}

TEST_F(OtherShape, IsToldByManyBeamsThoughARailHidesSomeHeights) {
  See(1, kPedestrian, 0, 20);
  rail_m_ = 0;
  See(2, kPedestrian, 30, 50);
  EXPECT_TRUE(Same(1, 2));
}

// Voxels of a column of four by four, from the lowest of its layers to the highest.
MovingObject Column(int lowest, int highest) {
  ThreadPool pool(1);
  ScanUpdate update;
  for (int z = lowest; z <= highest; ++z) {
    for (int x = 0; x < 4; ++x) {
      for (int y = 0; y < 4; ++y) update.MarkHit({x, y, z});
    }
  }
  VoxelMap map_O(0.1);
  map_O.Update(update, pool);
  return WithMap({}, std::move(map_O));
}

// The other one's top is layer 11, and what touches that may be a part of it.
double ShareOfColumnSeenThrough(int highest, const std::vector<int>& passed_layers) {
  ThreadPool pool(1);
  ScanUpdate update;
  for (const int z : passed_layers) {
    for (int x = 0; x < 4; ++x) {
      for (int y = 0; y < 4; ++y) update.MarkFree({x, y, z});
    }
  }
  VoxelMap around_P(0.1);
  around_P.Update(update, pool);
  return ShareSeenThrough(Column(0, highest), Column(0, 11), {}, around_P);
}

TEST(ShareSeenThroughTest, IsAllOfWhatEndsBetweenRowsThatPassed) {
  EXPECT_EQ(ShareOfColumnSeenThrough(16, {}), 0);
  EXPECT_EQ(ShareOfColumnSeenThrough(16, {16}), 1);
  EXPECT_EQ(ShareOfColumnSeenThrough(16, {14}), 1);
  EXPECT_EQ(ShareOfColumnSeenThrough(15, {13}), 1);
  EXPECT_EQ(ShareOfColumnSeenThrough(14, {13, 14}), 1);
  EXPECT_LT(ShareOfColumnSeenThrough(14, {14}), 1);  // may be off by two
  EXPECT_LT(ShareOfColumnSeenThrough(13, {13}), 1);
}

}  // namespace
}  // namespace clearway
