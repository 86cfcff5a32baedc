// Rays through a window of bits, step by step.
#pragma once

#include <cstdint>
#include <span>

#include "base/lanes.h"

namespace clearway {

// Eight rays that WalkRay would walk, a lane each, in the terms of a BitWindow. One that ends in
// its first voxel goes nowhere.
struct WindowRays {
  LaneDoubles t_max[3];    // where the ray leaves its voxel along x, y, z: metres from its origin
  LaneDoubles t_delta[3];  // metres of the ray from border to border
  LaneDoubles length_m;
  LaneInts stride[3];  // what a step adds to the index
  LaneInts index;      // of the origin's voxel
  LaneInts end;        // of the end voxel
};

// Sets the bit of every voxel that one of the rays visits: WalkRay's voxels, decision for decision.
// All implementations set the same bits.
using WindowWalk = void (*)(std::span<const WindowRays> rays, std::uint32_t* words);

// A few rays at a time, without branches that a processor cannot foresee.
void WalkWindowPortable(std::span<const WindowRays> rays, std::uint32_t* words);

// Many rays at a time: the next step of one does not wait for that of another. Only for processors
// of which HasAvx512() is true.
void WalkWindowAvx512(std::span<const WindowRays> rays, std::uint32_t* words);

// Eight rays at a time, which begin together and wait for the last of them: faster for rays of a
// few voxels each, of which neighbours are about as long. Only where HasAvx512() is true.
void WalkWindowAbreastAvx512(std::span<const WindowRays> rays, std::uint32_t* words);

// The fastest one for this processor: for any rays, and for short ones.
WindowWalk FastestWindowWalk();
WindowWalk FastestShortWindowWalk();

}  // namespace clearway
