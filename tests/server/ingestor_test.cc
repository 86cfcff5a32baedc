#include "server/ingestor.h"

#include <gtest/gtest.h>
#include <signal.h>

#include <atomic>
#include <chrono>
#include <future>

#include "server/thread_priority.h"
#include "support/frames.h"
#include "wire/status.h"

namespace clearway {
namespace {

using testing_support::FrameAt;

const Gone kNever = [] { return false; };

// The frame is all of its content here.
PushedFrame Pushed(Frame frame, bool allow_stamp_jump = false) {
  const std::uint64_t hash = frame.points_S.empty() ? 0 : 1 + frame.points_S.size();
  return {std::move(frame), hash, allow_stamp_jump};
}

Frame Numbered(std::uint64_t sequence, double seconds) {
  Frame frame = FrameAt(seconds);
  frame.sequence = sequence;
  testing_support::AddPoint(frame, kStaticLabel, {1 + 0.5 * static_cast<double>(sequence), 0, 0});
  return frame;
}

using Effect = Ingestor::Effect;

class IngestorTest : public testing::Test {
 protected:
  Ingestor::Answer Push(Frame frame, bool allow_stamp_jump = false) {
    auto ticket = dut_->Push(Pushed(std::move(frame), allow_stamp_jump));
    return ticket.ok() ? Ingestor::Wait(*ticket, kNever) : ticket.status();
  }
  // Keeps the writer busy until the returned promise is set.
  std::promise<void> Block() {
    std::promise<void> release;
    auto started = std::make_shared<std::promise<void>>();
    auto wait = std::make_shared<std::future<void>>(release.get_future());
    EXPECT_TRUE(dut_->Apply(
                        [started, wait](SceneBuilder&) {
                          started->set_value();
                          wait->wait();
                          return absl::OkStatus();
                        },
                        Effect::kTakesAway)
                    .ok());
    started->get_future().wait();
    return release;
  }

  absl::StatusOr<Ingestor::Ticket> Reset() {
    return dut_->Apply(
        [](SceneBuilder& builder) {
          builder.Reset();
          return absl::OkStatus();
        },
        Effect::kBeginsAnew);
  }

