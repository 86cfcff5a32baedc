// Plans and watches that are refused.
#include <gmock/gmock.h>

#include "clearway/v1/plan_service.grpc.pb.h"
#include "server/bad_input.h"

namespace clearway {
namespace {

class BadPlans : public BadInput {
 protected:
  // One that would be found.
  v1::PlanRequest Good() const {
    v1::PlanRequest request;
    request.set_robot_id(robot_id_);
    request.mutable_options()->set_unknown_space(v1::UNKNOWN_SPACE_POLICY_FREE);
    request.mutable_plane();
    Write(Aabb{{-20, -20, 0}, {-10, -10, 0}}, request.mutable_area_world());
    request.set_max_speed_mps(1);
    for (const double value : {-15.0, -15.0}) request.add_start(value);
    for (const double value : {-12.0, -15.0}) request.add_goal(value);
    request.set_start_ns(ToNanoseconds(server_.Newest()->stamp));
    request.set_time_limit_s(30);
    request.set_budget_s(0.01);
    return request;
  }
  absl::Status Plan(const v1::PlanRequest& request) {
    return Drain(*plans_, &v1::PlanService::Stub::Plan, request);
  }
  template <class Spoil>
  absl::Status Spoilt(Spoil&& spoil) {
    v1::PlanRequest request = Good();
    spoil(request);
    return Plan(request);
  }
  template <class Stub, class Request, class Response>
  absl::Status Drain(Stub& stub,
                     std::unique_ptr<grpc::ClientReader<Response>> (Stub::*method)(
                         grpc::ClientContext*, const Request&),
                     const Request& request) {
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(30));
    const auto reader = (stub.*method)(&context, request);
    Response response;
    while (reader->Read(&response)) ++responses_;
    return Explain(reader->Finish());
  }

  std::unique_ptr<v1::PlanService::Stub> plans_ = v1::PlanService::NewStub(channel_);
  int responses_ = 0;
};

TEST_F(BadPlans, WhatIsWrongIsNamed) {
  using Code = absl::StatusCode;
  EXPECT_TRUE(Plan(Good()).ok());
  EXPECT_GE(std::exchange(responses_, 0), 2);  // a plan, and how it ended
  const auto invalid = [&](const char* field, auto&& spoil) {
    Expect(Spoilt(spoil), Code::kInvalidArgument, field);
  };
  invalid("space", [](auto& r) { r.clear_plane(); });
  invalid("options.unknown_space", [](auto& r) { r.mutable_options()->clear_unknown_space(); });
  invalid("options.padding_m", [](auto& r) { r.mutable_options()->set_padding_m(-1); });
  invalid("options.clearance_up_to_m",
          [](auto& r) { r.mutable_options()->set_clearance_up_to_m(1); });
  invalid("contact_resolution_m", [](auto& r) { r.set_contact_resolution_m(kNan); });
  invalid("area_world", [](auto& r) { r.clear_area_world(); });
  invalid("area_world.min_m",
          [](auto& r) { r.mutable_area_world()->mutable_min_m()->set_x(kNan); });
  invalid("area.x", [](auto& r) { r.mutable_area_world()->mutable_min_m()->set_x(-1e9); });
  invalid("max_speed_mps", [](auto& r) { r.set_max_speed_mps(0); });
  invalid("max_speed_mps", [](auto& r) { r.set_max_speed_mps(kNan); });
  invalid("max_turn_radps", [](auto& r) {
    r.mutable_plane()->set_turns(true);
    r.add_start(0);
    r.add_goal(0);
  });
  invalid("start", [](auto& r) { r.clear_start(); });
  invalid("start[1]", [](auto& r) { r.set_start(1, kInfinity); });
  invalid("goal[0]", [](auto& r) { r.set_goal(0, 0); });
  invalid("start_ns", [](auto& r) { r.set_start_ns(r.start_ns() - 1); });
  invalid("time_limit_s", [](auto& r) { r.set_time_limit_s(0); });
  const absl::Status long_limit = Spoilt([](auto& r) { r.set_time_limit_s(1e9); });
  Expect(long_limit, Code::kInvalidArgument, "time_limit_s");
  EXPECT_THAT(std::string(long_limit.message()),
              ::testing::HasSubstr("is 1e+09; it must be at most 3600"));
  invalid("time_limit_s", [](auto& r) { r.set_time_limit_s(1e300); });
  invalid("time_limit_s", [](auto& r) { r.set_time_limit_s(1); });  // too far for it
  invalid("start_ns", [](auto& r) { r.set_start_ns(kFarthest_ns); });
  invalid("budget_s", [](auto& r) { r.set_budget_s(kNan); });
  invalid("arm.world_from_base", [](auto& r) { r.mutable_arm(); });
  invalid("arm.joints", [](auto& r) { Write(Pose{}, r.mutable_arm()->mutable_world_from_base()); });
  Expect(Spoilt([](auto& r) { r.set_robot_id("nobody"); }), Code::kNotFound, "robot_id");
  Expect(Spoilt([](auto& r) { r.set_budget_s(1e6); }), Code::kResourceExhausted, "budget_s");
  EXPECT_EQ(responses_, 0);
}

TEST_F(BadPlans, WatchesToo) {
  using Code = absl::StatusCode;
  const auto refused = [&](auto&& spoil) {
    v1::WatchMotionsRequest request;
    *request.mutable_motions() = GoodMotion(3);
    spoil(request);
    return Drain(*check_, &v1::CheckService::Stub::WatchMotions, request);
  };
  Expect(refused([](auto& r) { r.clear_motions(); }), Code::kInvalidArgument, "motions");
  Expect(refused([](auto& r) { r.mutable_motions()->mutable_selector(); }), Code::kInvalidArgument,
         "motions.selector");
  Expect(refused([](auto& r) { r.mutable_motions()->set_times_ns(2, 1); }), Code::kInvalidArgument,
         "motions.times_ns[2]");
  Expect(refused([](auto& r) { r.mutable_motions()->mutable_options()->set_padding_m(kNan); }),
         Code::kInvalidArgument, "motions.options.padding_m");
  Expect(refused([](auto& r) { r.mutable_motions()->set_robot_id("nobody"); }), Code::kNotFound,
         "motions.robot_id");
  EXPECT_EQ(responses_, 0);
}

}  // namespace
}  // namespace clearway
