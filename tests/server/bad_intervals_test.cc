// Questions about intervals that are refused, and one that nobody waits for.
#include <thread>

#include "server/bad_input.h"

namespace clearway {
namespace {

class BadIntervals : public BadInput {
 protected:
  v1::FindSafeIntervalsRequest GoodPlaces(int count) {
    v1::FindSafeIntervalsRequest request;
    request.set_robot_id(robot_id_);
    request.mutable_options()->set_unknown_space(v1::UNKNOWN_SPACE_POLICY_FREE);
    request.mutable_window()->set_until_ns(1'000'000'000);
    for (int i = 0; i < count; ++i) Append(Pose{}, request.mutable_world_from_link());
    return request;
  }
  v1::FindDepartureIntervalsRequest GoodEdge(int knots) {
    v1::FindDepartureIntervalsRequest request;
    *request.mutable_motions() = GoodMotion(knots);
    request.mutable_window()->set_until_ns(1'000'000'000);
    return request;
  }
  absl::Status Find(const v1::FindSafeIntervalsRequest& request) {
    v1::FindSafeIntervalsResponse response;
    return Call(*check_, &v1::CheckService::Stub::FindSafeIntervals, request, &response);
  }
  absl::Status Find(const v1::FindDepartureIntervalsRequest& request) {
    v1::FindDepartureIntervalsResponse response;
    return Call(*check_, &v1::CheckService::Stub::FindDepartureIntervals, request, &response);
  }
};

TEST_F(BadIntervals, Places) {
  using Code = absl::StatusCode;
  const auto refused = [&](auto spoil) {
    v1::FindSafeIntervalsRequest request = GoodPlaces(2);
    spoil(request);
    return Find(request);
  };
  EXPECT_TRUE(refused([](auto&) {}).ok());
  EXPECT_TRUE(refused([](auto& r) { r.clear_world_from_link(); }).ok());
  Expect(refused([](auto& r) { r.set_robot_id("nobody"); }), Code::kNotFound, "robot_id");
  Expect(refused([](auto& r) { r.mutable_selector()->set_lease_id("none"); }),
         Code::kFailedPrecondition, "lease_id");
  Expect(refused([](auto& r) { r.mutable_options()->clear_unknown_space(); }),
         Code::kInvalidArgument, "options.unknown_space");
  Expect(refused([](auto& r) { r.mutable_options()->set_padding_m(kInfinity); }),
         Code::kInvalidArgument, "options.padding_m");
  Expect(refused([](auto& r) { r.mutable_options()->set_clearance_up_to_m(1); }),
         Code::kInvalidArgument, "options.clearance_up_to_m");
  Expect(refused([](auto& r) { r.clear_window(); }), Code::kInvalidArgument, "window");
  Expect(refused([](auto& r) { r.mutable_window()->set_from_ns(2'000'000'000); }),
         Code::kInvalidArgument, "window.until_ns");
  Expect(refused([](auto& r) { r.mutable_window()->set_from_ns(INT64_MIN); }),
         Code::kInvalidArgument, "window.from_ns");
  Expect(refused([](auto& r) { r.mutable_window()->set_until_ns(INT64_MAX); }),
         Code::kInvalidArgument, "window.until_ns");
  Expect(refused([](auto& r) { r.set_look_every_ns(0); }), Code::kInvalidArgument, "look_every_ns");
  Expect(refused([](auto& r) { r.set_look_every_ns(-1); }), Code::kInvalidArgument,
         "look_every_ns");
  Expect(refused([](auto& r) { r.set_look_every_ns(1); }), Code::kInvalidArgument, "window");
  EXPECT_TRUE(refused([](auto& r) { r.set_look_every_ns(INT64_MAX); }).ok());
  Expect(
      refused([](auto& r) { r.mutable_world_from_link()->mutable_rotations_xyzw()->RemoveLast(); }),
      Code::kInvalidArgument, "world_from_link.rotations_xyzw");
  Expect(refused([](auto& r) { r.mutable_world_from_link()->set_translations_m(5, kNan); }),
         Code::kInvalidArgument, "world_from_link[1]");
  Expect(Find(GoodPlaces(11)), Code::kResourceExhausted, "world_from_link");
}

TEST_F(BadIntervals, PosesOfOtherLinks) {
  v1::RegisterRobotRequest robot;
  Write(Robot{"two", {{"a", {{Sphere{0.1}, Pose{}}}}, {"b", {{Sphere{0.1}, Pose{}}}}}},
        robot.mutable_robot());
  v1::RegisterRobotResponse response;
  ASSERT_TRUE(Call(*check_, &v1::CheckService::Stub::RegisterRobot, robot, &response).ok());
  v1::FindSafeIntervalsRequest request = GoodPlaces(3);
  request.set_robot_id(response.robot_id());
  Expect(Find(request), absl::StatusCode::kInvalidArgument, "world_from_link.rotations_xyzw");
}

TEST_F(BadIntervals, Edges) {
  using Code = absl::StatusCode;
  const auto refused = [&](auto spoil) {
    v1::FindDepartureIntervalsRequest request = GoodEdge(3);
    spoil(request, *request.mutable_motions());
    return Find(request);
  };
  EXPECT_TRUE(refused([](auto&, auto&) {}).ok());
  Expect(refused([](auto& r, auto&) { r.clear_motions(); }), Code::kInvalidArgument, "motions");
  Expect(refused([](auto&, auto& m) { m.set_robot_id("nobody"); }), Code::kNotFound,
         "motions.robot_id");
  Expect(refused([](auto&, auto& m) { m.mutable_options()->clear_unknown_space(); }),
         Code::kInvalidArgument, "motions.options.unknown_space");
  Expect(refused([](auto&, auto& m) { m.set_world_at_ns(0); }), Code::kInvalidArgument,
         "motions.world_at_ns");
  Expect(refused([](auto&, auto& m) { m.set_times_ns(2, 1); }), Code::kInvalidArgument,
         "motions.times_ns[2]");
  Expect(refused([](auto&, auto& m) { m.set_knot_counts(0, 1); }), Code::kInvalidArgument,
         "motions.knot_counts[0]");
  Expect(refused([](auto&, auto& m) { m.add_deviations_m(1); }), Code::kInvalidArgument,
         "motions.deviations_m");
  Expect(refused([](auto&, auto& m) { m.mutable_world_from_link()->set_translations_m(5, kNan); }),
         Code::kInvalidArgument, "motions.world_from_link[1]");
  Expect(refused([](auto& r, auto&) { r.clear_window(); }), Code::kInvalidArgument, "window");
  Expect(refused([](auto& r, auto&) { r.mutable_window()->set_until_ns(-1); }),
         Code::kInvalidArgument, "window.until_ns");
  Expect(refused([](auto& r, auto&) { r.set_resolution_ns(0); }), Code::kInvalidArgument,
         "resolution_ns");
  Expect(refused([](auto& r, auto&) { r.set_resolution_ns(100); }), Code::kInvalidArgument,
         "window");
  const std::int64_t last_ns = kFarthest_ns;
  Expect(refused([&](auto& r, auto& m) {
           r.mutable_window()->set_from_ns(last_ns);
           r.mutable_window()->set_until_ns(last_ns);
           m.set_times_ns(2, last_ns);
         }),
         Code::kInvalidArgument, "window");
  Expect(Find(GoodEdge(11)), Code::kResourceExhausted, "motions.times_ns");
}

// What may stray into something is never free and never in contact: it takes all the proofs that
// there are, unless the server sees that nobody waits any more.
TEST_F(BadIntervals, TheSearchEndsWhenTheClientHasGone) {
  v1::FindDepartureIntervalsRequest request;
  v1::CheckMotionsRequest& motions = *request.mutable_motions();
  motions = GoodMotion(2);
  motions.set_times_ns(1, 1'000'000'000);
  motions.mutable_world_from_link()->set_translations_m(3, 1);
  motions.mutable_deviations_m()->Resize(2, 3);
  request.mutable_window()->set_until_ns(100'000'000'000);
  request.set_resolution_ns(1'000'001);
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::milliseconds(100));
  v1::FindDepartureIntervalsResponse response;
  const grpc::Status status = check_->FindDepartureIntervals(&context, request, &response);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (server_.core().open_calls.size() > 0 && std::chrono::steady_clock::now() < give_up) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(server_.core().open_calls.size(), 0u);
}

}  // namespace
}  // namespace clearway
