#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "clearway/io/octomap_file.h"

namespace clearway {
namespace {

constexpr int kSide = 12;  // voxels that random maps have along each axis, on both sides of 0

VoxelMap RandomMap(double resolution_m, std::uint32_t seed) {
  std::mt19937 random(seed);
  VoxelMap map(resolution_m);
  for (int z = -kSide; z < kSide; ++z) {
    for (int y = -kSide; y < kSide; ++y) {
      for (int x = -kSide; x < kSide; ++x) {
        const auto draw = random() % 40;
        // Large parts are free, so that coarser voxels can be, too.
        if (draw == 0) map.Set({x, y, z}, map.model().clamp_max);
        if (draw > 1) map.Set({x, y, z}, map.model().clamp_min);
      }
    }
  }
  return map;
}

// From the definition: of every voxel of the input that overlaps the output voxel.
VoxelState BruteForce(const VoxelMap& map, double output_m, VoxelKey voxel) {
  const double input_m = map.grid().resolution_m();
  const double rounding_m = 1e-3 * std::min(input_m, output_m);
  bool all_free = true;
  const auto overlaps = [&](int input, int output) {
    const double begin = std::max(input * input_m, output * output_m);
    const double end = std::min((input + 1) * input_m, (output + 1) * output_m);
    return end - begin > rounding_m;
  };
  const int reach = 2 + static_cast<int>(output_m / input_m);
  const auto first = [&](int output) {
    return static_cast<int>(std::floor(output * output_m / input_m)) - 1;
  };
  for (int z = first(voxel.z); z <= first(voxel.z) + 2 + reach; ++z) {
    for (int y = first(voxel.y); y <= first(voxel.y) + 2 + reach; ++y) {
      for (int x = first(voxel.x); x <= first(voxel.x) + 2 + reach; ++x) {
        if (!overlaps(x, voxel.x) || !overlaps(y, voxel.y) || !overlaps(z, voxel.z)) continue;
        const VoxelState state = map.State({x, y, z});
        if (state == VoxelState::kOccupied) return state;
        all_free &= state == VoxelState::kFree;
      }
    }
  }
  return all_free ? VoxelState::kFree : VoxelState::kUnknown;
}

TEST(Resample, EqualsBruteForce) {
  constexpr double kInput_m = 0.1;
  for (const double output_m : {0.1, 0.05, 0.2, 0.3, 0.07, 0.15, 0.1 / 3, 0.23, 0.4}) {
    const VoxelMap map = RandomMap(kInput_m, 7);
    const auto dut = Resample(map, output_m);
    ASSERT_TRUE(dut.ok()) << dut.status();
    EXPECT_EQ(dut->grid().resolution_m(), output_m);
    const int side = static_cast<int>(kSide * kInput_m / output_m) + 2;
    int counts[3] = {};
    for (int z = -side; z <= side; ++z) {
      for (int y = -side; y <= side; ++y) {
        for (int x = -side; x <= side; ++x) {
          const VoxelState expected = BruteForce(map, output_m, {x, y, z});
          ++counts[static_cast<int>(expected)];
          ASSERT_EQ(dut->State({x, y, z}), expected)
              << output_m << " at " << x << " " << y << " " << z;
        }
      }
    }
    for (const int count : counts) EXPECT_GT(count, 0) << output_m;
  }
}

TEST(Resample, TakesTheModelsClamps) {
  VoxelMap map(0.1);
  map.Set({0, 0, 0}, map.model().occupied);
  map.Set({1, 0, 0}, -1);
  const auto dut = Resample(map, 0.05);
  ASSERT_TRUE(dut.ok());
  EXPECT_EQ(dut->Find({1, 1, 1}), map.model().clamp_max);
  EXPECT_EQ(dut->Find({3, 1, 1}), map.model().clamp_min);
}

TEST(Resample, RefusesSizesAndMapsThatAreTooLarge) {
  VoxelMap map(0.1);
  map.Set({0, 0, 0}, map.model().clamp_max);
  for (const double bad : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    EXPECT_EQ(Resample(map, bad).status().code(), absl::StatusCode::kInvalidArgument) << bad;
  }
  EXPECT_EQ(Resample(map, 1e-4).status().code(), absl::StatusCode::kResourceExhausted);
  EXPECT_EQ(Resample(map, 0.001, 1000).status().code(), absl::StatusCode::kResourceExhausted);
  map.Set({kMaxVoxelIndex - 1, 0, 0}, map.model().clamp_max);
  EXPECT_EQ(Resample(map, 0.01).status().code(), absl::StatusCode::kOutOfRange);
}

// In a file these are a few leaves.
TEST(Resample, NamesTheNumberOfVoxelsBeforeItMakesThem) {
  VoxelMap map(10);
  for (int i = 0; i < 4'096; ++i) {
    map.Set({i % 16, i / 16 % 16, i / 256}, map.model().clamp_min);
  }
  const auto dut = Resample(map, 0.1);
  EXPECT_EQ(dut.status().code(), absl::StatusCode::kResourceExhausted);
  EXPECT_EQ(dut.status().message(),
            "in voxels of 0.1 m it would have about 4096000000 voxels; the limit is 134217728");
}

TEST(Resample, TakesMapsUpToTheLimit) {
  VoxelMap map(0.2);
  VoxelBlock full;
  for (int i = 0; i < kVoxelsPerBlock; ++i) full.Set(i, map.model().clamp_min, map.model());
  for (int i = 0; i < 8; ++i) map.PutBlock({i % 2, i / 2 % 2, i / 4}, full);
  constexpr std::int64_t kVoxels = 64 * kVoxelsPerBlock;
  const auto dut = Resample(map, 0.1, kVoxels);
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->observed_count(), kVoxels);
  EXPECT_FALSE(Resample(map, 0.1, kVoxels - 1).ok());
  EXPECT_GT(kMaxResampledVoxels, 100 * 100 * 10 * 1'000);  // 100 m x 100 m x 10 m in 0.1 m
}

}  // namespace
}  // namespace clearway
