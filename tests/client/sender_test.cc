#include <gtest/gtest.h>

#include <limits>
#include <mutex>

#include "clearway/client/error_details.h"
#include "clearway/client/frame_sender.h"
#include "clearway/client/scene_client.h"
#include "support/frames.h"
#include "support/test_server.h"

namespace clearway {
namespace {

using testing_support::FrameAt;
using testing_support::TestServer;

Frame Numbered(std::uint64_t sequence) {
  Frame frame = FrameAt(0.1 * static_cast<double>(sequence));
  frame.sequence = sequence;
  testing_support::AddPoint(frame, kStaticLabel, {3, 0.2 * static_cast<double>(sequence), 0});
  return frame;
}

class SenderTest : public testing::Test {
 protected:
  struct Answer {
    std::uint64_t sequence;
    absl::StatusOr<PushAck> ack;
  };
  void Open(AckLevel level = AckLevel::kApplied) {
    const absl::Status opened = dut_.OpenStream(
        [this](const std::string&, std::uint64_t sequence, const absl::StatusOr<PushAck>& ack) {
          std::lock_guard lock(mutex_);
          answers_.push_back({sequence, ack});
        },
        level);
    ASSERT_TRUE(opened.ok()) << opened;
  }

  TestServer server_;
  FrameSender dut_{server_.Connect()};
  std::mutex mutex_;
  std::vector<Answer> answers_;
};

TEST_F(SenderTest, Empty) {
  Open();
  EXPECT_TRUE(dut_.CloseStream().ok());
  EXPECT_TRUE(answers_.empty());
}

TEST_F(SenderTest, APushIsAppliedWhenItReturns) {
  const auto ack = dut_.Push(Numbered(1));
  ASSERT_TRUE(ack.ok()) << ack.status();
  EXPECT_EQ(ack->reached, AckLevel::kApplied);
  EXPECT_EQ(ack->version, 2u);
  EXPECT_EQ(server_.Newest()->version, 2u);
}

TEST_F(SenderTest, AnAcceptedPushDoesNotWait) {
  const auto ack = dut_.Push(Numbered(1), AckLevel::kAccepted);
  ASSERT_TRUE(ack.ok()) << ack.status();
  EXPECT_EQ(ack->reached, AckLevel::kAccepted);
}

TEST_F(SenderTest, PointsThatAreNotFiniteAreDroppedAndCounted) {
  Frame frame = Numbered(1);
  testing_support::AddPoint(frame, kStaticLabel, {std::numeric_limits<double>::quiet_NaN(), 0, 0});
  testing_support::AddPoint(frame, 4, {0, std::numeric_limits<double>::infinity(), 0});
  const auto ack = dut_.Push(frame);
  ASSERT_TRUE(ack.ok()) << ack.status();
  EXPECT_EQ(ack->report.points_used, 1u);
  EXPECT_EQ(ack->report.points_not_finite, 2u);
  EXPECT_EQ(SceneClient(server_.Connect()).GetStatus()->points_not_finite, 2u);
}

TEST_F(SenderTest, ARepeatGetsTheFirstAnswer) {
  const auto first = dut_.Push(Numbered(1)), again = dut_.Push(Numbered(1));
  ASSERT_TRUE(first.ok() && again.ok());
  EXPECT_FALSE(first->repeated_answer);
  EXPECT_TRUE(again->repeated_answer);
  EXPECT_EQ(first->version, again->version);
}

TEST_F(SenderTest, AStreamMakesTheSameSceneAsSinglePushes) {
  Open();
  TestServer other;
  FrameSender single(other.Connect());
  for (int i = 1; i <= 40; ++i) {
    ASSERT_TRUE(dut_.Send(Numbered(i)).ok());
    EXPECT_LE(dut_.unanswered(), server_.core().config.limits.max_frames_in_flight);
    ASSERT_TRUE(single.Push(Numbered(i)).ok());
  }
  EXPECT_TRUE(dut_.CloseStream().ok());
  ASSERT_EQ(answers_.size(), 40u);
  for (std::uint64_t i = 0; i < 40; ++i) {
    EXPECT_EQ(answers_[i].sequence, i + 1);
    EXPECT_EQ(answers_[i].ack->version, i + 2);
  }
  EXPECT_EQ(server_.Newest()->Hash(), other.Newest()->Hash());
}

TEST_F(SenderTest, ARefusedFrameDoesNotEndTheStream) {
  Open();
  Frame bad = Numbered(5);
  bad.T_W_S.rotation.w() = 2;
  ASSERT_TRUE(dut_.Send(Numbered(4)).ok());
  ASSERT_TRUE(dut_.Send(bad).ok());
  ASSERT_TRUE(dut_.Send(Numbered(2)).ok());  // its stamp goes back
  ASSERT_TRUE(dut_.Send(Numbered(6)).ok());
  EXPECT_TRUE(dut_.CloseStream().ok());
  ASSERT_EQ(answers_.size(), 4u);
  EXPECT_TRUE(answers_[0].ack.ok());
  EXPECT_EQ(DetailsOf(answers_[1].ack.status()).field, "frame.world_from_sensor.rotation");
  EXPECT_TRUE(absl::IsFailedPrecondition(answers_[2].ack.status()));
  EXPECT_TRUE(answers_[3].ack.ok());
}

TEST_F(SenderTest, AStreamOnADrainingServerIsRefusedFrameByFrame) {
  ASSERT_TRUE(dut_.Push(Numbered(1)).ok());
  server_.core().draining = true;
  const absl::Status unary =
      FrameSender(server_.Connect({.retry_for = Duration(0)})).Push(Numbered(2)).status();
  EXPECT_TRUE(absl::IsUnavailable(unary)) << unary;
  EXPECT_EQ(DetailsOf(unary).reason, "DRAINING");
  EXPECT_TRUE(DetailsOf(unary).retry_after.has_value());
}

TEST_F(SenderTest, DrainingAppliesWhatWasAccepted) {
  for (int i = 1; i <= 20; ++i) {
    ASSERT_TRUE(dut_.Push(Numbered(i), AckLevel::kAccepted).ok());
  }
  server_.Drain();
  EXPECT_EQ(server_.Newest()->version, 21u);
}

TEST_F(SenderTest, AnUnfinishedStreamMayBeAbandoned) {
  Open();
  for (int i = 1; i <= 5; ++i) ASSERT_TRUE(dut_.Send(Numbered(i)).ok());
}

TEST_F(SenderTest, StreamsAreUsedInOrder) {
  EXPECT_TRUE(absl::IsFailedPrecondition(dut_.Send(Numbered(1))));
  EXPECT_TRUE(absl::IsFailedPrecondition(dut_.CloseStream()));
  Open();
  EXPECT_TRUE(absl::IsFailedPrecondition(dut_.OpenStream(nullptr)));
}

}  // namespace
}  // namespace clearway
