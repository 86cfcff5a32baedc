#include "wire/plan_wire.h"

#include <gtest/gtest.h>

namespace clearway {
namespace {

PlanTask AnyTask(const ConfigurationSpace& space) {
  PlanTask task;
  task.space = space;
  task.area_W = {{-1, -2, 3}, {4, 5, 6}};
  task.max_speed_mps = 1.5;
  task.max_turn_radps = 2.5;
  task.start.assign(DimensionOf(space), 0.5);
  task.goal.assign(DimensionOf(space), 0.25);
  task.start_time = TimeFromNanoseconds(12);
  task.time_limit = std::chrono::milliseconds(1500);
  task.options.check.unknown = UnknownPolicy::kTolerated;
  task.options.check.max_unknown_fraction = 0.1;
  task.options.check.inflation_mps = 0.2;
  task.options.contact_resolution_m = 0.02;
  return task;
}

PlanTask ThereAndBack(const PlanTask& task) {
  v1::PlanRequest proto;
  Write(task, &proto);
  const auto read = ReadPlanTask(proto, {});
  EXPECT_TRUE(read.ok()) << read.status();
  return read.value_or(PlanTask{});
}

void ExpectSameButSpace(const PlanTask& dut, const PlanTask& task) {
  EXPECT_EQ(dut.space.index(), task.space.index());
  EXPECT_EQ(dut.max_speed_mps, task.max_speed_mps);
  EXPECT_EQ(dut.max_turn_radps, task.max_turn_radps);
  EXPECT_EQ(dut.start, task.start);
  EXPECT_EQ(dut.goal, task.goal);
  EXPECT_EQ(dut.start_time, task.start_time);
  EXPECT_EQ(dut.time_limit, task.time_limit);
  EXPECT_EQ(dut.options.check.unknown, task.options.check.unknown);
  EXPECT_EQ(dut.options.check.max_unknown_fraction, task.options.check.max_unknown_fraction);
  EXPECT_EQ(dut.options.check.inflation_mps, task.options.check.inflation_mps);
  EXPECT_EQ(dut.options.contact_resolution_m, task.options.contact_resolution_m);
}

TEST(PlanWire, TasksOnThePlaneAndInFlightComeBack) {
  const PlanTask plane = AnyTask(PlaneSpace{false, 0.3, 0.4, 0});
  const PlanTask plane_back = ThereAndBack(plane);
  ExpectSameButSpace(plane_back, plane);
  EXPECT_EQ(plane_back.area_W, plane.area_W);
  const auto& space = std::get<PlaneSpace>(plane_back.space);
  EXPECT_FALSE(space.turns);
  EXPECT_EQ(space.yaw_rad, 0.3);
  EXPECT_EQ(space.ground_z_m, 0.4);
  EXPECT_EQ(space.clearance_m, 0);
  for (const bool turns : {false, true}) {
    const PlanTask back = ThereAndBack(AnyTask(FlightSpace{turns}));
    ExpectSameButSpace(back, AnyTask(FlightSpace{turns}));
    EXPECT_EQ(std::get<FlightSpace>(back.space).turns, turns);
  }
}

TEST(PlanWire, ArmsComeBack) {
  ArmSpace arm;
  arm.T_W_B = Pose::Translation(1, 2, 3);
  arm.joints = {{Pose::Translation(0, 0, 1), {0, 1, 0}, -1, 1, 0.5},
                {Pose::Translation(0.5, 0, 0), {0, 0, 2}, -2, 3, 1}};
  const PlanTask back = ThereAndBack(AnyTask(arm));
  ExpectSameButSpace(back, AnyTask(arm));
  const auto& dut = std::get<ArmSpace>(back.space);
  EXPECT_EQ(dut.T_W_B, arm.T_W_B);
  ASSERT_EQ(dut.joints.size(), 2u);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(dut.joints[i].T_P_J, arm.joints[i].T_P_J);
    EXPECT_EQ(dut.joints[i].axis_J, arm.joints[i].axis_J);
    EXPECT_EQ(dut.joints[i].min_rad, arm.joints[i].min_rad);
    EXPECT_EQ(dut.joints[i].max_rad, arm.joints[i].max_rad);
    EXPECT_EQ(dut.joints[i].max_radps, arm.joints[i].max_radps);
  }
}

TEST(PlanWire, OutcomesComeBack) {
  for (const PlanStatus status :
       {PlanStatus::kFound, PlanStatus::kNotFound, PlanStatus::kStartBlocked,
        PlanStatus::kGoalBlocked, PlanStatus::kNoTimeToSpare}) {
    PlanOutcome outcome;
    outcome.version = 7;
    outcome.stamp = TimeFromNanoseconds(8);
    outcome.horizon = Duration(9);
    outcome.inflation_mps = 0.25;
    outcome.bound_multiple = 1.5;
    outcome.status = status;
    outcome.blocker.status = SpaceStatus::kOccupied;
    outcome.blocker.link = 2;
    outcome.blocker.object = 9;
    v1::PlanResponse proto;
    Write(outcome, &proto);
    const PlanOutcome dut = ReadOutcome(proto);
    EXPECT_EQ(dut.version, 7u);
    EXPECT_EQ(dut.stamp, outcome.stamp);
    EXPECT_EQ(dut.horizon, outcome.horizon);
    EXPECT_EQ(dut.inflation_mps, 0.25);
    EXPECT_EQ(dut.bound_multiple, 1.5);
    EXPECT_EQ(dut.status, status);
    EXPECT_EQ(dut.blocker.status, SpaceStatus::kOccupied);
    EXPECT_EQ(dut.blocker.link, 2);
    EXPECT_EQ(dut.blocker.object, 9);
  }
}

TEST(PlanWire, APlanThatDoesNotFitIsTheServersFault) {
  v1::PlannedPath proto;
  proto.add_times_ns(1);
  proto.add_configurations(0);
  const PlanTask task = AnyTask(PlaneSpace{});
  EXPECT_EQ(ReadPlan(proto, task, 1).status().code(), absl::StatusCode::kInternal);
  proto.add_configurations(0);
  proto.add_configurations(0);
  proto.mutable_certificate()->add_times_ns(1);
  EXPECT_EQ(ReadPlan(proto, task, 1).status().code(), absl::StatusCode::kInternal);
}

}  // namespace
}  // namespace clearway
