// Sweeps of turning shapes against the shapes at many times.
#include "collision/moving_part.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "collision/random_world.h"
#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

// How far a placed shape reaches in a direction.
double ReachOf(const PlacedShape& shape, const Eigen::Vector3d& direction) {
  return direction.dot(shape.FarthestOfCore(direction)) + shape.geometry().core_radius_m();
}

Pose AnyPose(Random& random) { return random.AnyPose(1); }

// A shape of a link that turns, on a leg of a second.
struct Moving {
  Moving(RandomWorld& world, Random& random, int i)
      : part{ShapeGeometry(world.ShapeOfKind(i % std::variant_size_v<Shape>)), std::nullopt},
        from(AnyPose(random)),
        to(AnyPose(random)) {
    if (i % 2 == 0) part.T_L_G = AnyPose(random);
    const auto& shape = part.geometry.shape();
    // Cylinders and capsules about their own axes, or nearly so.
    if (i % 3 == 0 &&
        (std::holds_alternative<Cylinder>(shape) || std::holds_alternative<Capsule>(shape))) {
      const Eigen::Vector3d axis_G =
          Eigen::Vector3d::UnitZ() + random.Uniform(0, 0.1) * random.UnitVector();
      const Eigen::Vector3d axis_L = part.T_L_G.value_or(Pose{}).rotation * axis_G.normalized();
      to.rotation = from.rotation * Eigen::AngleAxisd(random.Uniform(0, 3), axis_L);
    }
  }
  RobotGeometry::Part part;
  Pose from, to;
};

// At any time of a span the shape lies within the sweep where that is then, by the reach of both.
template <class SeenAt>
void ExpectWithin(const Sweep& sweep, const TimeSpan& span, Random& random, SeenAt&& shape_at) {
  for (int look = 0; look < 30; ++look) {
    const double share = look == 0 ? 0 : look == 1 ? 1 : random.Uniform(0, 1);
    const Time t = span.At(share);
    const double exact = ToSeconds(t - span.from) / span.seconds();
    const PlacedShape shape = shape_at(t);
    for (int d = 0; d < 20; ++d) {
      const Eigen::Vector3d direction = d < 3 ? Eigen::Vector3d::Unit(d) : random.UnitVector();
      const double reach_m = ReachOf(sweep.shape_F, direction) +
                             exact * direction.dot(sweep.way_F) + sweep.margin_m +
                             sweep.spread_F.Along(direction);
      EXPECT_LE(ReachOf(shape, direction), reach_m + 1e-9);
    }
  }
}

TEST(MovingPart, SweepsInTheWorldHoldTheShape) {
  RandomWorld world(1);
  Random random(1);
  for (int i = 0; i < 600 && !testing::Test::HasFailure(); ++i) {
    const Moving moving(world, random, i);
    const LinkMotion motion(moving.from, moving.to, 1);
    const TimeSpan leg{Time(), Time() + FromSeconds(1)};
    const MovingPart dut(0, motion, leg, moving.part, 0);
    const double begin = random.Uniform(0, 0.9);
    const TimeSpan span{leg.At(begin), leg.At(begin + random.Uniform(0.01, 1 - begin))};
    const auto [sweep, slack_m] = dut.InWorld(dut.During(span), 0);
    ExpectWithin(sweep, span, random, [&](Time t) {
      const Pose T_W_L = motion.At(ToSeconds(t - leg.from));
      return PlacedShape(moving.part.geometry, T_W_L * moving.part.T_L_G.value_or(Pose{}));
    });
    EXPECT_GE(slack_m, sweep.margin_m + sweep.spread_F.radius_m() - 1e-12);
  }
}

TEST(MovingPart, SweepsAsSeenFromAnObjectHoldTheShape) {
  RandomWorld world(2);
  Random random(2);
  for (int i = 0; i < 600 && !testing::Test::HasFailure(); ++i) {
    const Moving moving(world, random, i);
    const LinkMotion motion(moving.from, moving.to, 1);
    const TimeSpan leg{Time(), Time() + FromSeconds(1)};
    const MovingPart dut(0, motion, leg, moving.part, 0);
    ObjectPiece object;
    object.start = leg.from - FromSeconds(random.Uniform(0, 1));
    object.until = leg.until;
    object.T_W_O = AnyPose(random);
    object.velocity_O = {random.Vector(2), random.Vector(2)};
    if (i % 5 == 0) {  // about the same axis as the link
      const Pose T_O_W = Inverse(object.At(leg.from));
      object.velocity_O.angular = T_O_W.rotation * motion.AxisInW();
    }
    const double begin = random.Uniform(0, 0.9);
    const TimeSpan span{leg.At(begin), leg.At(begin + random.Uniform(0.01, 1 - begin))};
    const auto [sweep, slack_m] = dut.InObject(dut.During(span), object, 0);
    ExpectWithin(sweep, span, random, [&](Time t) {
      const Pose T_W_L = motion.At(ToSeconds(t - leg.from));
      return PlacedShape(moving.part.geometry,
                         Inverse(object.At(t)) * T_W_L * moving.part.T_L_G.value_or(Pose{}));
    });
  }
}

