#include <gtest/gtest.h>

#include <limits>

#include "clearway/geometry/hull.h"
#include "support/random.h"
#include "wire/check_wire.h"
#include "wire/robot_wire.h"
#include "wire/scene_wire.h"
#include "wire/server_wire.h"
#include "wire/status.h"

namespace clearway {
namespace {

Robot EveryShape() {
  auto mesh = std::make_shared<Mesh>();
  mesh->vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh->triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  const auto hull = std::make_shared<const Mesh>(ConvexHullOf(mesh->vertices));
  const Pose T_L_G{Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitX())), {1, 2, 3}};
  return {"every",
          {{"a", {{Sphere{0.5}, T_L_G}, {Box{{1, 2, 3}}, T_L_G}, {Capsule{0.1, 2}, Pose{}}}},
           {"b",
            {{Cylinder{0.2, 3}, T_L_G}, {ConvexPolytope{hull}, T_L_G}, {TriangleMesh{mesh}, {}}}}}};
}

v1::Robot EveryShapeProto() {
  v1::Robot proto;
  Write(EveryShape(), &proto);
  return proto;
}

TEST(RobotWire, Empty) {
  const auto dut = ReadRobot("robot", v1::Robot(), ServerLimits{});
  ASSERT_TRUE(dut.ok()) << dut.status();  // that it has no links is for Validate to say
  EXPECT_EQ(FieldOf(Validate(*dut)), "links");
}

TEST(RobotWire, EveryShapeComesBackAsTheSameRobot) {
  const auto dut = ReadRobot("robot", EveryShapeProto(), ServerLimits{});
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_TRUE(Validate(*dut).ok()) << Validate(*dut);
  EXPECT_EQ(RobotId(*dut), RobotId(EveryShape()));
}

TEST(RobotWire, RefusesNamingTheField) {
  const auto refused = [](auto spoil) {
    v1::Robot proto = EveryShapeProto();
    spoil(proto);
    return FieldOf(ReadRobot("robot", proto, ServerLimits{}).status());
  };
  EXPECT_EQ(refused([](auto& r) { r.mutable_links(1)->mutable_shapes(0)->clear_shape(); }),
            "robot.links[1].shapes[0].shape");
  EXPECT_EQ(
      refused([](auto& r) { r.mutable_links(0)->mutable_shapes(1)->clear_link_from_shape(); }),
      "robot.links[0].shapes[1].link_from_shape");
  EXPECT_EQ(refused([](auto& r) {
              r.mutable_links(0)->mutable_shapes(1)->mutable_box()->clear_size_m();
            }),
            "robot.links[0].shapes[1].box.size_m");
  EXPECT_EQ(refused([](auto& r) {
              r.mutable_links(1)->mutable_shapes(2)->mutable_mesh()->add_vertices_m(1);
            }),
            "robot.links[1].shapes[2].mesh.vertices_m");
  EXPECT_EQ(refused([](auto& r) {
              r.mutable_links(1)->mutable_shapes(1)->mutable_convex()->add_triangles(1);
            }),
            "robot.links[1].shapes[1].convex.triangles");
}

TEST(RobotWire, RefusesMoreThanTheLimits) {
  ServerLimits limits;
  limits.max_links_per_robot = 1;
  EXPECT_TRUE(absl::IsResourceExhausted(ReadRobot("robot", EveryShapeProto(), limits).status()));
  limits = {};
  limits.max_triangles_per_robot = 7;
  EXPECT_TRUE(absl::IsResourceExhausted(ReadRobot("robot", EveryShapeProto(), limits).status()));
}

