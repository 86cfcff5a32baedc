// What planners ask of a checker.
#pragma once

#include "absl/status/status.h"
#include "clearway/base/time.h"
#include "clearway/collision/state_checker.h"

namespace clearway {

// What a plan is checked against, and how finely. A plain value.
struct PlanningOptions {
  CheckOptions check;
  // What contact_resolution_m is to MotionOptions.
  double contact_resolution_m = 0.01;
  // Where states are looked at and nothing is proved (CheckMotion): between two of a motion no
  // point of the robot moves further (half a voxel of 10 cm) ... Links that go on curves are proved
  // by legs of about that size.
  double step_m = 0.05;
  // ... and no more time passes: a robot that waits is checked as often as one that drives at 2
  // m/s. An object of v m/s is met within v * step / 2 of a checked pose: add that as padding where
  // it matters.
  Duration time_step = std::chrono::milliseconds(25);
  // Motions that would need more states are refused.
  int max_states_per_motion = 100'000;
  // How far clearance() looks.
  double clearance_up_to_m = 1.0;
};

// For motions: without what is only told of states.
MotionOptions MotionOptionsOf(const PlanningOptions& options);

// INVALID_ARGUMENT naming the field and the limit.
absl::Status Validate(const PlanningOptions& options, const Robot& robot);

}  // namespace clearway
