#include "cli/frame_range.h"

#include <gmock/gmock.h>

#include "cli/message.h"

namespace clearway::cli {
namespace {

using ::testing::HasSubstr;

// Ten frames, 0.5 s apart, the first at 100 s.
FrameSource TenFrames() {
  FrameSource source;
  source.frame_count = 10;
  source.read = [](std::size_t k) {
    Frame frame;
    frame.stamp = TimeFromNanoseconds(100'000'000'000 + static_cast<std::int64_t>(k) * 500'000'000);
    return frame;
  };
  return source;
}

absl::StatusOr<FrameRange> RangeOf(const std::string& from, const std::string& to) {
  FrameRangeFlags flags;
  if (!from.empty()) flags.from = *ParseFrameBound(from);
  if (!to.empty()) flags.to = *ParseFrameBound(to);
  return FramesIn(flags, "drive", TenFrames());
}

void ExpectRange(const std::string& from, const std::string& to, std::size_t first,
                 std::size_t end) {
  const auto dut = RangeOf(from, to);
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->first, first) << from << " " << to;
  EXPECT_EQ(dut->end, end) << from << " " << to;
}

void ExpectRefused(const std::string& from, const std::string& to, const std::string& why) {
  const auto dut = RangeOf(from, to);
  EXPECT_TRUE(IsUsageError(dut.status())) << dut.status();
  EXPECT_THAT(dut.status().message(), HasSubstr(why));
  EXPECT_THAT(dut.status().message(), HasSubstr("; drive ends at frame 9, 4.5 s after frame 0"));
}

TEST(FrameRange, Empty) {
  EXPECT_EQ(FramesIn({}, "drive", FrameSource()).status().code(),
            absl::StatusCode::kFailedPrecondition);
}

TEST(FrameRange, EverythingUnlessAskedOtherwise) { ExpectRange("", "", 0, 10); }

TEST(FrameRange, OfFrameNumbers) {
  ExpectRange("3", "", 3, 10);
  ExpectRange("", "3", 0, 4);
  ExpectRange("9", "9", 9, 10);
}

TEST(FrameRange, OfSecondsAfterTheFirstFrame) {
  ExpectRange("0s", "4.5s", 0, 10);
  ExpectRange("1s", "2s", 2, 5);
  ExpectRange("1.000000001s", "1.999999999s", 3, 4);
  ExpectRange("4.5s", "", 9, 10);
}

TEST(FrameRange, OfANumberAndATime) { ExpectRange("2", "2s", 2, 5); }

TEST(FrameRange, BeyondTheLastFrameIsRefused) {
  ExpectRefused("10", "", "--from 10 is beyond the last frame");
  ExpectRefused("", "10", "--to 10 is beyond the last frame");
  ExpectRefused("4.6s", "", "--from 4.6 s is beyond the last frame");
  ExpectRefused("", "4.500000001s", "--to 4.500000001 s is beyond the last frame");
}

TEST(FrameRange, WithoutAFrameIsRefused) {
  ExpectRefused("5", "4", "no frame lies between --from 5 and --to 4");
  ExpectRefused("1.1s", "1.4s", "no frame lies between --from 1.1 s and --to 1.4 s");
  ExpectRefused("3s", "2", "no frame lies between --from 3.0 s and --to 2");
}

TEST(FrameRange, SecondsNeedTheFrameThatTheyCountFrom) {
  FrameSource broken = TenFrames();
  broken.read = [whole = broken.read](std::size_t k) {
    return k == 0 ? absl::DataLossError("damaged") : whole(k);
  };
  FrameRangeFlags flags;
  flags.from = FrameBound(Duration(std::chrono::seconds(1)));
  const absl::Status dut = FramesIn(flags, "drive", broken).status();
  EXPECT_EQ(dut.code(), absl::StatusCode::kDataLoss);
  EXPECT_THAT(dut.message(), HasSubstr("count from frame 0, which cannot be read"));
  EXPECT_THAT(dut.message(), HasSubstr("damaged"));
  flags.from = FrameBound(std::size_t{2});
  EXPECT_EQ(FramesIn(flags, "drive", broken)->first, 2u);
}

// Such a frame is in the range unless the next one shows that it is before it.
TEST(FrameRange, FramesThatCannotBeReadDoNotHideTheOthers) {
  FrameSource broken = TenFrames();
  broken.read = [whole = broken.read](std::size_t k) {
    return k == 4 || k == 9 ? absl::DataLossError("damaged") : whole(k);
  };
  const auto range = [&](const char* from, const char* to) {
    FrameRangeFlags flags;
    flags.from = *ParseFrameBound(from);
    flags.to = *ParseFrameBound(to);
    const auto dut = FramesIn(flags, "drive", broken);
    EXPECT_TRUE(dut.ok()) << dut.status();
    return dut.ok() ? std::pair(dut->first, dut->end) : std::pair<std::size_t, std::size_t>();
  };
  EXPECT_EQ(range("2.5s", "3.5s"), std::pair(std::size_t{5}, std::size_t{8}));
  EXPECT_EQ(range("2.4s", "3.5s"), std::pair(std::size_t{4}, std::size_t{8}));
  EXPECT_EQ(range("1.5s", "1.9s"), std::pair(std::size_t{3}, std::size_t{4}));
  EXPECT_EQ(range("1.5s", "9"), std::pair(std::size_t{3}, std::size_t{10}));
}

TEST(ParseFrameBound, RefusesWhatIsNeither) {
  for (const char* text : {"", "s", "-1", "-1s", "+1s", "1.5", "1e3s", "nans", "1 s", "ten",
                           "99999999999999999999", "1.0000000001s"}) {
    const auto dut = ParseFrameBound(text);
    EXPECT_FALSE(dut.ok()) << text;
    EXPECT_THAT(dut.status().message(), HasSubstr("frame's number (59) or seconds"));
  }
}

}  // namespace
}  // namespace clearway::cli
