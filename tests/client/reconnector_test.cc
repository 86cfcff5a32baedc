#include "client/reconnector.h"

#include <gtest/gtest.h>

#include <vector>

#include "wire/status.h"

namespace clearway {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const absl::Status kLost = absl::UnavailableError("lost");

TEST(Reconnector, Empty) {
  const Reconnector dut({});
  EXPECT_FALSE(dut.state().connected);
  EXPECT_EQ(dut.state().reconnects, 0u);
  EXPECT_TRUE(dut.state().last_error.ok());
}

TEST(Reconnector, PausesDoubleUpToTheLongestLessAQuarterAtMost) {
  Reconnector dut({.first_pause = milliseconds(100), .max_pause = milliseconds(1000)});
  for (const int expected_ms : {100, 200, 400, 800, 1000, 1000, 1000}) {
    const auto pause = dut.Lost(kLost);
    ASSERT_TRUE(pause.has_value());
    EXPECT_LE(*pause, milliseconds(expected_ms));
    EXPECT_GE(*pause, milliseconds(expected_ms) * 3 / 4);
  }
}

TEST(Reconnector, AConnectionThatBreaksAtOnceIsNoSuccess) {
  Reconnector dut({.first_pause = milliseconds(100), .max_pause = seconds(100)});
  dut.Connected();
  ASSERT_TRUE(dut.Lost(kLost).has_value());
  dut.Connected();
  EXPECT_GE(*dut.Lost(kLost), milliseconds(150));
}

TEST(Reconnector, AConnectionThatLastedStartsOver) {
  Reconnector dut({.first_pause = milliseconds(100), .max_pause = milliseconds(0)});
  for (int i = 0; i < 5; ++i) {
    dut.Connected();  // for longer than the longest pause
    EXPECT_LE(*dut.Lost(kLost), milliseconds(100));
  }
}

TEST(Reconnector, ReportsChangesOnly) {
  std::vector<bool> changes;
  Reconnector dut(
      {.on_change = [&](const StreamState& state) { changes.push_back(state.connected); }});
  for (int i = 0; i < 2; ++i) dut.Connected();
  for (int i = 0; i < 3; ++i) (void)dut.Lost(kLost);
  dut.Connected();
  EXPECT_EQ(changes, (std::vector<bool>{true, false, true}));
  EXPECT_TRUE(dut.state().connected);
  EXPECT_EQ(dut.state().reconnects, 1u);
  EXPECT_EQ(dut.state().last_error, kLost);
}

TEST(Reconnector, CountsStartsOfTheServer) {
  Reconnector dut({});
  for (const char* const instance : {"a", "a", "", "a", "b", "", "b", "c"}) {
    dut.Connected(instance);
    (void)dut.Lost(kLost);
  }
  EXPECT_EQ(dut.state().reconnects, 7u);
  EXPECT_EQ(dut.state().server_restarts, 2u);
}

TEST(Reconnector, AFullServerIsAskedAgainOnlyByThoseItAnsweredBefore) {
  const absl::Status full =
      FromProto(ToProto(WithReason(absl::ResourceExhaustedError("too many"), "TOO_MANY")));
  const absl::Status too_large = FromProto(ToProto(LimitError("frame", 3, 2)));
  Reconnector dut({.first_pause = Duration(0)});
  EXPECT_FALSE(dut.MayReturn(full));
  EXPECT_TRUE(dut.MayReturn(kLost));
  dut.Connected();
  EXPECT_TRUE(dut.MayReturn(full));
  EXPECT_FALSE(dut.MayReturn(too_large));
  EXPECT_GE(*dut.Lost(full), *RetryDelayOf(full));
}

TEST(Reconnector, GivesUp) {
  Reconnector dut({.first_pause = seconds(1), .give_up_after = milliseconds(500)});
  EXPECT_FALSE(dut.Lost(kLost).has_value());
  EXPECT_EQ(dut.GivenUp(kLost).message(), "lost; gave up after 0.5 s without the stream");
  Reconnector at_once({.give_up_after = Duration(0)});
  EXPECT_FALSE(at_once.Lost(kLost).has_value());
}

}  // namespace
}  // namespace clearway
