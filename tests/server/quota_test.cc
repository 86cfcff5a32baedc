#include "server/quota.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <thread>
#include <vector>

#include "wire/status.h"

namespace clearway {
namespace {

using testing::HasSubstr;
using Slots = std::vector<std::unique_ptr<Quota::Slot>>;

absl::Status Take(Quota& dut, const std::string& peer, Slots& slots) {
  slots.push_back(std::make_unique<Quota::Slot>(dut, peer));
  return slots.back()->status();
}

TEST(QuotaTest, OnePeerGetsItsShareAndOthersTheRest) {
  Quota dut("streams", 5, 0.5);
  Slots slots;
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(Take(dut, "a", slots).ok());
  const absl::Status status = Take(dut, "a", slots);
  EXPECT_TRUE(absl::IsResourceExhausted(status));
  EXPECT_EQ(ReasonOf(status), "TOO_MANY_OF_CLIENT");
  EXPECT_THAT(std::string(status.message()),
              HasSubstr("streams of this client at once; the limit for one is 3"));
  EXPECT_TRUE(Take(dut, "b", slots).ok());
  EXPECT_TRUE(Take(dut, "c", slots).ok());
  EXPECT_EQ(ReasonOf(Take(dut, "d", slots)), "TOO_MANY");
  EXPECT_EQ(dut.size(), 5u);
}

TEST(QuotaTest, WhatIsGivenBackCanBeTakenAgain) {
  Quota dut("streams", 2, 0.5);
  for (int i = 0; i < 3; ++i) {
    Slots slots;
    EXPECT_TRUE(Take(dut, "a", slots).ok());
    EXPECT_FALSE(Take(dut, "a", slots).ok());
    EXPECT_EQ(dut.size(), 1u) << "a refusal takes nothing";
  }
  EXPECT_EQ(dut.size(), 0u);
}

TEST(QuotaTest, EveryPeerMayHaveOne) {
  EXPECT_EQ(PeerLimit(1, 0.5), 1u);
  EXPECT_EQ(PeerLimit(64, 1e-6), 1u);
  EXPECT_EQ(PeerLimit(64, 0.5), 32u);
  EXPECT_EQ(PeerLimit(64, 1), 64u);
}

TEST(QuotaTest, ManyThreads) {
  Quota dut("calls", 1000, 1);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&dut, t] {
      for (int i = 0; i < 5000; ++i) {
        const Quota::Slot slot(dut, std::string(1, static_cast<char>('a' + t % 2)));
        EXPECT_TRUE(slot.status().ok());
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(dut.size(), 0u);
}

}  // namespace
}  // namespace clearway
