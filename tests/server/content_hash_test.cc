#include "server/content_hash.h"

#include <gtest/gtest.h>

#include "clearway/v1/frame.pb.h"

namespace clearway {
namespace {

v1::Frame Large() {
  v1::Frame frame;
  frame.set_sensor_id("cam");
  frame.set_stamp_ns(5);
  for (int i = 0; i < 60'000; ++i) frame.add_points_m(0.1F * static_cast<float>(i));
  for (int i = 0; i < 20'000; ++i) frame.add_labels(i % 7);
  return frame;
}

TEST(ContentHash, Empty) {
  EXPECT_EQ(ContentHash(v1::Frame()), ContentHash(v1::Frame()));
  v1::Frame zero;
  zero.set_sequence(0);  // present, which absence is not
  EXPECT_NE(ContentHash(zero), ContentHash(v1::Frame()));
}

TEST(ContentHash, DependsOnContentAlone) {
  const std::uint64_t first = ContentHash(Large());
  v1::Frame again;
  ASSERT_TRUE(again.ParseFromString(Large().SerializeAsString()));
  EXPECT_EQ(ContentHash(again), first);
}

TEST(ContentHash, SeesTheFirstAndTheLastOfEverything) {
  const std::uint64_t first = ContentHash(Large());
  v1::Frame dut = Large();
  dut.set_points_m(0, 1);
  EXPECT_NE(ContentHash(dut), first);
  dut = Large();
  dut.set_labels(19'999, 8);
  EXPECT_NE(ContentHash(dut), first);
  dut = Large();
  dut.set_sensor_run(1);
  EXPECT_NE(ContentHash(dut), first);
  dut = Large();
  dut.add_motions()->set_object_id(1);
  EXPECT_NE(ContentHash(dut), first);
}

}  // namespace
}  // namespace clearway
