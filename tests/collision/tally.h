// Compares answers with those of brute force and counts what occurred.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <iostream>
#include <string>

#include "clearway/collision/state_checker.h"
#include "collision/brute_force.h"

namespace clearway {

// How many states had which answer, so that no test passes for want of cases.
struct Tally {
  int states = 0;
  int unsure = 0;
  std::array<int, 6> by_status{};
  int with_object = 0;
  int clearances_between = 0;  // neither 0 nor at their limit

  int Of(SpaceStatus status) const { return by_status[static_cast<std::size_t>(status)]; }

  void Compare(const StateAnswer& dut, const BruteAnswer& expected, const CheckOptions& options,
               const std::string& where) {
    const StateAnswer& answer = expected.answer;
    ++states;
    unsure += expected.unsure;
    ++by_status[static_cast<std::size_t>(answer.status)];
    with_object += answer.object > 0;
    clearances_between += answer.clearance_m && *answer.clearance_m > 0 &&
                          *answer.clearance_m < *options.clearance_up_to_m;
    if (expected.unsure) return;
    EXPECT_EQ(std::string(ToString(dut.status)), ToString(answer.status)) << where;
    EXPECT_EQ(dut.link, answer.link) << where;
    EXPECT_EQ(dut.object, answer.object) << where;
    ASSERT_EQ(dut.unknown_fraction.has_value(), answer.unknown_fraction.has_value()) << where;
    EXPECT_DOUBLE_EQ(dut.unknown_fraction.value_or(0), answer.unknown_fraction.value_or(0))
        << where;
    ASSERT_EQ(dut.clearance_m.has_value(), answer.clearance_m.has_value()) << where;
    EXPECT_NEAR(dut.clearance_m.value_or(0), answer.clearance_m.value_or(0), 1e-6) << where;
  }

  void Print() const {
    std::cout << states << " states, " << unsure << " within 1e-6 m of touching left out:";
    for (std::size_t s = 0; s < 5; ++s) {
      std::cout << " " << by_status[s] << " " << ToString(static_cast<SpaceStatus>(s)) << ",";
    }
    std::cout << " " << with_object << " by an object\n";
  }
};

}  // namespace clearway
