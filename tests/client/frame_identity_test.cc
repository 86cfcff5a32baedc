// Sources that restart, clocks that jump, and sensors that come late, against a real server.
#include <gmock/gmock.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include "clearway/client/frame_sender.h"
#include "clearway/client/scene_client.h"
#include "clearway/io/recording.h"
#include "clearway/v1/ingest_service.grpc.pb.h"
#include "support/frames.h"
#include "support/temporary_folder.h"
#include "support/test_server.h"
#include "wire/frame_wire.h"

namespace clearway {
namespace {

using ::testing::HasSubstr;
using testing_support::At;
using testing_support::TestServer;

Frame Point(const std::string& sensor, std::uint64_t sequence, double seconds,
            const Eigen::Vector3d& p_S = {5, 0, 0.5}) {
  Frame frame = testing_support::FrameAt(seconds);
  frame.sensor_id = sensor;
  frame.sequence = sequence;
  testing_support::AddPoint(frame, kStaticLabel, p_S);
  return frame;
}

class FrameIdentity : public testing::Test {
 protected:
  FrameIdentity()
      : stub_(v1::IngestService::NewStub(
            grpc::CreateChannel(server_.address(), grpc::InsecureChannelCredentials()))) {}

  // As a client in another language: without a run, unless the frame has one.
  grpc::Status Push(const Frame& frame, v1::PushFrameResponse* response,
                    bool allow_stamp_jump = false) {
    v1::PushFrameRequest request;
    Write(frame, request.mutable_frame());
    request.set_allow_stamp_jump(allow_stamp_jump);
    grpc::ClientContext context;
    return stub_->PushFrame(&context, request, response);
  }
  grpc::Status Push(const Frame& frame) {
    v1::PushFrameResponse ignored;
    return Push(frame, &ignored);
  }
  SpaceStatus StatusAt(const Eigen::Vector3f& p_W) {
    const auto points =
        SceneClient(server_.Connect())
            .OccupancyOfPoints(std::vector{p_W}, std::vector{server_.Newest()->stamp});
    EXPECT_TRUE(points.ok()) << points.status();
    return points->points.at(0).status;
  }

