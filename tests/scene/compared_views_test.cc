// Whether two views show one rigid body that moved as said.
#include "scene/compared_views.h"

#include <gtest/gtest.h>

#include <limits>

#include "clearway/geometry/aabb.h"
#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::AddPoint;
using testing_support::FrameAt;

constexpr ObjectId kLorry = 5;

struct Thing {
  Aabb box_W;
  ObjectId label = kStaticLabel;
};

// What a sensor at the origin sees of them, ahead to 0.8 rad on both sides.
LabelledCloud Scan(const std::vector<Thing>& things) {
  Frame frame = FrameAt(0);
  for (double azimuth_rad = -0.8; azimuth_rad < 0.8; azimuth_rad += 0.005) {
    for (double elevation_rad = -0.1; elevation_rad < 0.1; elevation_rad += 0.02) {
      const Eigen::Vector3d ray(100, 100 * std::tan(azimuth_rad), 100 * std::tan(elevation_rad));
      double nearest = 2;
      ObjectId label = kStaticLabel;
      for (const Thing& thing : things) {
        const auto [begin, end] = Clip(thing.box_W, Eigen::Vector3d::Zero(), ray, {0, 2});
        if (begin > end || begin >= nearest) continue;
        nearest = begin;
        label = thing.label;
      }
      if (nearest < 2) AddPoint(frame, label, nearest * ray);
    }
  }
  FrameReport report;
  return PlaceCloud(frame, {}, report);
}

// 6 m long, and as far along y as said; a wall far behind it.
std::vector<Thing> LorryAt(double y_m) {
  return {{{{15, y_m - 3, -1}, {17, y_m + 3, 1}}, kLorry}, {{{40, -60, -5}, {41, 60, 5}}}};
}

std::optional<Mismatch> Compared(const std::vector<Thing>& then, const std::vector<Thing>& now,
                                 double said_m, double bound_m = 0) {
  const LabelledCloud before = Scan(then), after = Scan(now);
  return MismatchOf({before, before.object_hits.at(kLorry)}, {after, after.object_hits.at(kLorry)},
                    Pose::Translation(0, said_m, 0), 0.5, bound_m, SceneParams{});
}

TEST(ComparedViews, MatchIfItMovedAsSaid) {
  EXPECT_FALSE(Compared(LorryAt(-4), LorryAt(-4), 0));
  EXPECT_FALSE(Compared(LorryAt(-4), LorryAt(1), 5));
  EXPECT_FALSE(Compared(LorryAt(-4), LorryAt(4), 8));
}

TEST(ComparedViews, DoNotIfItMovedByAMetreMore) {
  for (const double said_m : {0.0, 3.0, -2.0}) {
    const auto mismatch = Compared(LorryAt(-2), LorryAt(-2 + said_m + 2.5), said_m);
    ASSERT_TRUE(mismatch) << said_m;
    EXPECT_NEAR(mismatch->off_m, 2.5, 0.3);
    EXPECT_NEAR(mismatch->limit_m, 1 + 0.2 * std::abs(said_m), 1e-9);
    EXPECT_TRUE(Compared(LorryAt(-2), LorryAt(-2 + said_m - 2.5), said_m));
  }
  EXPECT_FALSE(Compared(LorryAt(-2), LorryAt(-1.1), 0));
}

TEST(ComparedViews, MatchWithinTheBound) {
  EXPECT_TRUE(Compared(LorryAt(-2), LorryAt(0.5), 0, 1));
  EXPECT_FALSE(Compared(LorryAt(-2), LorryAt(0.5), 0, 2));
}

TEST(ComparedViews, TellOfTheNearEndAlone) {
  const auto coming = [](double x_m) -> std::vector<Thing> {
    return {{{{x_m, -1, -1}, {x_m + 6, 1, 1}}, kLorry}};
  };
  const LabelledCloud before = Scan(coming(20)), after = Scan(coming(17));
  const ObjectView then{before, before.object_hits.at(kLorry)};
  const ObjectView now{after, after.object_hits.at(kLorry)};
  EXPECT_FALSE(MismatchOf(then, now, Pose::Translation(-3, 0, 0), 0.5, 0, {}));
  EXPECT_TRUE(MismatchOf(then, now, Pose(), 0.5, 0, {}));
  EXPECT_TRUE(MismatchOf(now, then, Pose(), 0.5, 0, {}));
}

// Of a lorry of 16 m, seen through a gap of 4 m: nobody can tell.
TEST(ComparedViews, OfOtherPartsMatch) {
  const auto behind_gap = [](double y_m) {
    std::vector<Thing> things = LorryAt(0);
    things[0].box_W = {{15, y_m - 8, -1}, {17, y_m + 8, 1}};
    things.push_back({{{7, -60, -5}, {7.2, -1, 5}}});
    things.push_back({{{7, 1, -5}, {7.2, 60, 5}}});
    return things;
  };
  EXPECT_FALSE(Compared(behind_gap(-4), behind_gap(4), 8));
  EXPECT_FALSE(Compared(behind_gap(-4), behind_gap(4), 0));
}

// Half of its points have lost their label, then the other half.
TEST(ComparedViews, OfPartsThatKeptTheirLabelsMatch) {
  const auto halves = [](ObjectId front, ObjectId rear) -> std::vector<Thing> {
    return {{{{15, -4, -1}, {17, 0, 1}}, front}, {{{15, 0, -1}, {17, 4, 1}}, rear}};
  };
  EXPECT_FALSE(Compared(halves(kLorry, kStaticLabel), halves(kStaticLabel, kLorry), 0));
}

}  // namespace
}  // namespace clearway
