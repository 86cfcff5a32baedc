// What clients get wrong: each with its code and field, and the scene left as it was.
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
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

absl::Status Explain(const grpc::Status& status) {
  google::rpc::Status proto;
  EXPECT_TRUE(status.ok() || proto.ParseFromString(status.error_details()))
      << status.error_message();
  proto.set_code(status.error_code());
  proto.set_message(status.error_message());
  return FromProto(proto);
}

ServerConfig TightConfig() {
  ServerConfig config = testing_support::SmallConfig();
  config.limits.max_points_per_frame = 100;
  config.limits.max_objects = 4;
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

TEST_F(BadInput, Empty) {
  v1::PushFrameRequest request;
  v1::PushFrameResponse response;
  Expect(Call(*ingest_, &v1::IngestService::Stub::PushFrame, request, &response),
         absl::StatusCode::kInvalidArgument, "frame");
}

TEST_F(BadInput, Frames) {
  using Code = absl::StatusCode;
  struct Case {
    const char* what;
    std::function<void(v1::Frame&)> spoil;
    Code code;
    const char* field;
  };
  const auto rotation = [](v1::Frame& f) {
    return f.mutable_world_from_sensor()->mutable_rotation();
  };
  const auto translation = [](v1::Frame& f) {
    return f.mutable_world_from_sensor()->mutable_translation_m();
  };
  const Case cases[] = {
      {"no pose", [](auto& f) { f.clear_world_from_sensor(); }, Code::kInvalidArgument,
       "frame.world_from_sensor"},
      {"NaN", [&](auto& f) { rotation(f)->set_x(kNan); }, Code::kInvalidArgument,
       "frame.world_from_sensor"},
      {"infinite", [&](auto& f) { translation(f)->set_y(kInfinity); }, Code::kInvalidArgument,
       "frame.world_from_sensor"},
      {"not unit", [&](auto& f) { rotation(f)->set_w(0.9); }, Code::kInvalidArgument,
       "frame.world_from_sensor.rotation"},
      {"zero", [&](auto& f) { rotation(f)->set_w(0); }, Code::kInvalidArgument,
       "frame.world_from_sensor.rotation"},
      {"far", [&](auto& f) { translation(f)->set_z(1e6); }, Code::kInvalidArgument,
       "frame.world_from_sensor.translation_m"},
      {"labels", [](auto& f) { f.add_labels(0); }, Code::kInvalidArgument, "frame.labels"},
      {"origins", [](auto& f) { f.mutable_origins_m()->Resize(6, 0); }, Code::kInvalidArgument,
       "frame.origins_m"},
      {"triple", [](auto& f) { f.add_points_m(0); }, Code::kInvalidArgument, "frame.points_m"},
      {"label", [](auto& f) { f.set_labels(0, -5); }, Code::kInvalidArgument, "frame.labels[0]"},
      {"stamp back",
       [](auto& f) {
         f.set_stamp_ns(9'000'000'000);
         f.clear_motions();
       },
       Code::kFailedPrecondition, "frame.stamp_ns"},
      {"no stamp", [](auto& f) { f.clear_stamp_ns(); }, Code::kInvalidArgument, "frame.stamp_ns"},
      {"no sequence", [](auto& f) { f.clear_sequence(); }, Code::kInvalidArgument,
       "frame.sequence"},
      {"points", [](auto& f) { f.mutable_points_m()->Resize(303, 0); }, Code::kResourceExhausted,
       "frame.points_m"},
      {"objects",
       [](auto& f) {
         for (int i = 2; i < 8; ++i) {
           f.add_points_m(1), f.add_points_m(1), f.add_points_m(1), f.add_labels(i);
         }
       },
       Code::kResourceExhausted, "frame.labels"},
      {"half a turn",
       [](auto& f) {
         f.mutable_motions(0)->mutable_world_motion()->mutable_rotation()->set_w(0);
         f.mutable_motions(0)->mutable_world_motion()->mutable_rotation()->set_y(1);
       },
       Code::kInvalidArgument, "frame.motions[0].world_motion"},
      {"moved away",
       [](auto& f) {
         f.mutable_motions(0)->mutable_world_motion()->mutable_translation_m()->set_x(1.5e5);
       },
       Code::kInvalidArgument, "frame.motions"},
      {"no motion", [](auto& f) { f.mutable_motions(0)->clear_world_motion(); },
       Code::kInvalidArgument, "frame.motions[0].world_motion"},
  };
  std::uint64_t sequence = 1000;
  for (const Case& bad : cases) {
    SCOPED_TRACE(bad.what);
    v1::Frame frame = Good();
    frame.set_sequence(++sequence);
    bad.spoil(frame);
    Expect(Push(frame), bad.code, bad.field);
  }
}

TEST_F(BadInput, AMessageThatIsTooLarge) {
  v1::Frame frame = Good();
  frame.mutable_points_m()->Resize(1 << 16, 0.f);
  // The transport refuses it before it is read: no details.
  const absl::Status refused = Push(frame);
  EXPECT_TRUE(absl::IsResourceExhausted(refused)) << refused;
}

TEST_F(BadInput, BytesThatAreNoMessage) {
  for (const char* method :
       {"/clearway.v1.IngestService/PushFrame", "/clearway.v1.CheckService/CheckStates"}) {
    const grpc::Slice garbage("\xff\xff\xff\xff\xff");
    const grpc::ByteBuffer bytes(&garbage, 1);
    grpc::ByteBuffer response;
    const grpc::Status status = testing_support::RawCall(*channel_, method, bytes, response);
    Expect(Explain(status), absl::StatusCode::kInvalidArgument, "request");
  }
}

TEST_F(BadInput, Checks) {
  using Code = absl::StatusCode;
  v1::CheckStatesRequest request = GoodCheck(0);
  EXPECT_TRUE(Check(request).ok());  // none is a valid question
  request = GoodCheck(2);
  request.set_robot_id("nobody");
  Expect(Check(request), Code::kNotFound, "robot_id");
  request = GoodCheck(2);
  request.mutable_options()->clear_unknown_space();
  Expect(Check(request), Code::kInvalidArgument, "options.unknown_space");
  request = GoodCheck(2);
  request.mutable_options()->set_padding_m(kNan);
  Expect(Check(request), Code::kInvalidArgument, "options.padding_m");
  request = GoodCheck(2);
  for (int i = 0; i < 4; ++i) request.mutable_options()->add_ignored_object_ids(1);
  Expect(Check(request), Code::kResourceExhausted, "options.ignored_object_ids");
  request = GoodCheck(2);
  request.mutable_world_from_link()->mutable_translations_m()->RemoveLast();
  Expect(Check(request), Code::kInvalidArgument, "world_from_link.translations_m");
  request = GoodCheck(2);
  request.mutable_world_from_link()->set_rotations_xyzw(4, kInfinity);
  Expect(Check(request), Code::kInvalidArgument, "world_from_link[1]");
  Expect(Check(GoodCheck(11)), Code::kResourceExhausted, "times_ns");
}

TEST_F(BadInput, Robots) {
  using Code = absl::StatusCode;
  const auto refused = [&](const Robot& robot) {
    v1::RegisterRobotRequest request;
    Write(robot, request.mutable_robot());
    v1::RegisterRobotResponse response;
    return Call(*check_, &v1::CheckService::Stub::RegisterRobot, request, &response);
  };
  Expect(refused({}), Code::kInvalidArgument, "robot.links");
  Expect(refused(Robot::SingleShape("x", Sphere{-1})), Code::kInvalidArgument,
         "robot.links[0].shapes[0].sphere.radius_m");
  Expect(refused(Robot::SingleShape("x", TriangleMesh{std::make_shared<Mesh>()})),
         Code::kInvalidArgument, "robot.links[0].shapes[0].mesh");
  auto broken = std::make_shared<Mesh>();
  broken->vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  broken->triangles = {{0, 1, 7}};
  Expect(refused(Robot::SingleShape("x", TriangleMesh{broken})), Code::kInvalidArgument,
         "robot.links[0].shapes[0].mesh.triangles[0]");
  v1::RegisterRobotResponse response;
  Expect(
      Call(*check_, &v1::CheckService::Stub::RegisterRobot, v1::RegisterRobotRequest(), &response),
      Code::kInvalidArgument, "robot");
}

TEST_F(BadInput, Occupancy) {
  using Code = absl::StatusCode;
  const auto points = [&](auto spoil) {
    v1::GetPointOccupancyRequest request;
    for (int i = 0; i < 6; ++i) request.add_points_m(1);
    request.add_times_ns(0);
    spoil(request);
    v1::GetPointOccupancyResponse response;
    return Call(*occupancy_, &v1::OccupancyService::Stub::GetPointOccupancy, request, &response);
  };
  EXPECT_TRUE(points([](auto&) {}).ok());
  Expect(points([](auto& r) { r.set_points_m(4, NAN); }), Code::kInvalidArgument, "points_m[3]");
  Expect(points([](auto& r) { r.add_points_m(1); }), Code::kInvalidArgument, "points_m");
  Expect(points([](auto& r) { r.clear_times_ns(); }), Code::kInvalidArgument, "times_ns");
  Expect(points([](auto& r) { r.mutable_times_ns()->Resize(3, 0); }), Code::kInvalidArgument,
         "times_ns");
  Expect(points([](auto& r) { r.mutable_points_m()->Resize(3003, 0); }), Code::kResourceExhausted,
         "points_m");
  const auto box = [&](const Aabb& box_W) {
    v1::GetBoxOccupancyRequest request;
    Write(box_W, request.mutable_box_world());
    request.add_times_ns(0);
    v1::GetBoxOccupancyResponse response;
    return Call(*occupancy_, &v1::OccupancyService::Stub::GetBoxOccupancy, request, &response);
  };
  EXPECT_TRUE(box({{0, 0, 0}, {1, 1, 1}}).ok());
  Expect(box({{0, 0, 0}, {-1, 1, 1}}), Code::kInvalidArgument, "box_world");
  Expect(box({{0, 0, 0}, {kNan, 1, 1}}), Code::kInvalidArgument, "box_world.max_m");
  Expect(box({{-1e300, 0, 0}, {1e300, 1, 1}}), Code::kResourceExhausted, "box_world");
  v1::CastRaysRequest rays;
  for (int i = 0; i < 3; ++i) rays.add_origins_m(0), rays.add_directions(0);
  rays.add_times_ns(0);
  rays.set_max_range_m(5);
  v1::CastRaysResponse response;
  const auto cast = [&] {
    return Call(*occupancy_, &v1::OccupancyService::Stub::CastRays, rays, &response);
  };
  Expect(cast(), Code::kInvalidArgument, "directions[0]");
  rays.set_directions(0, 1);
  EXPECT_TRUE(cast().ok());
  rays.set_max_range_m(0);
  Expect(cast(), Code::kInvalidArgument, "max_range_m");
}

TEST_F(BadInput, ObjectsLeasesAndVersions) {
  using Code = absl::StatusCode;
  v1::GetObjectRequest object;
  object.set_object_id(99);
  v1::GetObjectResponse object_response;
  const auto get = [&] {
    return Call(*objects_, &v1::ObjectService::Stub::GetObject, object, &object_response);
  };
  Expect(get(), Code::kNotFound, "object_id");
  object.mutable_selector()->set_min_version(1000);
  Expect(get(), Code::kFailedPrecondition, "selector.min_version");
  object.mutable_selector()->set_lease_id("none");
  Expect(get(), Code::kFailedPrecondition, "lease_id");
  v1::AcquireLeaseRequest lease;
  v1::AcquireLeaseResponse lease_response;
  const auto acquire = [&] {
    return Call(*leases_, &v1::LeaseService::Stub::AcquireLease, lease, &lease_response);
  };
  Expect(acquire(), Code::kInvalidArgument, "ttl_s");
  lease.set_ttl_s(kNan);
  Expect(acquire(), Code::kInvalidArgument, "ttl_s");
  lease.set_ttl_s(10);
  EXPECT_TRUE(acquire().ok());
  EXPECT_TRUE(acquire().ok());
  Expect(acquire(), Code::kResourceExhausted, "");
}

TEST_F(BadInput, Maps) {
  using Code = absl::StatusCode;
  v1::ExportMapRequest request;
  const auto exported = [&] {
    grpc::ClientContext context;
    v1::ExportMapResponse response;
    const auto stream = maps_->ExportMap(&context, request);
    while (stream->Read(&response)) {
    }
    return Explain(stream->Finish());
  };
  Expect(exported(), Code::kInvalidArgument, "format");
  request.set_format(v1::MAP_FORMAT_OT);
  Expect(exported(), Code::kInvalidArgument, "map");
  request.set_object_id(99);
  Expect(exported(), Code::kNotFound, "object_id");
  request.set_object_id(1);
  EXPECT_TRUE(exported().ok());
  const auto load = [&](v1::MapFormat format, const std::string& bytes) {
    grpc::ClientContext context;
    v1::LoadPriorResponse response;
    const auto stream = maps_->LoadPrior(&context, &response);
    v1::LoadPriorRequest piece;
    piece.set_format(format);
    piece.set_data(bytes);
    stream->Write(piece);
    stream->WritesDone();
    return Explain(stream->Finish());
  };
  EXPECT_EQ(load(v1::MAP_FORMAT_PLY, "x").code(), Code::kInvalidArgument);
  EXPECT_EQ(load(v1::MAP_FORMAT_BT, "not a tree").code(), Code::kInvalidArgument);
  EXPECT_EQ(load(v1::MAP_FORMAT_BT, "").code(), Code::kInvalidArgument);
  Expect(load(v1::MAP_FORMAT_OT, std::string(1001, 'x')), Code::kResourceExhausted, "data");
  v1::SetKeepOutRequest keep_out;
  for (int i = 0; i < 4; ++i) keep_out.add_boxes_world();
  v1::SetKeepOutResponse keep_out_response;
  Expect(Call(*maps_, &v1::MapService::Stub::SetKeepOut, keep_out, &keep_out_response),
         Code::kResourceExhausted, "boxes_world");
  v1::ClearRegionResponse clear_response;
  Expect(
      Call(*maps_, &v1::MapService::Stub::ClearRegion, v1::ClearRegionRequest(), &clear_response),
      Code::kInvalidArgument, "box_world");
}

TEST_F(BadInput, AStreamAnswersEachFrameAndLivesOn) {
  grpc::ClientContext context;
  const auto stream = ingest_->PushFrames(&context);
  v1::PushFramesRequest request;
  *request.mutable_frame() = Good();
  request.mutable_frame()->set_labels(0, -3);
  ASSERT_TRUE(stream->Write(request));
  request.set_wait_for(v1::ACK_LEVEL_DURABLE);
  ASSERT_TRUE(stream->Write(request));
  request.set_wait_for(static_cast<v1::AckLevel>(77));
  ASSERT_TRUE(stream->Write(request));
  stream->WritesDone();
  v1::PushFramesResponse response;
  ASSERT_TRUE(stream->Read(&response));
  Expect(FromProto(response.error()), absl::StatusCode::kInvalidArgument, "frame.labels[0]");
  ASSERT_TRUE(stream->Read(&response));
  EXPECT_EQ(ReasonOf(FromProto(response.error())), "NO_JOURNAL");
  ASSERT_TRUE(stream->Read(&response));
  Expect(FromProto(response.error()), absl::StatusCode::kInvalidArgument, "wait_for");
  EXPECT_FALSE(stream->Read(&response));
  EXPECT_TRUE(stream->Finish().ok());
}

TEST_F(BadInput, ClientsThatDieMidStreamLeaveNothingBehind) {
  for (int i = 0; i < 10; ++i) {
    grpc::ClientContext push_context, follow_context;
    const auto push = ingest_->PushFrames(&push_context);
    v1::PushFramesRequest request;
    *request.mutable_frame() = Good();
    request.mutable_frame()->set_labels(0, -3);
    push->Write(request);
    const auto follow = follow_->FollowScene(&follow_context, v1::FollowSceneRequest());
    v1::FollowSceneResponse response;
    EXPECT_TRUE(follow->Read(&response));
    push_context.TryCancel();
    follow_context.TryCancel();
    follow->Finish();
    push->Finish();
  }
  const ServerCore& core = server_.core();
  for (int i = 0; i < 500 && core.follow_streams + core.push_streams > 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_EQ(core.follow_streams, 0u);
  EXPECT_EQ(core.push_streams, 0u);
}

}  // namespace
}  // namespace clearway