  Versions versions_{4};
  std::unique_ptr<Ingestor> dut_ = std::make_unique<Ingestor>(
      Ingestor::Options{
          .scene = {}, .frames = {}, .max_queued = 2, .max_remembered = 3, .threads = 1},
      versions_);
};

TEST_F(IngestorTest, Empty) {
  ASSERT_NE(versions_.Newest(), nullptr);
  EXPECT_EQ(versions_.Newest()->version, 1u);
  EXPECT_EQ(dut_->counts().frames_applied, 0u);
}

TEST_F(IngestorTest, AnAnswerNamesTheFirstVersionWithTheFrame) {
  const auto first = Push(Numbered(1, 1)), second = Push(Numbered(2, 2));
  ASSERT_TRUE(first.ok() && second.ok());
  EXPECT_EQ(first->version, 2u);
  EXPECT_EQ(second->version, 3u);
  EXPECT_EQ(second->reached, AckLevel::kApplied);
  EXPECT_EQ(second->report.points_used, 1u);
  EXPECT_EQ(versions_.Newest()->version, 3u);
}

std::atomic<int> alarms = 0;

TEST_F(IngestorTest, AChangeWithoutMemoryIsRefusedAndTheWriterGoesOn) {
  const auto ticket =
      dut_->Apply([](SceneBuilder&) -> absl::Status { throw std::bad_alloc(); }, Effect::kAdds);
  ASSERT_TRUE(ticket.ok());
  const absl::Status refused = Ingestor::Wait(*ticket, kNever).status();
  EXPECT_EQ(refused.code(), absl::StatusCode::kResourceExhausted);
  EXPECT_EQ(ReasonOf(refused), "NO_MEMORY");
  EXPECT_TRUE(Push(Numbered(1, 1)).ok());
}

// First kept versions go; then what adds to the scene is refused, until there is room again.
TEST_F(IngestorTest, WithoutRoomOnlyWhatAddsIsRefused) {
  std::atomic<bool> has_room = true;
  Ingestor::Options options;
  options.threads = 1;
  options.has_room = [&] {
    return has_room ? absl::OkStatus() : absl::ResourceExhaustedError("no room");
  };
  dut_ = std::make_unique<Ingestor>(options, versions_);
  ASSERT_TRUE(Push(Numbered(1, 1)).ok());
  ASSERT_NE(versions_.Find(1), nullptr);
  has_room = false;
  EXPECT_TRUE(absl::IsResourceExhausted(Push(Numbered(2, 2)).status()));
  EXPECT_EQ(versions_.Find(1), nullptr);
  EXPECT_EQ(versions_.Newest()->version, 2u);
  const auto cleared = dut_->Apply(
      [](SceneBuilder& builder) {
        builder.ClearRegion({{-100, -100, -100}, {100, 100, 100}});
        return absl::OkStatus();
      },
      Effect::kTakesAway);
  EXPECT_TRUE(Ingestor::Wait(*cleared, kNever).ok());
  EXPECT_TRUE(Ingestor::Wait(*Reset(), kNever).ok());
  has_room = true;
  const auto again = Push(Numbered(2, 2));
  ASSERT_TRUE(again.ok()) << again.status();
  EXPECT_FALSE(again->repeated_answer);
}

TEST_F(IngestorTest, AResetDropsTheVersionsBefore) {
  ASSERT_TRUE(Push(Numbered(1, 1)).ok());
  const std::weak_ptr<const SceneSnapshot> before = versions_.Newest();
  ASSERT_TRUE(Ingestor::Wait(*Reset(), kNever).ok());
  EXPECT_TRUE(before.expired());
}

// Else it kept a processor from who asks until the kernel's next tick.
TEST_F(IngestorTest, TheWriterIsInterruptedWhileItApplies) {
  // After this its alarm is there, and with it the handler.
  ASSERT_TRUE(Push(Numbered(1, 1)).ok());
  struct sigaction count {};
  count.sa_handler = [](int) { ++alarms; };
  ASSERT_EQ(sigaction(TurnAlarm::Signal(), &count, nullptr), 0);
  const auto ticket = dut_->Apply(
      [](SceneBuilder&) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        while (alarms < 3 && std::chrono::steady_clock::now() < end) {
        }
        return absl::OkStatus();
      },
      Effect::kTakesAway);
  ASSERT_TRUE(ticket.ok());
  EXPECT_TRUE(Ingestor::Wait(*ticket, kNever).ok());
  EXPECT_GE(alarms, 3);
}

TEST_F(IngestorTest, ARepeatGetsTheFirstAnswerAndChangesNothing) {
  const auto first = Push(Numbered(1, 1));
  const std::string hash = versions_.Newest()->Hash();
  const auto again = Push(Numbered(1, 1));
  ASSERT_TRUE(again.ok()) << again.status();
  EXPECT_FALSE(first->repeated_answer);
  EXPECT_TRUE(again->repeated_answer);
  EXPECT_EQ(again->version, first->version);
  EXPECT_EQ(versions_.Newest()->Hash(), hash);
}

TEST_F(IngestorTest, AFrameForWhichThereWasNoRoomIsAppliedOnceThereIs) {
  Ingestor::Options options;
  options.max_queued = 2;
  options.max_remembered = 3;
  options.threads = 1;
  options.frames.max_blocks = 20;
  dut_ = std::make_unique<Ingestor>(options, versions_);
  Frame ahead = FrameAt(1), behind = FrameAt(2);
  testing_support::AddPoint(ahead, kStaticLabel, {10, 0.05, 0.05});
  testing_support::AddPoint(behind, kStaticLabel, {-10, 0.05, 0.05});
  ASSERT_TRUE(Push(ahead).ok());
  ASSERT_TRUE(absl::IsResourceExhausted(Push(behind).status()));
  ASSERT_TRUE(dut_->Apply(
                      [](SceneBuilder& builder) {
                        builder.ClearRegion({{-100, -100, -100}, {100, 100, 100}});
                        return absl::OkStatus();
                      },
                      Effect::kTakesAway)
                  .ok());
  const auto again = Push(behind);
  EXPECT_TRUE(again.ok()) << again.status();
}

TEST_F(IngestorTest, ANameWithAnotherStampIsRefusedNamingBoth) {
  ASSERT_TRUE(Push(Numbered(0, 1)).ok());
  const std::string hash = versions_.Newest()->Hash();
  const absl::Status refused = Push(Numbered(0, 10)).status();
  EXPECT_EQ(refused.code(), absl::StatusCode::kAlreadyExists);
  EXPECT_EQ(ReasonOf(refused), "FRAME_NAME_TAKEN");
  EXPECT_EQ(
      refused.message(),
      "frame.sequence: 0 of sensor \"lidar\" without sensor_run names another frame: that one "
      "has stamp_ns 1000000000, this one 10000000000; a sensor that restarts and counts from 0 "
      "again must choose a new sensor_run");
  EXPECT_EQ(versions_.Newest()->Hash(), hash);
  EXPECT_EQ(dut_->counts().frames_refused, 1u);
  EXPECT_TRUE(Push(Numbered(0, 1))->repeated_answer);  // the first still has its name
}

TEST_F(IngestorTest, ANameWithAnotherContentIsRefused) {
  ASSERT_TRUE(Push(Numbered(0, 1)).ok());
  Frame other = Numbered(0, 1);
  testing_support::AddPoint(other, kStaticLabel, {3, 3, 0.5});
  const absl::Status refused = Push(other).status();
  EXPECT_EQ(refused.code(), absl::StatusCode::kAlreadyExists);
  EXPECT_NE(refused.message().find("both have stamp_ns 1000000000, but their content differs"),
            std::string::npos)
      << refused;
}

TEST_F(IngestorTest, AnotherRunIsAnotherName) {
  ASSERT_TRUE(Push(Numbered(0, 1)).ok());
  Frame restarted = Numbered(0, 10);
  restarted.sensor_run = 77;
  const auto applied = Push(restarted);
  ASSERT_TRUE(applied.ok()) << applied.status();
  EXPECT_FALSE(applied->repeated_answer);
  EXPECT_EQ(versions_.Newest()->stamp, testing_support::At(10));
  EXPECT_TRUE(Push(restarted)->repeated_answer);
  EXPECT_TRUE(Push(Numbered(0, 1))->repeated_answer);
  restarted.stamp = testing_support::At(11);
  EXPECT_NE(Push(restarted).status().message().find("of sensor_run 77"), std::string::npos);
}

TEST_F(IngestorTest, ARestartWithAClockThatWentBackIsRefused) {
  ASSERT_TRUE(Push(Numbered(0, 10)).ok());
  Frame restarted = Numbered(0, 1);
  restarted.sensor_run = 77;
  EXPECT_TRUE(absl::IsFailedPrecondition(Push(restarted).status()));
}

TEST_F(IngestorTest, ARefusalIsRememberedToo) {
  ASSERT_TRUE(Push(Numbered(1, 10)).ok());
  EXPECT_TRUE(absl::IsFailedPrecondition(Push(Numbered(2, 5)).status()));
  EXPECT_TRUE(absl::IsFailedPrecondition(Push(Numbered(2, 5)).status()));
  EXPECT_EQ(dut_->counts().frames_refused, 1u);
  EXPECT_TRUE(absl::IsAlreadyExists(Push(Numbered(2, 11)).status()));
}

TEST_F(IngestorTest, AJumpThatWasRefusedMayBeAllowedAfterwards) {
  ASSERT_TRUE(Push(Numbered(1, 1)).ok());
  EXPECT_TRUE(absl::IsFailedPrecondition(Push(Numbered(2, 3e7)).status()));
  const auto allowed = Push(Numbered(2, 3e7), /*allow_stamp_jump=*/true);
  ASSERT_TRUE(allowed.ok()) << allowed.status();
  EXPECT_FALSE(allowed->repeated_answer);
  EXPECT_TRUE(Push(Numbered(2, 3e7))->repeated_answer);
  EXPECT_TRUE(Push(Numbered(2, 3e7), true)->repeated_answer);
}

TEST_F(IngestorTest, LateFramesAreCounted) {
  ASSERT_TRUE(Push(Numbered(1, 1)).ok());
  Frame late = Numbered(1, 0.9);
  late.sensor_id = "rear";
  const auto ack = Push(late);
  ASSERT_TRUE(ack.ok()) << ack.status();
  EXPECT_EQ(ack->report.late_by, std::chrono::milliseconds(100));
  EXPECT_EQ(ack->stamp, testing_support::At(1));
  EXPECT_EQ(dut_->counts().frames_late, 1u);
  EXPECT_EQ(dut_->counts().frames_applied, 2u);
}

TEST_F(IngestorTest, RemembersAsManyAnswersAsItMay) {
  for (int i = 1; i <= 4; ++i) ASSERT_TRUE(Push(Numbered(i, 1)).ok());
  EXPECT_TRUE(Push(Numbered(2, 1))->repeated_answer);
  EXPECT_FALSE(Push(Numbered(1, 1))->repeated_answer);
}

TEST_F(IngestorTest, ResetForgetsAnswersAndStamps) {
  ASSERT_TRUE(Push(Numbered(1, 10)).ok());
  auto reset = Reset();
  ASSERT_TRUE(reset.ok());
  ASSERT_TRUE(Ingestor::Wait(*reset, kNever).ok());
  const auto again = Push(Numbered(1, 1));
  ASSERT_TRUE(again.ok()) << again.status();
  EXPECT_FALSE(again->repeated_answer);
  EXPECT_EQ(again->version, 4u);
}

TEST_F(IngestorTest, AFramePushedWhileAResetWaitsIsRememberedAfterIt) {
  std::promise<void> release = Block();
  ASSERT_TRUE(Reset().ok());
  const auto first = dut_->Push(Pushed(Numbered(1, 1)));
  release.set_value();
  ASSERT_TRUE(Ingestor::Wait(*first, kNever).ok());
  EXPECT_TRUE(Push(Numbered(1, 1))->repeated_answer);
}

TEST_F(IngestorTest, AFullQueueRefusesAndTheFrameMayComeAgain) {
  std::promise<void> release = Block();
  ASSERT_TRUE(dut_->Push(Pushed(Numbered(1, 1))).ok());
  ASSERT_TRUE(dut_->Push(Pushed(Numbered(2, 1))).ok());
  const absl::Status full = dut_->Push(Pushed(Numbered(3, 1))).status();
  EXPECT_TRUE(absl::IsResourceExhausted(full));
  EXPECT_EQ(ReasonOf(full), "QUEUE_FULL");
  release.set_value();
  ASSERT_TRUE(Push(Numbered(2, 1)).ok());  // once it is applied there is room
  EXPECT_FALSE(Push(Numbered(3, 1))->repeated_answer);
}

TEST_F(IngestorTest, ARepeatOfAWaitingFrameSharesItsAnswer) {
  std::promise<void> release = Block();
  const auto first = dut_->Push(Pushed(Numbered(1, 1))), again = dut_->Push(Pushed(Numbered(1, 1)));
  ASSERT_TRUE(again.ok());
  EXPECT_EQ(dut_->counts().queued, 1u);
  release.set_value();
  EXPECT_EQ(Ingestor::Wait(*first, kNever)->version, Ingestor::Wait(*again, kNever)->version);
}

TEST_F(IngestorTest, WaitingForRoomEndsWhenTheClientGoes) {
  std::promise<void> release = Block();
  ASSERT_TRUE(dut_->Push(Pushed(Numbered(1, 1))).ok());
  ASSERT_TRUE(dut_->Push(Pushed(Numbered(2, 1))).ok());
  EXPECT_TRUE(
      absl::IsCancelled(dut_->PushWhenRoom(Pushed(Numbered(3, 1)), [] { return true; }).status()));
  release.set_value();
}

TEST_F(IngestorTest, DrainingFinishesWhatWasAcceptedAndRefusesTheRest) {
  std::promise<void> release = Block();
  const auto accepted = dut_->Push(Pushed(Numbered(1, 1)));
  const auto late = std::chrono::steady_clock::now() + std::chrono::hours(1);
  std::thread drain([&] { EXPECT_TRUE(dut_->Drain(late)); });
  // Until the drain has begun, the queue fills up instead.
  std::uint64_t sequence = 100;
  while (!absl::IsUnavailable(dut_->Push(Pushed(Numbered(sequence, 1))).status())) ++sequence;
  release.set_value();
  drain.join();
  EXPECT_TRUE(Ingestor::Wait(*accepted, kNever).ok());
}

TEST_F(IngestorTest, WhatStillWaitsWhenTheTimeToDrainIsOverIsNotApplied) {
  std::promise<void> release = Block();
  const auto accepted = dut_->Push(Pushed(Numbered(1, 1)));
  EXPECT_FALSE(dut_->Drain(std::chrono::steady_clock::now()));  // a change is being applied
  EXPECT_TRUE(absl::IsUnavailable(Ingestor::Wait(*accepted, kNever).status()));
  release.set_value();
  EXPECT_TRUE(dut_->Drain(std::chrono::steady_clock::now() + std::chrono::hours(1)));
  EXPECT_EQ(dut_->counts().frames_applied, 0u);
}

}  // namespace
}  // namespace clearway