TEST(MovingPart, ATurnAboutANormalTakesNothingNearer) {
  const Pose turned{Eigen::Quaterniond(Eigen::AngleAxisd(3, Eigen::Vector3d::UnitZ())), {1, 0, 0}};
  const LinkMotion motion(Pose{}, turned, 1);
  const TimeSpan leg{Time(), Time() + FromSeconds(1)};
  RandomWorld world(3);
  for (std::size_t kind = 0; kind < std::variant_size_v<Shape>; ++kind) {
    const RobotGeometry::Part part{ShapeGeometry(world.ShapeOfKind(kind)), std::nullopt};
    const MovingPart dut(0, motion, leg, part, 0);
    const Sweep sweep = dut.InWorld(dut.During(leg), 0).sweep;
    EXPECT_LT(sweep.margin_m + sweep.spread_F.Along(Eigen::Vector3d::UnitZ()), 1e-12) << kind;
  }
  // A round robot turns in place for as long as it likes.
  const RobotGeometry::Part round{ShapeGeometry(Cylinder{0.3, 1}), std::nullopt};
  const MovingPart dut(0, motion, leg, round, 0);
  EXPECT_LT(dut.InWorld(dut.During(leg), 0).slack_m, 1e-12);
}

TEST(BoundOfTurn, HoldsForTurnsAboutAnyAxis) {
  RandomWorld world(4);
  Random random(4);
  for (int i = 0; i < 600 && !testing::Test::HasFailure(); ++i) {
    const ShapeGeometry geometry(world.ShapeOfKind(i % std::variant_size_v<Shape>));
    Eigen::Vector3d axis_G = random.UnitVector();
    if (i % 2 == 0) axis_G = (Eigen::Vector3d::UnitZ() + 0.05 * axis_G).normalized();
    const double off_rad = i % 4 < 2 ? 0 : random.Uniform(0, 0.3);
    const TurnBound bound = BoundOfTurn(geometry, axis_G, off_rad);
    Spread spread;
    const Eigen::Vector3d axis =
        Eigen::AngleAxisd(off_rad, axis_G.unitOrthogonal()) * axis_G;  // within what is uncertain
    const double angle_rad = random.Uniform(0, 0.5);
    spread.Add(axis, bound.across_m * angle_rad);
    const Eigen::Vector3d center = geometry.box_G().Center();
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle_rad, axis));
    const PlacedShape before(geometry, Pose{}), after(geometry, Pose{turn, center - turn * center});
    for (int d = 0; d < 50; ++d) {
      const Eigen::Vector3d direction = random.UnitVector();
      EXPECT_LE(ReachOf(after, direction), ReachOf(before, direction) + spread.Along(direction) +
                                               bound.any_m * angle_rad + 1e-9);
    }
  }
}

// The point of a disc that is farthest in a direction, by its rim.
Eigen::Vector3d Farthest(const Spread::Disc& disc, const Eigen::Vector3d& direction) {
  constexpr int kSteps = 4096;
  const Eigen::Vector3d out = disc.radius_m * disc.axis.unitOrthogonal();
  Eigen::Vector3d farthest = out;
  for (int i = 1; i < kSteps; ++i) {
    const Eigen::Vector3d p = Eigen::AngleAxisd(2 * EIGEN_PI * i / kSteps, disc.axis) * out;
    if (direction.dot(p) > direction.dot(farthest)) farthest = p;
  }
  return farthest;
}

TEST(Spread, ReachesAsFarAsItsFarthestPoint) {
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    Spread dut;
    dut.Add(random.UnitVector(), random.Uniform(0, 1));
    if (i % 2 == 0) dut.Add(random.UnitVector(), random.Uniform(0, 1));
    const Eigen::Vector3d direction = i % 3 == 0 ? random.UnitVector() : dut.discs()[0].axis;
    Eigen::Vector3d farthest = Eigen::Vector3d::Zero();
    for (const Spread::Disc& disc : dut.discs()) farthest += Farthest(disc, direction);
    EXPECT_NEAR(direction.dot(farthest), dut.Along(direction), 1e-5);
    EXPECT_LE(farthest.norm(), dut.radius_m() + 1e-12);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(dut.half_m()[axis], dut.Along(Eigen::Vector3d::Unit(axis)), 1e-12);
    }
    const Eigen::Quaterniond turn = random.AnyPose(1).rotation;
    EXPECT_NEAR(dut.Turned(turn.toRotationMatrix()).Along(turn * direction), dut.Along(direction),
                1e-12);
  }
}

// What is small is exact: a turn about a surface's normal takes no point nearer to it.
TEST(Spread, ReachesNowhereAlongItsAxis) {
  Random random(6);
  for (int i = 0; i < 1000; ++i) {
    Spread dut;
    dut.Add(random.UnitVector(), random.Uniform(0, 1));
    EXPECT_LE(dut.Along(dut.discs()[0].axis), 1e-16);
  }
}

}  // namespace
}  // namespace clearway
