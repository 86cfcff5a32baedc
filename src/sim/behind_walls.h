// What the worlds share in which objects go out of sight behind walls: a LiDAR that stands, and
// roads along x in front of it.
#pragma once

#include <string>

#include "sim/random.h"
#include "sim/scenario_parts.h"

namespace clearway {

struct Kind {
  Body (*make)(ObjectId, Trajectory);
  double height_m;  // of its origin above the ground
};

double Between(Random& random, double low, double high);
bool Heads(Random& random);

// Stands between the LiDAR and the roads.
Body WallBefore(double x_m, double width_m);
// As wide as one right before the LiDAR has to be to hide so much of a line along x, y_m from it.
double WallFor(double hidden_m, double y_m);

// From `T_W_B` on, speeding up and slowing down again and again, between those shares of its speed.
Drive UnevenDrive(Random& random, const Pose& T_W_B, double speed_mps, double slowest,
                  double fastest);

SimulationSpec BehindWalls(std::string name, World world);

}  // namespace clearway