TEST(CheckWire, OptionsComeBack) {
  CheckOptions options;
  options.unknown = UnknownPolicy::kTolerated;
  options.max_unknown_fraction = 0.25;
  options.with_unknown_fraction = true;
  options.known_free_W = {{{0, 0, 0}, {1, 2, 3}}};
  options.padding_m = 0.1;
  options.inflation_mps = 0.2;
  options.bound_multiple = 1.5;
  options.inflate_moving_only = true;
  options.ignored_objects = {3, 4};
  options.allowed_contacts = {{0, 5}, {1, 0}};
  options.clearance_up_to_m = 0;
  v1::CheckOptions proto;
  Write(options, &proto);
  const auto dut = ReadCheckOptions("options", proto, ServerLimits{});
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->unknown, options.unknown);
  EXPECT_EQ(dut->max_unknown_fraction, 0.25);
  EXPECT_TRUE(dut->with_unknown_fraction);
  EXPECT_EQ(dut->known_free_W, options.known_free_W);
  EXPECT_EQ(dut->padding_m, 0.1);
  EXPECT_EQ(dut->inflation_mps, 0.2);
  EXPECT_EQ(dut->bound_multiple, 1.5);
  EXPECT_TRUE(dut->inflate_moving_only);
  EXPECT_EQ(dut->ignored_objects, options.ignored_objects);
  EXPECT_EQ(dut->allowed_contacts, options.allowed_contacts);
  EXPECT_EQ(dut->clearance_up_to_m, 0.0);
}

TEST(CheckWire, RefusesAPolicyThatIsNotStated) {
  const auto dut = ReadCheckOptions("options", v1::CheckOptions(), ServerLimits{});
  EXPECT_TRUE(absl::IsInvalidArgument(dut.status()));
  EXPECT_EQ(FieldOf(dut.status()), "options.unknown_space");
}

TEST(CheckWire, StatesComeBackBitForBit) {
  testing_support::Random random(2);
  StateBatch states;
  for (int i = 0; i < 10; ++i) {
    states.times.push_back(TimeFromNanoseconds(random.Integer(0, 1000000)));
    for (int l = 0; l < 3; ++l) states.T_W_L.push_back(random.AnyPose(5));
  }
  v1::CheckStatesRequest proto;
  WriteStates(states, 3, 0, 10, &proto);
  const auto dut = ReadStates(proto, 3, ServerLimits{});
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->times, states.times);
  EXPECT_EQ(dut->T_W_L, states.T_W_L);
}

TEST(CheckWire, RefusesStatesNamingTheField) {
  const StateBatch states{{Time{}, Time{}}, {Pose{}, Pose{}}};
  v1::CheckStatesRequest good;
  WriteStates(states, 1, 0, 2, &good);
  v1::CheckStatesRequest bad = good;
  EXPECT_EQ(FieldOf(ReadStates(bad, 2, ServerLimits{}).status()), "world_from_link.rotations_xyzw");
  bad.mutable_world_from_link()->set_rotations_xyzw(7, 0.5);
  EXPECT_EQ(FieldOf(ReadStates(bad, 1, ServerLimits{}).status()), "world_from_link[1].rotation");
  bad = good;
  bad.mutable_world_from_link()->set_translations_m(0, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(FieldOf(ReadStates(bad, 1, ServerLimits{}).status()), "world_from_link[0]");
  ServerLimits limits;
  limits.max_states_per_batch = 1;
  EXPECT_TRUE(absl::IsResourceExhausted(ReadStates(good, 1, limits).status()));
}

TEST(CheckWire, RepliesComeBack) {
  CheckReply reply{5, TimeFromNanoseconds(6), {}};
  for (SpaceStatus status :
       {SpaceStatus::kFree, SpaceStatus::kUnknownSpace, SpaceStatus::kBeyondHorizon,
        SpaceStatus::kOccupied, SpaceStatus::kOutOfBounds, SpaceStatus::kUnresolved}) {
    reply.answers.push_back({status, -1, 7, 0.5, 0.25});
  }
  v1::CheckStatesResponse proto;
  Write(reply, &proto);
  CheckOptions options;
  options.with_unknown_fraction = true;
  options.clearance_up_to_m = 1;
  const auto dut = ReadCheckReply(proto, 6, options);
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->version, 5u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(dut->answers[i].status, reply.answers[i].status);
    EXPECT_EQ(dut->answers[i].link, -1);
    EXPECT_EQ(dut->answers[i].object, 7);
    EXPECT_EQ(dut->answers[i].unknown_fraction, 0.5);
    EXPECT_EQ(dut->answers[i].clearance_m, 0.25);
  }
}

