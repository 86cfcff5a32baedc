#include "clearway/base/nearest_name.h"

#include <gtest/gtest.h>

namespace clearway {
namespace {

TEST(NearestName, Empty) {
  EXPECT_EQ(NearestName("", {}), "");
  EXPECT_EQ(NearestName("threads", {}), "");
  EXPECT_EQ(NearestName("", {"threads"}), "");
}

TEST(NearestName, CountsEdits) {
  const std::vector<std::string> names{"threads", "listen", "log_level"};
  EXPECT_EQ(NearestName("thread", names), "threads");       // one missing
  EXPECT_EQ(NearestName("listten", names), "listen");       // one too many
  EXPECT_EQ(NearestName("lag_level", names), "log_level");  // one replaced
  EXPECT_EQ(NearestName("threads", names), "threads");
}

TEST(NearestName, WhatIsFarFromAllHasNone) {
  EXPECT_EQ(NearestName("colour", {"threads", "listen"}), "");
  EXPECT_EQ(NearestName("abc", {"axy"}), "");  // two of three
  EXPECT_EQ(NearestName("abc", {"axc"}), "axc");
}

TEST(NearestName, TheFirstOfEquallyNearOnes) {
  EXPECT_EQ(NearestName("hat", {"cat", "bat"}), "cat");
}

}  // namespace
}  // namespace clearway
