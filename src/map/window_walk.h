// Rays through a window of bits, step by step.
#pragma once

#include <cstdint>
#include <span>

#include "clearway/map/ray.h"
#include "map/bit_window.h"

namespace clearway {

// A ray that WalkRay would walk, in the terms of a BitWindow.
struct WindowRay {
  double t_max[3];    // where the ray leaves its voxel along x, y, z: metres from its origin
  double t_delta[3];  // metres of the ray from border to border
  double length_m;
  std::int32_t stride[3];  // what a step adds to the index
  std::int32_t index;      // of the origin's voxel
  std::int32_t end;        // of the end voxel
};
WindowRay InWindow(const RayStart& start, const BitWindow& window);

// Sets the bit of every voxel that one of the rays visits: WalkRay's voxels, decision for decision.
// All implementations set the same bits.
using WindowWalk = void (*)(std::span<const WindowRay> rays, std::uint32_t* words);

// A few rays at a time, without branches that a processor cannot foresee.
void WalkWindowPortable(std::span<const WindowRay> rays, std::uint32_t* words);

// Many rays at a time: the next step of one does not wait for that of another. Only for processors
// of which HasAvx512() is true.
void WalkWindowAvx512(std::span<const WindowRay> rays, std::uint32_t* words);
bool HasAvx512();

// The fastest one for this processor.
WindowWalk FastestWindowWalk();

}  // namespace clearway
