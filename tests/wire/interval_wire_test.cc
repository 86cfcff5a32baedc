#include "wire/interval_wire.h"

#include <gtest/gtest.h>

#include "support/random.h"
#include "wire/status.h"

namespace clearway {
namespace {

TimeInterval Between(std::int64_t from_ns, std::int64_t until_ns) {
  return {TimeFromNanoseconds(from_ns), TimeFromNanoseconds(until_ns)};
}

TEST(IntervalWire, IntervalsComeBack) {
  const std::vector<std::vector<TimeInterval>> intervals{
      {}, {Between(-5, 3), Between(4, 4)}, {}, {Between(1, 2)}};
  v1::TimeIntervals proto;
  Write(intervals, &proto);
  const auto dut = ReadTimeIntervals(proto, 4);
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(*dut, intervals);
  EXPECT_TRUE(ReadTimeIntervals({}, 0)->empty());
}

TEST(IntervalWire, AReplyOfTheWrongLengthIsNoAnswer) {
  v1::TimeIntervals good;
  Write({{Between(1, 2)}, {Between(1, 2)}}, &good);
  EXPECT_TRUE(absl::IsInternal(ReadTimeIntervals(good, 1).status()));
  v1::TimeIntervals bad = good;
  bad.set_counts(1, 4'000'000'000u);
  EXPECT_TRUE(absl::IsInternal(ReadTimeIntervals(bad, 2).status()));
  bad = good;
  bad.mutable_until_ns()->RemoveLast();
  EXPECT_TRUE(absl::IsInternal(ReadTimeIntervals(bad, 2).status()));
}

TEST(IntervalWire, QuestionsAboutPlacesComeBack) {
  testing_support::Random random(3);
  std::vector<Pose> T_W_L;
  for (int i = 0; i < 6; ++i) T_W_L.push_back(random.AnyPose(5));
  SafeIntervalOptions options{.check = {}, .look_every = Duration(7)};
  options.check.padding_m = 0.25;
  v1::FindSafeIntervalsRequest proto;
  Write(T_W_L, Between(-1, 2), options, &proto);
  auto dut = ReadSafeIntervalQuestion(proto, 2, ServerLimits{});
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->T_W_L, T_W_L);
  EXPECT_EQ(dut->window, Between(-1, 2));
  EXPECT_EQ(dut->options.look_every, Duration(7));
  EXPECT_EQ(dut->options.check.padding_m, 0.25);
  proto.clear_look_every_ns();
  EXPECT_EQ(ReadSafeIntervalQuestion(proto, 2, ServerLimits{})->options.look_every,
            SafeIntervalOptions{}.look_every);
}

TEST(IntervalWire, QuestionsAboutDeparturesComeBack) {
  DepartureIntervalOptions options;
  options.motion.contact_resolution_m = 0.125;
  options.resolution = Duration(7);
  v1::FindDepartureIntervalsRequest proto;
  Write(Between(-1, 2), options, &proto);
  EXPECT_EQ(proto.motions().contact_resolution_m(), 0.125);
  EXPECT_EQ(ReadDepartureWindow(proto).value(), Between(-1, 2));
  EXPECT_EQ(ReadResolution(proto), Duration(7));
  proto.clear_resolution_ns();
  EXPECT_EQ(ReadResolution(proto), DepartureIntervalOptions{}.resolution);
  proto.clear_window();
  EXPECT_EQ(FieldOf(ReadDepartureWindow(proto).status()), "window");
}

TEST(IntervalWire, MoreConfigurationsThanAllowedAreRefused) {
  v1::FindSafeIntervalsRequest proto;
  Write(std::vector<Pose>(14), Between(0, 0), {}, &proto);
  ServerLimits limits;
  limits.max_states_per_batch = 7;
  EXPECT_TRUE(ReadSafeIntervalQuestion(proto, 2, limits).ok());
  limits.max_states_per_batch = 6;
  const auto dut = ReadSafeIntervalQuestion(proto, 2, limits);
  EXPECT_TRUE(absl::IsResourceExhausted(dut.status()));
  EXPECT_EQ(FieldOf(dut.status()), "world_from_link");
}

}  // namespace
}  // namespace clearway
