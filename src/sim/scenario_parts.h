// What the ready-made worlds are built of. Their ground is at kGroundZM, in the middle of a voxel,
// so that rounding does not move it from one voxel to another.
#pragma once

#include <cstdint>
#include <string>

#include "clearway/sim/simulation.h"

namespace clearway {

inline constexpr double kGroundZM = -0.05;

// The worlds of scenarios.h, exact and at full size.
SimulationSpec CrossingSpec();
SimulationSpec StreetSpec();
SimulationSpec LabSpec();
SimulationSpec SmallSpec();
SimulationSpec OcclusionsSpec(std::uint64_t seed);
SimulationSpec QueuesSpec(std::uint64_t seed);
SimulationSpec SwapsSpec(std::uint64_t seed);
SimulationSpec FarSwapsSpec(std::uint64_t seed);
SimulationSpec ArticulatedSpec();

// At x, y, z, turned to the left about z.
Pose PlacedAt(double x_m, double y_m, double z_m, double yaw_rad = 0);
// A camera's pose at `eye` that looks at `target` (z forward, x right, y down). Not straight up or
// down.
Pose LookingAt(const Eigen::Vector3d& eye_W, const Eigen::Vector3d& target_W);
Time AtSeconds(double seconds);

// A static box, given by its middle.
Body StaticBox(std::string name, const Pose& T_W_B, const Eigen::Vector3d& size_m);
// A static upright cylinder on the ground.
Body Pole(std::string name, double x_m, double y_m, double radius_m, double height_m);
// A flat ground of side size_m about x, y.
Body Ground(double x_m, double y_m, double size_m, double ground_z_m = kGroundZM);

// Road users; B is at the middle of their box, x forward. Each kind's B is its k...HeightM above
// the ground's frame z = 0.
inline constexpr double kCarHeightM = 0.81;
inline constexpr double kVanHeightM = 1.25;
inline constexpr double kTruckHeightM = 1.75;
inline constexpr double kCyclistHeightM = 0.91;
inline constexpr double kPedestrianHeightM = 0.9;
Body Car(ObjectId id, Trajectory trajectory);         // 4.4 x 1.8 x 1.32 m, two boxes
Body Hatchback(ObjectId id, Trajectory trajectory);   // 4.0 x 1.7 x 1.32 m, a triangle mesh
Body Van(ObjectId id, Trajectory trajectory);         // 5.2 x 2.0 x 2.1 m
Body Truck(ObjectId id, Trajectory trajectory);       // 7.5 x 2.4 x 3.1 m, two boxes
Body Cyclist(ObjectId id, Trajectory trajectory);     // 1.7 x 0.44 x 1.78 m, a box and a capsule
Body Pedestrian(ObjectId id, Trajectory trajectory);  // radius 0.3 m, 1.74 m high

}  // namespace clearway
