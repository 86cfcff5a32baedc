// Queries, checks and maps that are refused.
#include "clearway/client/frame_sender.h"
#include "clearway/client/scene_client.h"
#include "clearway/io/octomap_file.h"
#include "server/bad_input.h"

namespace clearway {
namespace {

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

TEST_F(BadInput, Motions) {
  using Code = absl::StatusCode;
  const auto refused = [&](auto spoil) {
    v1::CheckMotionsRequest request = GoodMotion(3);
    spoil(request);
    return Check(request);
  };
  EXPECT_TRUE(refused([](auto&) {}).ok());
  Expect(refused([](auto& r) { r.set_robot_id("nobody"); }), Code::kNotFound, "robot_id");
  Expect(refused([](auto& r) { r.mutable_options()->clear_unknown_space(); }),
         Code::kInvalidArgument, "options.unknown_space");
  Expect(refused([](auto& r) { r.mutable_options()->set_padding_m(kInfinity); }),
         Code::kInvalidArgument, "options.padding_m");
  Expect(refused([](auto& r) { r.mutable_options()->set_clearance_up_to_m(1); }),
         Code::kInvalidArgument, "options.clearance_up_to_m");
  Expect(refused([](auto& r) { r.set_contact_resolution_m(0); }), Code::kInvalidArgument,
         "contact_resolution_m");
  Expect(refused([](auto& r) { r.set_knot_counts(0, 1); }), Code::kInvalidArgument,
         "knot_counts[0]");
  Expect(refused([](auto& r) { r.set_knot_counts(0, 4'000'000'000u); }), Code::kInvalidArgument,
         "times_ns");
  Expect(refused([](auto& r) { r.set_times_ns(2, 1); }), Code::kInvalidArgument, "times_ns[2]");
  Expect(refused([](auto& r) { r.add_deviations_m(1); }), Code::kInvalidArgument, "deviations_m");
  Expect(refused([](auto& r) { r.mutable_deviations_m()->Resize(3, -1); }), Code::kInvalidArgument,
         "deviations_m[0]");
  Expect(refused([](auto& r) { r.mutable_world_from_link()->set_translations_m(5, kNan); }),
         Code::kInvalidArgument, "world_from_link[1]");
  Expect(Check(GoodMotion(11)), Code::kResourceExhausted, "times_ns");
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
         "robot.links[0].shapes[0].mesh.triangles");
  Expect(refused(Robot::SingleShape("x", Sphere{99})), Code::kResourceExhausted, "robot.links");
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
  rays.set_max_range_m(5000);  // 25,000 voxels
  Expect(cast(), Code::kResourceExhausted, "max_range_m");
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
  Expect(load(v1::MAP_FORMAT_PLY, "x"), Code::kInvalidArgument, "format");
  Expect(load(v1::MAP_FORMAT_BT, "not a tree"), Code::kInvalidArgument, "data");
  Expect(load(v1::MAP_FORMAT_BT, ""), Code::kInvalidArgument, "data");
  Expect(load(v1::MAP_FORMAT_OT, std::string(1001, 'x')), Code::kResourceExhausted, "data");
  v1::SetKeepOutRequest keep_out;
  for (int i = 0; i < 4; ++i) keep_out.add_boxes_world();
  v1::SetKeepOutResponse keep_out_response;
  Expect(Call(*maps_, &v1::MapService::Stub::SetKeepOut, keep_out, &keep_out_response),
         Code::kResourceExhausted, "boxes_world");
  keep_out.clear_boxes_world();
  v1::AxisAlignedBox& flat = *keep_out.add_boxes_world();
  flat.mutable_min_m()->set_z(1);
  flat.mutable_max_m()->set_x(1);
  flat.mutable_max_m()->set_y(1);
  flat.mutable_max_m()->set_z(1);
  Expect(Call(*maps_, &v1::MapService::Stub::SetKeepOut, keep_out, &keep_out_response),
         Code::kInvalidArgument, "boxes_world[0].max_m.z");
  v1::ClearRegionResponse clear_response;
  Expect(
      Call(*maps_, &v1::MapService::Stub::ClearRegion, v1::ClearRegionRequest(), &clear_response),
      Code::kInvalidArgument, "box_world");
}

// Small questions with large answers.
TEST(ReplyLimits, PosesAndCountsThatWouldBeTooLargeAreRefusedBeforeTheyAreMade) {
  ServerConfig config = testing_support::SmallConfig();
  config.limits.max_message_bytes = 1 << 16;
  const testing_support::TestServer server(config);
  const auto connection = server.Connect();
  Frame frame = testing_support::FrameAt(1);
  testing_support::AddPoint(frame, 1, {3, 0, 0});
  ASSERT_TRUE(FrameSender(connection).Push(frame).ok());
  const SceneClient client(connection);
  std::vector<Time> times(1024);
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = Time(FromSeconds(0.001 * i));
  const ObjectId twice[] = {1, 1};
  EXPECT_TRUE(client.PredictPoses({twice, 1}, times).ok());
  const absl::Status two = client.PredictPoses(twice, times).status();
  EXPECT_TRUE(absl::IsResourceExhausted(two)) << two;
  EXPECT_EQ(FieldOf(two), "times_ns");
  times.resize(2049);
  const absl::Status box =
      client.OccupancyOfBox({{0, 0, 0}, {0.1, 0.1, 0.1}}, times, false).status();
  EXPECT_TRUE(absl::IsResourceExhausted(box)) << box;
  EXPECT_EQ(FieldOf(box), "times_ns");
}

// A prior that the maps have no room for, by itself or with what is there, changes nothing.
TEST(PriorLimits, APriorOfTooManyBlocksIsRefusedWhole) {
  ServerConfig config = testing_support::SmallConfig();
  config.limits.max_blocks = 100;
  const testing_support::TestServer server(config);
  const SceneClient client(server.Connect());
  const auto load = [&](int blocks) {
    VoxelMap prior(config.scene.resolution_m);
    for (int x = 0; x < blocks; ++x) prior.Set({8 * x, 0, 0}, 100);
    return client.LoadPrior(MapFormat::kBt, *SerializeOctomap(prior, OctomapFormat::kBinary))
        .status();
  };
  const std::string hash = server.Newest()->Hash();
  const absl::Status alone = load(101);
  EXPECT_TRUE(absl::IsResourceExhausted(alone)) << alone;
  EXPECT_NE(alone.message().find("limits.max_blocks 100"), std::string::npos) << alone;
  Frame frame = testing_support::FrameAt(1);
  testing_support::AddPoint(frame, kStaticLabel, {0, -3, 0});
  ASSERT_TRUE(FrameSender(server.Connect()).Push(frame).ok());
  const std::string with_frame = server.Newest()->Hash();
  EXPECT_NE(with_frame, hash);
  const absl::Status together = load(100);
  EXPECT_TRUE(absl::IsResourceExhausted(together)) << together;
  EXPECT_NE(together.message().find("the limit is 100"), std::string::npos) << together;
  EXPECT_EQ(server.Newest()->Hash(), with_frame);
  EXPECT_TRUE(load(90).ok());
}

}  // namespace
}  // namespace clearway
