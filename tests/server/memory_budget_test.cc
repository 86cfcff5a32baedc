#include "server/memory_budget.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <optional>
#include <vector>

#include "clearway/map/voxel_map.h"
#include "server/memory_use.h"
#include "wire/status.h"

namespace clearway {
namespace {

using testing::HasSubstr;

TEST(MemoryLimit, IsAtMostHalfOfTheMachines) {
  const auto machine = static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
                       static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  EXPECT_GT(DefaultMemoryLimit(), std::uint64_t{1} << 20);
  EXPECT_LE(DefaultMemoryLimit(), machine / 2);
}

TEST(MemoryLimit, TellsWhatIsUsedAndWanted) {
  const absl::Status full = MemoryBudget(1000).Room(77);
  EXPECT_TRUE(absl::IsResourceExhausted(full));
  EXPECT_EQ(ReasonOf(full), "NO_MEMORY");
  EXPECT_THAT(full.message(), HasSubstr("would need 77 more; limits.max_memory_bytes is 1000"));
  EXPECT_TRUE(MemoryBudget(std::uint64_t{1} << 50).Room(77).ok());
}

// Whatever waits for maps to come counts as free.
TEST(MemoryLimit, MapsCountWhileTheyLive) {
  constexpr std::uint64_t kMap = 20'000'000;  // 20,000 blocks take more
  const MemoryBudget dut(CurrentMemoryUse().heap_bytes_in_use + kMap);
  EXPECT_TRUE(dut.Room().ok());
  {
    VoxelMap map(0.1);
    for (int x = 0; x < 20'000; ++x) map.Set({8 * x, 0, 0}, 100);
    EXPECT_TRUE(absl::IsResourceExhausted(dut.Room()));
  }
  EXPECT_TRUE(dut.Room().ok());
}

TEST(GivenBackMemory, IsTheSystemsAgain) {
  constexpr std::uint64_t kMap = 60'000'000;
  std::vector<VoxelMap> maps(1, VoxelMap(0.1));
  for (int x = 0; x < 50'000; ++x) maps[0].Set({8 * x, 0, 0}, 100);
  const std::uint64_t with = CurrentMemoryUse().resident_bytes;
  maps.clear();
  GiveMemoryBack();
#if !defined(__SANITIZE_ADDRESS__)
  EXPECT_LT(CurrentMemoryUse().resident_bytes + kMap, with);
#endif
}

TEST(RequestMemory, SharesEndWithTheirRequests) {
  RequestMemory dut(100);
  std::optional<RequestMemory::Share> first(dut.Take(60));
  ASSERT_TRUE(first->status().ok());
  const RequestMemory::Share refused = dut.Take(41);
  EXPECT_TRUE(absl::IsResourceExhausted(refused.status()));
  EXPECT_EQ(ReasonOf(refused.status()), "NO_MEMORY");
  EXPECT_THAT(refused.status().message(),
              HasSubstr("take 60 bytes, and this one 41 more; limits.max_request_memory_bytes is"));
  EXPECT_TRUE(dut.Take(40).status().ok());
  RequestMemory::Share moved = std::move(*first);
  first.reset();
  EXPECT_FALSE(dut.Take(41).status().ok());
  moved = RequestMemory::Share();
  EXPECT_TRUE(dut.Take(100).status().ok());
}

}  // namespace
}  // namespace clearway