  TestServer server_;
  std::unique_ptr<v1::IngestService::Stub> stub_;
};

TEST_F(FrameIdentity, ASourceThatCountsFromZeroAgainIsRefusedOrGoesOnWithAnotherRun) {
  for (int k = 0; k < 3; ++k) ASSERT_TRUE(Push(Point("cam", k, 1 + 0.1 * k)).ok());
  const Frame restarted = Point("cam", 0, 10, {3, 3, 0.5});
  const grpc::Status refused = Push(restarted);
  EXPECT_EQ(refused.error_code(), grpc::StatusCode::ALREADY_EXISTS);
  EXPECT_THAT(refused.error_message(),
              HasSubstr("0 of sensor \"cam\" without sensor_run names another "
                        "frame: that one has stamp_ns 1000000000, this one "
                        "10000000000"));
  EXPECT_EQ(server_.Newest()->stamp, At(1.2));
  EXPECT_EQ(StatusAt({3, 3, 0.5}), SpaceStatus::kUnknownSpace);

  Frame with_run = restarted;
  with_run.sensor_run = 1;
  v1::PushFrameResponse response;
  ASSERT_TRUE(Push(with_run, &response).ok());
  EXPECT_FALSE(response.repeated_answer());
  EXPECT_EQ(response.report().points_used(), 1u);
  EXPECT_EQ(server_.Newest()->stamp, At(10));
  EXPECT_EQ(StatusAt({3, 3, 0.5}), SpaceStatus::kOccupied);
}

TEST_F(FrameIdentity, TheSameStampWithOtherPointsIsAnotherFrame) {
  ASSERT_TRUE(Push(Point("cam", 0, 1)).ok());
  const grpc::Status refused = Push(Point("cam", 0, 1, {3, 3, 0.5}));
  EXPECT_EQ(refused.error_code(), grpc::StatusCode::ALREADY_EXISTS);
  EXPECT_THAT(refused.error_message(), HasSubstr("content differs"));
  v1::PushFrameResponse response;
  ASSERT_TRUE(Push(Point("cam", 0, 1), &response).ok());
  EXPECT_TRUE(response.repeated_answer());
}

TEST_F(FrameIdentity, RunsOfSomeFramesOnly) {
  Frame frame = Point("cam", 0, 1);
  ASSERT_TRUE(Push(frame).ok());
  frame.sensor_run = 5;  // the same scan by another name
  v1::PushFrameResponse response;
  ASSERT_TRUE(Push(frame, &response).ok());
  EXPECT_FALSE(response.repeated_answer());
  ASSERT_TRUE(Push(frame, &response).ok());
  EXPECT_TRUE(response.repeated_answer());
}

TEST_F(FrameIdentity, ARestartedSenderGoesOn) {
  for (int start = 0; start < 3; ++start) {
    FrameSender dut(server_.Connect());
    EXPECT_NE(dut.sensor_run(), 0u);
    for (int k = 0; k < 3; ++k) {
      const auto ack = dut.Push(Point("cam", k, 1 + start + 0.1 * k));
      ASSERT_TRUE(ack.ok()) << ack.status();
      EXPECT_FALSE(ack->repeated_answer);
      EXPECT_TRUE(dut.Push(Point("cam", k, 1 + start + 0.1 * k))->repeated_answer);
    }
  }
  EXPECT_EQ(server_.Newest()->stamp, At(3.2));
}

TEST_F(FrameIdentity, TwoSendersOfOneRunShareNames) {
  FrameSender first(server_.Connect()),
      second(server_.Connect(), {.sensor_run = first.sensor_run()});
  ASSERT_TRUE(first.Push(Point("cam", 0, 1)).ok());
  EXPECT_TRUE(second.Push(Point("cam", 0, 1))->repeated_answer);
}

TEST_F(FrameIdentity, ASenderKeepsARunOfTheFrame) {
  Frame frame = Point("cam", 0, 1);
  frame.sensor_run = 9;
  ASSERT_TRUE(FrameSender(server_.Connect()).Push(frame).ok());
  v1::PushFrameResponse response;
  ASSERT_TRUE(Push(frame, &response).ok());
  EXPECT_TRUE(response.repeated_answer());
}

TEST_F(FrameIdentity, OneFrameFromTheFutureDoesNotStopTheOthers) {
  ASSERT_TRUE(Push(Point("front", 0, 1.0)).ok());
  ASSERT_TRUE(Push(Point("front", 1, 1.1)).ok());
  const grpc::Status refused = Push(Point("rear", 0, 3e7));
  EXPECT_EQ(refused.error_code(), grpc::StatusCode::FAILED_PRECONDITION);
  EXPECT_THAT(refused.error_message(), HasSubstr("frame.stamp_ns: 30000000000000000"));
  EXPECT_THAT(refused.error_message(), HasSubstr("3600.000000000 s (max_stamp_jump_s)"));
  EXPECT_THAT(refused.error_message(), HasSubstr("allow_stamp_jump"));
  ASSERT_TRUE(Push(Point("front", 2, 1.2)).ok());
  EXPECT_EQ(server_.Newest()->stamp, At(1.2));
  v1::PushFrameResponse response;
  ASSERT_TRUE(Push(Point("rear", 0, 3e7), &response, /*allow_stamp_jump=*/true).ok());
  EXPECT_EQ(server_.Newest()->stamp, At(3e7));
  ASSERT_TRUE(SceneClient(server_.Connect()).Reset().ok());
  EXPECT_TRUE(Push(Point("front", 0, 1)).ok());  // then any stamp will do
}

TEST_F(FrameIdentity, ASenderMayAllowJumps) {
  FrameSender dut(server_.Connect(), {.allow_stamp_jump = true});
  ASSERT_TRUE(dut.Push(Point("cam", 0, 1)).ok());
  EXPECT_TRUE(dut.Push(Point("cam", 1, 1e6)).ok());
  absl::Status streamed = absl::UnknownError("no answer");
  ASSERT_TRUE(dut.OpenStream([&](const std::string&, std::uint64_t,
                                 const absl::StatusOr<PushAck>& ack) { streamed = ack.status(); })
                  .ok());
  ASSERT_TRUE(dut.Send(Point("cam", 2, 1e7)).ok());
  ASSERT_TRUE(dut.CloseStream().ok());
  EXPECT_TRUE(streamed.ok()) << streamed;
}

TEST_F(FrameIdentity, TwoSensorsOfWhichOneIsLater) {
  for (int k = 0; k < 20; ++k) {
    ASSERT_TRUE(Push(Point("front", k, 1 + 0.1 * k)).ok());
    v1::PushFrameResponse response;
    const grpc::Status rear = Push(Point("rear", k, 0.99 + 0.1 * k), &response);
    ASSERT_TRUE(rear.ok()) << rear.error_message();
    EXPECT_EQ(response.report().points_used(), 1u);
    EXPECT_EQ(response.report().late_by_ns(), 10'000'000);
    EXPECT_EQ(response.scene().stamp_ns(), ToNanoseconds(At(1 + 0.1 * k)));
  }
  const auto status = SceneClient(server_.Connect()).GetStatus();
  EXPECT_EQ(status->frames_applied, 40u);
  EXPECT_EQ(status->frames_late, 20u);
  EXPECT_EQ(status->frames_refused, 0u);
}

TEST_F(FrameIdentity, LimitsCanBeRead) {
  const auto info = SceneClient(server_.Connect()).GetServerInfo();
  ASSERT_TRUE(info.ok()) << info.status();
  EXPECT_EQ(info->limits.max_stamp_jump_s, 3600);
  EXPECT_EQ(info->limits.late_window_s, 0.2);
}

// Frames of two sensors in the order in which they came, late ones too.
TEST_F(FrameIdentity, ARecordingOfTwoSensorsMakesTheSameScene) {
  std::vector<Frame> frames;
  for (int k = 0; k < 10; ++k) {
    Frame front = Point("front", k, 1 + 0.1 * k),
          rear = Point("rear", k, 0.95 + 0.1 * k, {-4, 1, 0});
    testing_support::AddObject(front, 3, Pose::Translation(2 + 0.3 * k, 0, 0),
                               testing_support::BoxSurface({1, 1, 1}, 0.25));
    front.motions = {{3, Pose::Translation(0.3, 0, 0), front.stamp - FromSeconds(0.1)}};
    testing_support::AddObject(rear, 3, Pose::Translation(1.85 + 0.3 * k, 0, 0),
                               testing_support::BoxSurface({1, 1, 1}, 0.25));
    rear.sensor_run = 7;
    frames.insert(frames.end(), {front, rear});
  }
  const TemporaryFolder folder;
  auto writer = RecordingWriter::Create(folder / "two.cwr");
  ASSERT_TRUE(writer.ok());
  for (const Frame& frame : frames) {
    ASSERT_TRUE(Push(frame).ok());
    ASSERT_TRUE((*writer)->Append(frame).ok());
  }
  ASSERT_TRUE((*writer)->Close().ok());
  const auto recording = OpenRecording(folder / "two.cwr");
  ASSERT_TRUE(recording.ok()) << recording.status();
  ASSERT_EQ(recording->frame_count, frames.size());
  TestServer other;
  FrameSender sender(other.Connect());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto frame = recording->read(i);
    EXPECT_EQ(frame->sensor_id, frames[i].sensor_id);
    EXPECT_EQ(frame->sensor_run, frames[i].sensor_run);
    EXPECT_EQ(frame->stamp, frames[i].stamp);
    const auto ack = sender.Push(*frame);
    ASSERT_TRUE(ack.ok()) << ack.status();
  }
  EXPECT_EQ(other.Newest()->Hash(), server_.Newest()->Hash());
}

}  // namespace
}  // namespace clearway
