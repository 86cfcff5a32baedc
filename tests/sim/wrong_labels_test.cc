#include "clearway/sim/wrong_labels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace clearway {
namespace {

Frame FrameOf(const std::vector<ObjectId>& labels, std::size_t times) {
  Frame frame;
  for (std::size_t i = 0; i < times; ++i) {
    frame.labels.insert(frame.labels.end(), labels.begin(), labels.end());
  }
  frame.points_S.resize(frame.labels.size());
  return frame;
}

TEST(WrongLabels, AreOthersOfTheFrameAllEquallyLikely) {
  const Frame frame = FrameOf({0, 3, 8, kIgnoreLabel}, 10'000);
  const Frame dut = WithWrongLabels(frame, 0.06, 5);
  std::map<std::pair<ObjectId, ObjectId>, double> counts;
  for (std::size_t i = 0; i < frame.labels.size(); ++i) {
    ++counts[{frame.labels[i], dut.labels[i]}];
  }
  EXPECT_EQ((counts[{kIgnoreLabel, kIgnoreLabel}]), 10'000);
  for (const ObjectId of : {0, 3, 8}) {
    for (const ObjectId to : {0, 3, 8}) {
      const double expected = of == to ? 9'400 : 300;
      EXPECT_NEAR((counts[{of, to}]), expected, 4 * std::sqrt(600)) << of << " " << to;
    }
  }
  EXPECT_EQ(counts.size(), 10u);
}

TEST(WrongLabels, AreTheSameForTheSameSeedAndFrame) {
  const Frame frame = FrameOf({0, 1}, 1'000);
  EXPECT_EQ(WithWrongLabels(frame, 0.1, 5).labels, WithWrongLabels(frame, 0.1, 5).labels);
  EXPECT_NE(WithWrongLabels(frame, 0.1, 5).labels, WithWrongLabels(frame, 0.1, 6).labels);
  Frame next = frame;
  next.sequence = 1;
  EXPECT_NE(WithWrongLabels(frame, 0.1, 5).labels, WithWrongLabels(next, 0.1, 5).labels);
}

TEST(WrongLabels, LeaveAloneWhatHasNoOther) {
  const Frame frame = FrameOf({0}, 100);
  EXPECT_EQ(WithWrongLabels(frame, 1, 5).labels, frame.labels);
  Frame rays = FrameOf({0, 1}, 100);
  rays.no_return.assign(200, 1);
  EXPECT_EQ(WithWrongLabels(rays, 1, 5).labels, rays.labels);
  EXPECT_EQ(WithWrongLabels(FrameOf({0, 1}, 100), 0, 5).labels, FrameOf({0, 1}, 100).labels);
}

}  // namespace
}  // namespace clearway
