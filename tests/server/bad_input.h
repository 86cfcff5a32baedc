// A server and raw stubs, for what clients get wrong: each error has its code and field, and the
// scene is left as it was.
#pragma once

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "clearway/v1/check_service.grpc.pb.h"
#include "clearway/v1/follow_service.grpc.pb.h"
#include "clearway/v1/ingest_service.grpc.pb.h"
#include "clearway/v1/lease_service.grpc.pb.h"
#include "clearway/v1/map_service.grpc.pb.h"
#include "clearway/v1/object_service.grpc.pb.h"
#include "clearway/v1/occupancy_service.grpc.pb.h"
#include "support/frames.h"
#include "support/raw_call.h"
#include "support/test_server.h"
#include "wire/frame_wire.h"
#include "wire/geometry_wire.h"
#include "wire/robot_wire.h"
#include "wire/status.h"

namespace clearway {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

inline absl::Status Explain(const grpc::Status& status) {
  google::rpc::Status proto;
  EXPECT_TRUE(status.ok() || proto.ParseFromString(status.error_details()))
      << status.error_message();
  proto.set_code(status.error_code());
  proto.set_message(status.error_message());
  return FromProto(proto);
}

inline ServerConfig TightConfig() {
  ServerConfig config = testing_support::SmallConfig();
  config.limits.max_points_per_frame = 100;
  config.limits.max_ray_voxels = 20'000;
  config.limits.max_peer_share = 1;
  config.limits.max_objects = 4;
  config.limits.max_blocks = 100;
  config.limits.max_states_per_batch = 10;
  config.limits.max_points_per_query = 1000;
  config.limits.max_message_bytes = 1 << 16;
  config.limits.max_leases = 2;
  config.limits.max_boxes = 3;
  config.limits.max_prior_bytes = 1000;
  return config;
}

// One server with a static point and object 1; every test leaves its scene unchanged.
class BadInput : public testing::Test {
 protected:
  void SetUp() override {
    Frame frame = testing_support::FrameAt(10);
    testing_support::AddPoint(frame, kStaticLabel, {3, 0, 0});
    testing_support::AddPoint(frame, 1, {5, 0, 0});
    ASSERT_TRUE(Push(ProtoOf(frame)).ok());
    v1::RegisterRobotRequest robot;
    Write(Robot::SingleShape("ball", Sphere{0.5}), robot.mutable_robot());
    v1::RegisterRobotResponse response;
    ASSERT_TRUE(Call(*check_, &v1::CheckService::Stub::RegisterRobot, robot, &response).ok());
    robot_id_ = response.robot_id();
    hash_ = server_.Newest()->Hash();
  }

  void TearDown() override {
    EXPECT_EQ(server_.Newest()->Hash(), hash_);
    Frame frame = testing_support::FrameAt(11);  // the server is alive and well
    EXPECT_TRUE(Push(ProtoOf(frame)).ok());
  }

  static v1::Frame ProtoOf(const Frame& frame) {
    v1::Frame proto;
    Write(frame, &proto);
    return proto;
  }
  // A frame that would be applied.
  static v1::Frame Good() {
    Frame frame = testing_support::FrameAt(12);
    testing_support::AddPoint(frame, kStaticLabel, {4, 0, 0});
    frame.motions = {{1, Pose::Translation(0.1, 0, 0), frame.stamp - FromSeconds(0.1)}};
    return ProtoOf(frame);
  }

  template <class Stub, class Request, class Response>
  absl::Status Call(Stub& stub,
                    grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Response*),
                    const Request& request, Response* response) {
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(30));
    return Explain((stub.*method)(&context, request, response));
  }
  absl::Status Push(const v1::Frame& frame) {
    v1::PushFrameRequest request;
    *request.mutable_frame() = frame;
    v1::PushFrameResponse response;
    return Call(*ingest_, &v1::IngestService::Stub::PushFrame, request, &response);
  }
  v1::CheckStatesRequest GoodCheck(int states) {
    v1::CheckStatesRequest request;
    request.set_robot_id(robot_id_);
    request.mutable_options()->set_unknown_space(v1::UNKNOWN_SPACE_POLICY_FREE);
    for (int i = 0; i < states; ++i) {
      request.add_times_ns(0);
      Append(Pose{}, request.mutable_world_from_link());
    }
    return request;
  }
  absl::Status Check(const v1::CheckStatesRequest& request) {
    v1::CheckStatesResponse response;
    return Call(*check_, &v1::CheckService::Stub::CheckStates, request, &response);
  }
  // One of so many knots.
  v1::CheckMotionsRequest GoodMotion(int knots) {
    v1::CheckMotionsRequest request;
    request.set_robot_id(robot_id_);
    request.mutable_options()->set_unknown_space(v1::UNKNOWN_SPACE_POLICY_FREE);
    request.add_knot_counts(knots);
    for (int k = 0; k < knots; ++k) {
      request.add_times_ns(k);
      Append(Pose{}, request.mutable_world_from_link());
    }
    return request;
  }
  absl::Status Check(const v1::CheckMotionsRequest& request) {
    v1::CheckMotionsResponse response;
    return Call(*check_, &v1::CheckService::Stub::CheckMotions, request, &response);
  }
  static void Expect(const absl::Status& status, absl::StatusCode code, const std::string& field) {
    EXPECT_EQ(status.code(), code) << status;
    EXPECT_FALSE(ReasonOf(status).empty()) << status;
    if (code == absl::StatusCode::kInvalidArgument) {
      EXPECT_EQ(BadFieldOf(status), field) << status;
    } else if (!field.empty()) {
      EXPECT_EQ(FieldOf(status), field) << status;
    }
    if (code == absl::StatusCode::kResourceExhausted) {
      EXPECT_TRUE(RetryDelayOf(status).has_value()) << status;
    }
  }

  testing_support::TestServer server_{TightConfig()};
  std::shared_ptr<grpc::Channel> channel_ = [this] {
    grpc::ChannelArguments arguments;
    arguments.SetMaxSendMessageSize(-1);
    return grpc::CreateCustomChannel(server_.address(), grpc::InsecureChannelCredentials(),
                                     arguments);
  }();
  std::unique_ptr<v1::IngestService::Stub> ingest_ = v1::IngestService::NewStub(channel_);
  std::unique_ptr<v1::CheckService::Stub> check_ = v1::CheckService::NewStub(channel_);
  std::unique_ptr<v1::OccupancyService::Stub> occupancy_ = v1::OccupancyService::NewStub(channel_);
  std::unique_ptr<v1::ObjectService::Stub> objects_ = v1::ObjectService::NewStub(channel_);
  std::unique_ptr<v1::LeaseService::Stub> leases_ = v1::LeaseService::NewStub(channel_);
  std::unique_ptr<v1::MapService::Stub> maps_ = v1::MapService::NewStub(channel_);
  std::unique_ptr<v1::FollowService::Stub> follow_ = v1::FollowService::NewStub(channel_);
  std::string robot_id_, hash_;
};

}  // namespace clearway
