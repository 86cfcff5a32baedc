// Shares of unknown space, against a look at every voxel of the map.
#include "collision/unknown_share.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>

#include "collision/test_meshes.h"
#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

constexpr std::int32_t kHalf = 24;  // voxels to each side

const Cancelled kNever = [] { return false; };

// Of voxels in a cube; those left out lie in a few boxes and here and there.
VoxelMap MapWithGaps(Random& random, double observed_share) {
  VoxelMap map(0.1);
  for (std::int32_t x = -kHalf; x < kHalf; ++x) {
    for (std::int32_t y = -kHalf; y < kHalf; ++y) {
      for (std::int32_t z = -kHalf; z < kHalf; ++z) {
        if (random.Uniform(0, 1) < observed_share) {
          map.Set({x, y, z}, random.Integer(0, 3) == 0 ? 100 : -100);
        }
      }
    }
  }
  return map;
}

class PlacedShapes {
 public:
  void Add(const Shape& shape, const Pose& pose) {
    geometries_.emplace_back(shape);
    shapes_.emplace_back(geometries_.back(), pose);
  }
  std::vector<const PlacedShape*> all() const {
    std::vector<const PlacedShape*> all;
    for (const PlacedShape& shape : shapes_) all.push_back(&shape);
    return all;
  }

 private:
  std::deque<ShapeGeometry> geometries_;
  std::deque<PlacedShape> shapes_;
};

double BruteShare(const VoxelMap& map, const std::vector<Aabb>& known_free,
                  const std::vector<const PlacedShape*>& shapes) {
  int all = 0, unknown = 0;
  for (std::int32_t x = -2 * kHalf; x < 2 * kHalf; ++x) {
    for (std::int32_t y = -2 * kHalf; y < 2 * kHalf; ++y) {
      for (std::int32_t z = -2 * kHalf; z < 2 * kHalf; ++z) {
        const Eigen::Vector3d center = map.grid().CenterOf({x, y, z});
        const auto holds = [&](const auto* shape) { return shape->Contains(center); };
        if (std::none_of(shapes.begin(), shapes.end(), holds)) continue;
        ++all;
        unknown += map.State({x, y, z}) == VoxelState::kUnknown && !InOneOf(known_free, center);
      }
    }
  }
  return static_cast<double>(unknown) / all;
}

Shape AnyShape(Random& random) {
  switch (random.Integer(0, 3)) {
    case 0:
      return Sphere{random.Uniform(0.2, 1)};
    case 1:
      return Capsule{random.Uniform(0.2, 0.5), random.Uniform(0.1, 1)};
    case 2:
      return Cylinder{random.Uniform(0.2, 0.5), random.Uniform(0.1, 1)};
    default:
      return Box{random.Vector(0.8).cwiseAbs().array() + 0.2};
  }
}

// Shapes that overlap each other, and that reach beyond what was observed.
TEST(UnknownShare, IsThatOfAllVoxelsWithTheirCentresInside) {
  Random random(1);
  int between = 0;
  for (int i = 0; i < 12; ++i) {
    const VoxelMap map = MapWithGaps(random, i % 3 == 0 ? 1 : random.Uniform(0.5, 1));
    PlacedShapes shapes;
    for (int k = random.Integer(1, 3); k > 0; --k) {
      shapes.Add(AnyShape(random), random.AnyPose(i % 2 == 0 ? 1 : 2.2));
    }
    const Eigen::Vector3d corner = random.Vector(1);
    const std::vector<Aabb> known_free{{corner, corner + Eigen::Vector3d::Constant(1)}};
    const double dut = UnknownShareOf(map, known_free, shapes.all(), kNever);
    EXPECT_DOUBLE_EQ(dut, BruteShare(map, known_free, shapes.all())) << i;
    between += dut > 0 && dut < 1;
  }
  EXPECT_GE(between, 6);
}

// Too small to hold the centre of a voxel: the voxels of the shapes' centres are asked.
TEST(UnknownShare, OfASmallRobotIsThatOfItsVoxels) {
  VoxelMap map(0.1);
  map.Set({0, 0, 0}, -100);
  PlacedShapes shapes;
  shapes.Add(Sphere{0.01}, Pose::Translation(0.02, 0.02, 0.02));
  EXPECT_EQ(UnknownShareOf(map, {}, shapes.all(), kNever), 0);
  shapes.Add(Sphere{0.01}, Pose::Translation(0.12, 0.02, 0.02));
  EXPECT_EQ(UnknownShareOf(map, {}, shapes.all(), kNever), 0.5);
  shapes.Add(Sphere{0.01}, Pose::Translation(0.17, 0.08, 0.08));  // the same voxel again
  EXPECT_EQ(UnknownShareOf(map, {}, shapes.all(), kNever), 0.5);
  const Aabb beside{{0.1, 0, 0}, {0.2, 0.1, 0.1}};
  EXPECT_EQ(UnknownShareOf(map, {beside}, shapes.all(), kNever), 0);
}

