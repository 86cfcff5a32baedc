// Meshes for simulated worlds.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "clearway/geometry/shape.h"

namespace clearway {

// The solid that a profile in the x-z plane sweeps along y, width_m wide and centred at y = 0: a
// closed mesh, outside counter-clockwise. The profile runs counter-clockwise seen against the y
// axis (from -y), and its first point sees all of it.
std::shared_ptr<const Mesh> Extruded(const std::vector<Eigen::Vector2d>& profile_xz,
                                     double width_m);

}  // namespace clearway