TEST(CheckWire, AReplyOfTheWrongLengthIsNoAnswer) {
  v1::CheckStatesResponse proto;
  Write(CheckReply{1, Time{}, {StateAnswer{}}}, &proto);
  EXPECT_TRUE(ReadCheckReply(proto, 1, {}).ok());
  EXPECT_TRUE(absl::IsInternal(ReadCheckReply(proto, 2, {}).status()));
  CheckOptions with_clearance, with_unknown;
  with_clearance.clearance_up_to_m = 1;
  EXPECT_TRUE(absl::IsInternal(ReadCheckReply(proto, 1, with_clearance).status()));
  with_unknown.with_unknown_fraction = true;
  EXPECT_TRUE(absl::IsInternal(ReadCheckReply(proto, 1, with_unknown).status()));
}

TEST(SceneWire, StatusesThatAreNotKnownAreNeverFree) {
  for (int proto : {0, 99, -1}) EXPECT_EQ(ReadSpaceStatus(proto), SpaceStatus::kUnresolved);
}

TEST(SceneWire, ParamsComeBack) {
  SceneParams params;
  params.resolution_m = 0.05;
  params.object_resolution_m = 0.07;
  params.occupancy = {0.8, 0.3, 0.2, 0.9, 0.6};
  params.rays = {12, true};
  params.solid = SolidMode::kVoxels;
  params.clear_objects_by_rays = true;
  params.motion = MotionModel::kTrack;
  params.motion_from_points = MotionFromPoints::kOn;
  params.horizon = std::chrono::seconds(1);
  params.object_lifetime = std::chrono::seconds(2);
  params.history = std::chrono::seconds(3);
  params.rest_distance_m = 0.2;
  params.rays.grazing_m = 4;
  params.object_pose_error_m = 0.57;
  params.object_pose_error_rad = 0.05;
  params.sensor_pose_error_m = 0.29;
  params.sensor_pose_error_rad = 0.04;
  params.reidentify = true;
  params.filter_labels = true;
  params.dynamic_life = std::chrono::milliseconds(400);
  params.dynamic_settle = std::chrono::seconds(3);
  params.keep_distance_m = 40;
  params.bounds_W = {{-1, -2, -3}, {4, 5, 6}};
  params.keep_out_W = {{{0, 0, 0}, {1, 1, 1}}};
  params.self_filter_S = {{{0, 0, 0}, {2, 2, 2}}, {{3, 3, 3}, {4, 4, 4}}};
  v1::SceneParams proto;
  Write(params, &proto);
  const auto dut = ReadSceneParams("params", proto);
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(*dut, params);
}

TEST(ServerWire, InfoComesBackWithEveryLimit) {
  ServerInfo info;
  info.software_version = "1.2.3";
  info.instance = "abc";
  std::uint64_t next = 100;
  ServerLimits& l = info.limits;
  for (std::uint64_t* limit : {&l.max_message_bytes,
                               &l.max_points_per_frame,
                               &l.max_ray_voxels,
                               &l.max_connections,
                               &l.max_memory_bytes,
                               &l.max_request_memory_bytes,
                               &l.max_blocks,
                               &l.max_objects,
                               &l.max_states_per_batch,
                               &l.max_points_per_query,
                               &l.max_robots,
                               &l.max_links_per_robot,
                               &l.max_triangles_per_robot,
                               &l.max_voxels_per_robot,
                               &l.max_leases,
                               &l.max_follow_streams,
                               &l.max_push_streams,
                               &l.max_frames_in_flight,
                               &l.max_queued_frames,
                               &l.max_remembered_answers,
                               &l.max_prior_bytes,
                               &l.max_boxes,
                               &l.max_calls,
                               &l.max_plans,
                               &l.max_watch_streams}) {
    *limit = next++;
  }
  l.max_coordinate_m = 1.5;
  l.max_lease_ttl_s = 2.5;
  l.max_version_wait_s = 3.5;
  l.max_planning_s = 4.5;
  l.max_stall_s = 5.5;
  l.max_idle_s = 6.5;
  l.max_peer_share = 0.25;
  v1::GetServerInfoResponse proto;
  Write(info, &proto);
  const auto dut = ReadServerInfo(proto);
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->software_version, "1.2.3");
  EXPECT_EQ(dut->instance, "abc");
  EXPECT_EQ(dut->limits, info.limits);
}

}  // namespace
}  // namespace clearway