// Shapes that move and turn within their margins, and some that overlap.
TEST(MostUnknownShare, HoldsWhereverTheShapesAre) {
  Random random(2);
  int tight = 0, useful = 0;
  for (int i = 0; i < 60; ++i) {
    const VoxelMap map = MapWithGaps(random, random.Uniform(0.5, 1));
    const double margin_m = i % 3 == 0 ? 0 : random.Uniform(0, 0.1);
    const Eigen::Vector3d corner = random.Vector(1);
    const std::vector<Aabb> known_free{{corner, corner + Eigen::Vector3d::Constant(1)}};
    std::deque<ShapeGeometry> geometries;
    std::vector<Sweep> loose;
    std::vector<Pose> places;
    std::vector<Eigen::Vector3d> ways;
    for (int k = random.Integer(1, 3); k > 0; --k) {
      geometries.emplace_back(AnyShape(random));
      places.push_back(random.AnyPose(0.8));
      ways.push_back(i % 2 == 0 ? Eigen::Vector3d::Zero() : random.Vector(0.3));
      loose.push_back({PlacedShape(geometries.back(), places.back()), ways.back(), margin_m});
    }
    const double dut = MostUnknownShareOf(map, known_free, loose, kNever);
    useful += dut < 1;
    for (int j = 0; j < 20; ++j) {
      PlacedShapes moved;
      const double along = random.Uniform(0, 1);
      for (std::size_t s = 0; s < places.size(); ++s) {
        const double radius_m = geometries[s].box_G().Size().norm() / 2;
        const double angle_rad = 0.5 * margin_m / radius_m;
        const Eigen::AngleAxisd turn(random.Uniform(-angle_rad, angle_rad), random.UnitVector());
        const Eigen::Vector3d way = random.Uniform(0, 0.5) * margin_m * random.UnitVector();
        moved.Add(geometries[s].shape(),
                  {places[s].rotation * turn, places[s].translation + along * ways[s] + way});
      }
      const double share = UnknownShareOf(map, known_free, moved.all(), kNever);
      ASSERT_LE(share, dut + 1e-12) << i;
      tight += margin_m == 0 && ways[0].isZero() && share > 0.98 * dut;
    }
  }
  EXPECT_GT(useful, 40);
  EXPECT_GT(tight, 100);
}

// No centre of a voxel lies within its margin, while the voxel of its own centre is known.
TEST(MostUnknownShare, OfASmallRobotIsThatOfTheVoxelsThatItsCentreMayBeIn) {
  VoxelMap map(0.1);
  map.Set({0, 0, 0}, -100);
  const ShapeGeometry ball{Sphere{0.01}};
  const auto most_from = [&](double x, double way_x, const std::vector<Aabb>& known_free) {
    const PlacedShape there(ball, Pose::Translation(x, 0.02, 0.02));
    return MostUnknownShareOf(map, known_free, {{there, {way_x, 0, 0}, 0.005}}, kNever);
  };
  EXPECT_EQ(most_from(0.02, 0, {}), 0);
  EXPECT_EQ(most_from(0.02, 0.07, {}), 0);
  EXPECT_EQ(most_from(0.02, 0.08, {}), 1);
  EXPECT_EQ(most_from(0.02, 0.08, {{{0.1, 0, 0}, {0.2, 0.1, 0.1}}}), 0);
}

// Also close to its surface, where its grid of distances does not tell.
TEST(MostUnknownShare, OfAMeshThatStandsIsItsShare) {
  Random random(3);
  const Mesh ball = BallMesh(6, 9, [](const Eigen::Vector3d&) { return 0.5; });
  const ShapeGeometry geometry{TriangleMesh{std::make_shared<const Mesh>(ball)}};
  for (int i = 0; i < 10; ++i) {
    const VoxelMap map = MapWithGaps(random, 0.7);
    const PlacedShape placed(geometry, random.AnyPose(1));
    const double dut = MostUnknownShareOf(map, {}, {{placed, Eigen::Vector3d::Zero(), 0}}, kNever);
    EXPECT_EQ(dut, UnknownShareOf(map, {}, {&placed}, kNever)) << i;
  }
}

TEST(UnknownShare, EndsWhenNobodyWaits) {
  const VoxelMap map(0.1);
  PlacedShapes shapes;
  shapes.Add(Sphere{3}, Pose{});
  int asked = 0;
  UnknownShareOf(map, {}, shapes.all(), [&] { return ++asked > 0; });
  EXPECT_LE(asked, 2);
}

}  // namespace
}  // namespace clearway
