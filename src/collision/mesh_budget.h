// How much work it may be to make meshes ready.
#pragma once

#include <cstddef>
#include <cstdint>

namespace clearway {

// For one mesh. What it is not enough for is answered later, at length, and as exactly.
struct MeshBudget {
  double cells = 1 << 15;             // of its grid; 8 are always made
  std::uint64_t visits = 20'000'000;  // to boxes and triangles, for the distances of the cells
  std::uint64_t angles = 20'000'000;  // solid angles, for their sides
  std::size_t hull_corners = 20'000;  // a hull of more stays with FCL
};

}  // namespace clearway
