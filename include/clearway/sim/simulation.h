// A sensor in a simulated world, frame by frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clearway/base/time.h"
#include "clearway/io/frame_source.h"
#include "clearway/scene/frame.h"
#include "clearway/sim/sensor.h"
#include "clearway/sim/slam_noise.h"
#include "clearway/sim/trajectory.h"
#include "clearway/sim/world.h"

namespace clearway {

// What the simulated SLAM system says of the objects.
enum class ObjectReport { kMotions, kPoses, kNothing };

// A planning problem that a world poses. The robot is a box that stands on the ground, x forward,
// and may move from the stamp of planning_frame on.
struct CrossingTask {
  std::string name = {};
  Eigen::Vector3d robot_size_m{1.0, 0.7, 1.0};
  double max_speed_mps = 2.0;
  std::size_t planning_frame = 0;  // the last frame known when the plan is made
  // Where the middle of the robot's underside starts and shall arrive, on the ground.
  Eigen::Vector3d start_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d goal_W = Eigen::Vector3d::Zero();
  Duration time_limit = std::chrono::seconds(12);  // from the planning frame to the arrival
  ObjectId blocker = 0;  // what the straight line at full speed touches first
  Aabb area_W = {};      // a suggestion of where to search
};

// Everything that decides what a simulation yields. A plain value.
struct SimulationSpec {
  std::string name = {};
  World world = {};
  RangeSensor sensor = {};
  Trajectory sensor_trajectory = {};  // T_W_S

  std::size_t frame_count = 1;
  Duration period = std::chrono::milliseconds(100);  // between frames; above zero
  Time start = {};                                   // stamp of frame 0

  std::uint64_t seed = 1;
  SlamNoise noise = {};
  double range_noise_m = 0;  // standard deviation along the ray

  ObjectReport report = ObjectReport::kMotions;
  // Motions and poses only of objects with a point in the frame; else of all.
  bool report_visible_only = false;
  // Rays that meet nothing become points at the maximum range, label 0, marked in no_return.
  bool keep_no_return = false;

  double resolution_m = 0.1;  // voxel size that suits the world
  std::vector<CrossingTask> tasks = {};
};

// Makes frames out of a spec. Frames are motion-compensated: every ray is cast at the frame's stamp
// against the exact shapes. Motions start at the previous frame's stamp; frame 0 has none. A value
// that shares its innards; any thread may call any method.
class Simulation {
 public:
  explicit Simulation(SimulationSpec spec);

  const SimulationSpec& spec() const;
  const World& world() const { return spec().world; }
  std::size_t frame_count() const { return spec().frame_count; }
  Time StampOf(std::size_t k) const;
  // The sensor's true pose at frame k, and the one that frame k reports.
  Pose TrueT_W_S(std::size_t k) const;
  Pose ReportedT_W_S(std::size_t k) const;
  // The pose of the object as the SLAM system has it at frame k, or none for an unknown id.
  std::optional<Pose> ReportedT_W_B(ObjectId id, std::size_t k) const;

  // Depends on the spec and k alone, in whatever order frames are made. k < frame_count().
  Frame MakeFrame(std::size_t k) const;
  // The same with the sensor truly at T_W_S instead of on its trajectory: for a sensor whose way is
  // decided as it goes. The frame reports T_W_S with frame k's error.
  Frame MakeFrameFrom(const Pose& T_W_S, std::size_t k) const;

  // Stays valid when this object is gone. Reading past the end is OUT_OF_RANGE.
  FrameSource Frames() const;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

}  // namespace clearway
