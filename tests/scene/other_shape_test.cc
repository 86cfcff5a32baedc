// Nobody is known again as one that is clearly larger or smaller.
#include <gtest/gtest.h>

#include <utility>

#include "scene/seen_through.h"

namespace clearway {
namespace {

using OtherShape = SeenThrough;

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
                                    {hatchback, car}}) {
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

}  // namespace
}  // namespace clearway
