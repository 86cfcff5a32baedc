#include "clearway/base/thread_pool.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

namespace clearway {
namespace {

class ThreadPoolTest : public testing::TestWithParam<int> {};

TEST_P(ThreadPoolTest, Empty) {
  ThreadPool dut(GetParam());
  dut.ParallelFor(0, [](int, std::size_t, std::size_t) { FAIL() << "nothing to do"; });
}

TEST_P(ThreadPoolTest, VisitsEachIndexOnce) {
  ThreadPool dut(GetParam());
  for (std::size_t size : {1u, 2u, 3u, 1000u}) {
    std::vector<std::atomic<int>> visits(size);
    dut.ParallelFor(size, [&](int, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) ++visits[i];
    });
    for (const auto& count : visits) EXPECT_EQ(count, 1);
  }
}

TEST_P(ThreadPoolTest, CutsByWorkerAlone) {
  ThreadPool dut(GetParam());
  std::vector<std::size_t> begins(GetParam(), 999);
  dut.ParallelFor(100, [&](int worker, std::size_t begin, std::size_t) { begins[worker] = begin; });
  for (int worker = 0; worker < GetParam(); ++worker) {
    EXPECT_EQ(begins[worker], 100u * worker / GetParam());
  }
}

TEST_P(ThreadPoolTest, ChunksHoldEachIndexOnce) {
  ThreadPool dut(GetParam());
  for (std::size_t size : {0u, 1u, 10u, 1000u, 1003u}) {
    std::vector<std::atomic<int>> visits(size);
    dut.ParallelChunks(size, 10, [&](int worker, std::size_t begin, std::size_t end) {
      EXPECT_LT(worker, GetParam());
      EXPECT_TRUE(begin % 10 == 0 && begin < end && end <= begin + 10);
      for (std::size_t i = begin; i < end; ++i) ++visits[i];
    });
    for (const auto& count : visits) EXPECT_EQ(count, 1);
  }
}

TEST_P(ThreadPoolTest, RunsTheFirstShareInTheCaller) {
  ThreadPool dut(GetParam());
  std::thread::id first;
  dut.ParallelFor(100, [&](int worker, std::size_t, std::size_t) {
    if (worker == 0) first = std::this_thread::get_id();
  });
  EXPECT_EQ(first, std::this_thread::get_id());
}

TEST_P(ThreadPoolTest, ThrowsToItsCallerWhatABodyThrows) {
  ThreadPool dut(GetParam());
  for (int thrower = 0; thrower < GetParam(); ++thrower) {
    std::atomic<int> done = 0;
    const auto loop = [&] {
      dut.ParallelFor(100, [&](int worker, std::size_t, std::size_t) {
        if (worker == thrower) throw std::bad_alloc();
        ++done;
      });
    };
    EXPECT_THROW(loop(), std::bad_alloc);
    EXPECT_EQ(done, GetParam() - 1);
  }
  std::atomic<int> visits = 0;
  dut.ParallelChunks(100, 10, [&](int, std::size_t, std::size_t) { ++visits; });
  EXPECT_EQ(visits, 10);  // nothing is left of what was thrown
}

INSTANTIATE_TEST_SUITE_P(Threads, ThreadPoolTest, testing::Values(1, 2, 5));

}  // namespace
}  // namespace clearway
