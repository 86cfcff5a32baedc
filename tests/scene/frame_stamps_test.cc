#include "scene/frame_stamps.h"

#include <gmock/gmock.h>

#include "absl/strings/str_cat.h"
#include "scene/sensor_frames.h"

namespace clearway {
namespace {

using ::testing::HasSubstr;
using testing_support::At;
using testing_support::FrameAt;

using FrameStamps = SensorFrames;

TEST_F(FrameStamps, Empty) {
  Apply(Of("front", FrameAt(1)));
  const FrameReport report = Apply(Of("rear", FrameAt(0.99)));
  EXPECT_EQ(report.late_by, std::chrono::milliseconds(10));
  EXPECT_EQ(scene_->stamp, At(1));
  EXPECT_EQ(scene_->version, 2u);
}

TEST_F(FrameStamps, OnTimeIsNotLate) {
  EXPECT_EQ(Apply(Of("front", FrameAt(1))).late_by, Duration::zero());
  EXPECT_EQ(Apply(Of("rear", FrameAt(1))).late_by, Duration::zero());
  EXPECT_EQ(Apply(Of("rear", FrameAt(1.1))).late_by, Duration::zero());
}

TEST_F(FrameStamps, BeyondTheWindowItIsRefusedNamingStampsAndWindow) {
  Apply(Of("front", FrameAt(1.2)));
  Apply(Of("rear", FrameAt(1.0)));  // at its end
  Apply(Of("front", FrameAt(1.3)));
  const std::string why = Refusal(Of("left", FrameAt(1.0)));
  EXPECT_THAT(why, HasSubstr("1000000000 of sensor \"left\" lies 0.300000000 s before"));
  EXPECT_THAT(why, HasSubstr("the scene's newest frame, 1300000000"));
  EXPECT_THAT(why, HasSubstr("at most 0.200000000 s (late_window_s)"));
}

TEST_F(FrameStamps, StampsOfOneSensorMayNotGoBack) {
  Apply(Of("front", FrameAt(1.0)));
  const std::string why = Refusal(Of("front", FrameAt(0.99)));
  EXPECT_THAT(why,
              HasSubstr("0.010000000 s before the newest frame of the same sensor, 1000000000"));
  Apply(Of("rear", FrameAt(0.95)));
  Refusal(Of("rear", FrameAt(0.94)));
  Apply(Of("rear", FrameAt(0.95)));  // equal stamps are no step back
}

TEST_F(FrameStamps, WithoutAWindowNoneIsApplied) {
  limits_.late_window = Duration::zero();
  SetUp();
  Apply(Of("front", FrameAt(1)));
  Refusal(Of("rear", FrameAt(0.999)));
  Apply(Of("rear", FrameAt(1)));
}

TEST_F(FrameStamps, AfterResetTheFirstFrameCounts) {
  Apply(Of("front", FrameAt(100)));
  dut_->Reset();
  Apply(Of("front", FrameAt(10)));
  EXPECT_EQ(Apply(Of("rear", FrameAt(9.9))).late_by, std::chrono::milliseconds(100));
  Refusal(Of("rear", FrameAt(9.89)));
  Refusal(Of("front", FrameAt(9.9)));
}

TEST_F(FrameStamps, MoreSensorsThanAreRememberedAreAppliedStill) {
  for (int i = 0; i < 3000; ++i) Apply(Of(absl::StrCat("s", i), FrameAt(1)));
  EXPECT_EQ(scene_->stamp, At(1));
}

TEST_F(FrameStamps, AJumpAheadIsRefusedUntilItIsAllowed) {
  Apply(Of("front", FrameAt(1)));
  const std::string why = Refusal(Of("rear", FrameAt(3e7)));
  EXPECT_THAT(why,
              HasSubstr("30000000000000000 of sensor \"rear\" lies 29999999.000000000 s after"));
  EXPECT_THAT(why, HasSubstr("the limit is 3600.000000000 s (max_stamp_jump_s)"));
  EXPECT_THAT(why, HasSubstr("allow_stamp_jump"));
  Apply(Of("front", FrameAt(1.1)));
  Apply(Of("rear", FrameAt(3601.1)));  // as far as it may
  Apply(Of("rear", FrameAt(3e7)), {.allow_stamp_jump = true});
  EXPECT_EQ(scene_->stamp, At(3e7));
}

TEST_F(FrameStamps, TheFirstFrameAndTheFirstAfterResetMayHaveAnyStamp) {
  Apply(Of("front", FrameAt(3e7)));
  dut_->Reset();
  Apply(Of("front", FrameAt(1)));
  dut_->Reset();
  Apply(Of("front", FrameAt(3e7)));
}

}  // namespace
}  // namespace clearway
