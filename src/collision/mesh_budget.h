// How much work it may be to make meshes ready.
#pragma once

#include <cstddef>
#include <cstdint>

#include "clearway/collision/robot.h"

namespace clearway {

// For one mesh or hull. What it is not enough for is found later, query by query, and as exactly.
struct MeshBudget {
  double cells = 1 << 15;             // of its grid; 8 are always made
  std::uint64_t visits = 20'000'000;  // to boxes and triangles, for the distances of the cells
  std::uint64_t angles = 20'000'000;  // solid angles, for their sides
  std::size_t hull_corners = 10'000;  // a hull of more stays with FCL
};

// The cells that a grid has if the budget allows: few triangles need none as fine as many do.
double WantedCells(std::size_t triangles);

// Deals out what the meshes and hulls of a robot may take together, by the cells they want.
class BudgetShares {
 public:
  explicit BudgetShares(const Robot& robot);

  // To be called once for each of the robot's shapes.
  MeshBudget Next(const Shape& shape);

 private:
  double wanted_cells_ = 0;
  double hull_work_left_;
};

}  // namespace clearway
