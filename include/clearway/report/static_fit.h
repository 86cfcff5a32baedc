// How well the static map fits the true static world.
#pragma once

#include <cstdint>

#include "clearway/map/voxel_map.h"
#include "clearway/report/confusion.h"
#include "clearway/report/met_surfaces.h"
#include "clearway/sim/world.h"

namespace clearway {

// Counts of observed voxels. A voxel that a surface runs through is partly free, and rays that
// graze it clear it: so what is right may be off by one voxel, and what has to be occupied is where
// rays met a surface.
struct StaticFit {
  // In the map; and of these with such a place at most a voxel away in truth.
  std::int64_t occupied = 0, occupied_right = 0;
  std::int64_t free = 0, free_right = 0;
  // Where rays met a surface; and of these with an occupied voxel, itself or beside it.
  std::int64_t met = 0, met_found = 0;
  // With their centre outside of every static body; and of these with a free voxel likewise.
  std::int64_t truly_free = 0, free_found = 0;
  // What the map says, not to within a voxel but right there, of a grid over the blocks that it
  // has, every fourth voxel along each axis: of what is truly free as above, but unobserved voxels
  // too; and, as truly occupied, of all voxels where rays met a surface.
  Confusion grid;

  // Occupied voxels where nothing static is: trails of what moves, ghosts.
  std::int64_t Residual() const { return occupied - occupied_right; }
  // Shares of 0 to 1; NaN of nothing.
  double OccupiedPrecision() const { return Share(occupied_right, occupied); }
  double OccupiedRecall() const { return Share(met_found, met); }
  double FreePrecision() const { return Share(free_right, free); }
  double FreeRecall() const { return Share(free_found, truly_free); }

 private:
  static double Share(std::int64_t part, std::int64_t all) {
    return static_cast<double>(part) / static_cast<double>(all);
  }
};

StaticFit FitOf(const VoxelMap& map_W, const World& world, const MetSurfaces& met);

}  // namespace clearway
