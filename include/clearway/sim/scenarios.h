// Ready-made worlds by name.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/sim/simulation.h"

namespace clearway {

// Choices that every scenario offers. A plain value; default: exact, at full size.
struct ScenarioOptions {
  std::uint64_t seed = 1;  // of all noise, and of the worlds told below to depend on it
  SlamNoise noise = {};
  double range_noise_m = 0;
  ObjectReport report = ObjectReport::kMotions;
  bool report_visible_only = false;
  bool keep_no_return = false;

  std::optional<std::size_t> frame_count = {};  // default: the scenario's length
  std::optional<int> beams = {};                // LiDAR: 16, 32 or 64
  std::optional<int> azimuth_steps = {};        // LiDAR: rays per beam
  std::optional<int> image_width_px = {};       // camera; the height is 3/4 of it
};

// crossing: a road with traffic seen by a LiDAR at the roadside, 8 s at 10 Hz; a delivery robot has
//   to cross (tasks[0]). 0.1 m voxels.
// street: a drive of 480 m past 14 moving objects with a LiDAR on the roof, 10 Hz. 0.1 m voxels.
// lab: a room with swinging and turning boxes before a depth camera, 8 s at 15 Hz. 0.05 m voxels.
// small: a box, a cylinder and a wedge before a wall, seen by a small LiDAR: quick, for tests.
// occlusions: traffic, cyclists and pedestrians who go out of a LiDAR's sight behind walls and each
//   other, 20 s at 10 Hz; another world for each seed. 0.1 m voxels.
// queues: people and cyclists who look alike, one close behind the other, before that LiDAR;
//   another world for each seed, too. 0.1 m voxels.
// swaps: one goes behind a wall and another, of another shape, comes out where it would have; on
//   the LiDAR's other side the same one does. 11 s at 10 Hz; ten pairs of vehicles, people and
//   goods, both ways round, by the seed. 0.1 m voxels.
// far_swaps: the same 20 m farther off, where beams are two voxels apart and more.
// articulated: a truck whose trailer follows round a bend, cyclists who pedal, an excavator that
//   swings its boom, each part an object of its own that is told to be a part; a LiDAR that stands,
//   12 s at 10 Hz. 0.1 m voxels.
std::vector<std::string> ScenarioNames();

// NOT_FOUND for an unknown name, listing the known ones; INVALID_ARGUMENT naming the option.
absl::StatusOr<Simulation> MakeScenario(const std::string& name,
                                        const ScenarioOptions& options = {});

}  // namespace clearway
