#include "server/thread_priority.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>

namespace clearway {
namespace {

// Of the calling thread, as the kernel tells it; 0 before Linux 6.12.
std::uint64_t Turn_ns() {
  std::array<std::uint64_t, 8> attributes{};
  constexpr std::size_t kRuntime = 3;  // in sched_attr, in words of eight bytes
  EXPECT_EQ(syscall(SYS_sched_getattr, 0, attributes.data(), sizeof attributes, 0), 0);
  return attributes[kRuntime];
}

int Niceness() { return getpriority(PRIO_PROCESS, 0); }  // of the calling thread, on Linux

TEST(ThreadPriority, ShortTurnsPassToThreadsStartedLater) {
  std::thread([] {
    const std::uint64_t usual_ns = Turn_ns();
    if (usual_ns == 0) GTEST_SKIP() << "this kernel has no turns to choose";
    PreferShortTurns();
    EXPECT_LT(Turn_ns(), usual_ns);
    std::thread([&] { EXPECT_LT(Turn_ns(), usual_ns); }).join();
  }).join();
}

TEST(ThreadPriority, OneThreadAloneGivesWay) {
  const int before = Niceness();
  if (before + 2 > 19) GTEST_SKIP() << "this test itself hardly counts";
  std::thread([&] {
    GiveWay(before + 2);
    EXPECT_EQ(Niceness(), before + 2);
  }).join();
  EXPECT_EQ(Niceness(), before);
}

TEST(ThreadPriority, NeverGrowsMoreImportant) {
  std::thread([] {
    GiveWay(7);
    GiveWay(3);
    EXPECT_GE(Niceness(), 7);
  }).join();
}

std::atomic<int> alarms = 0;  // by which a thread was interrupted

// Computes until the thread was interrupted so often; false if that takes unduly long.
bool InterruptedTimes(int count) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (alarms < count && std::chrono::steady_clock::now() < end) {
  }
  return alarms >= count;
}

TEST(TurnAlarm, InterruptsItsThreadWhileItRuns) {
  struct sigaction count {};
  count.sa_handler = [](int) { ++alarms; };
  ASSERT_EQ(sigaction(TurnAlarm::Signal(), &count, nullptr), 0);
  std::thread([] {
    TurnAlarm dut;
    EXPECT_EQ(alarms, 0);
    dut.Start();
    EXPECT_TRUE(InterruptedTimes(5));
    dut.Stop();
    const int before = alarms;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_EQ(alarms, before);
  }).join();
}

}  // namespace
}  // namespace clearway
