// Against VoxelMap::State.
#include "clearway/map/voxel_reader.h"

#include <gtest/gtest.h>

#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

VoxelMap RandomMap(Random& random) {
  VoxelMap map(0.1);
  for (int i = 0; i < 30'000; ++i) {
    map.Set(map.grid().KeyOf(random.Vector(3)), static_cast<LogOdds>(random.Integer(-100, 100)));
  }
  return map;
}

TEST(VoxelReader, Empty) {
  const VoxelMap map(0.1);
  VoxelReader dut(map);
  dut.States({}, {});
  const std::vector<Eigen::Vector3d> points(3, {1e5, -1e5, 0});
  std::vector<VoxelState> states(3, VoxelState::kOccupied);
  dut.States(points, states);
  EXPECT_EQ(states, std::vector<VoxelState>(3, VoxelState::kUnknown));
}

TEST(VoxelReader, AgreesWithTheMap) {
  Random random(1);
  const VoxelMap map = RandomMap(random);
  VoxelReader dut(map);
  std::array<int, 3> seen{};
  for (const std::size_t size : {1u, 2u, 255u, 511u, 512u, 513u, 5000u}) {
    for (const double step_m : {0.0, 0.03, 10.0}) {  // one voxel, a line, anywhere
      std::vector<Eigen::Vector3d> points{random.Vector(4)};
      while (points.size() < size) {
        points.push_back(step_m > 1 || points.size() % 100 == 0
                             ? random.Vector(4)
                             : points.back() + Eigen::Vector3d::Constant(step_m));
      }
      std::vector<VoxelState> states(size);
      dut.States(points, states);
      for (std::size_t i = 0; i < size; ++i) {
        ASSERT_EQ(states[i], map.State(map.grid().KeyOf(points[i]))) << i << " of " << size;
        ++seen[static_cast<int>(states[i])];
      }
    }
  }
  for (const int count : seen) EXPECT_GT(count, 100);
}

TEST(VoxelGrid, ManyKeysAreThoseOfEachPoint) {
  Random random(2);
  for (const double resolution_m : {0.05, 0.1, 0.3}) {
    const VoxelGrid dut(resolution_m);
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 1000; ++i) {
      points.push_back(random.Vector(i % 3 == 0 ? 1e4 : 5));
      if (i % 2 == 0) points.back() = resolution_m * points.back().array().round();  // on borders
    }
    std::vector<VoxelKey> keys(points.size());
    dut.KeysOf(points, keys.data());
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_EQ(keys[i], dut.KeyOf(points[i]));
      for (int axis = 0; axis < 3; ++axis) {
        const std::int32_t index = axis == 0 ? keys[i].x : axis == 1 ? keys[i].y : keys[i].z;
        EXPECT_EQ(index, std::floor(1 / resolution_m * points[i][axis]));
      }
    }
    std::vector<Eigen::Vector3f> in_single;
    for (const Eigen::Vector3d& p : points) in_single.push_back(p.cast<float>());
    dut.KeysOf(in_single, keys.data());
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_EQ(keys[i], dut.KeyOf(in_single[i].cast<double>()));
    }
  }
}

}  // namespace
}  // namespace clearway
