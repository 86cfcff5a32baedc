// Slow and plain answers about meshes, and points to ask about.
#pragma once

#include <algorithm>
#include <limits>

#include "clearway/geometry/distance.h"
#include "collision/test_meshes.h"
#include "support/random.h"

namespace clearway {

// By a look at every triangle.
inline double SlowSurfaceDistance(const Mesh& mesh, const Eigen::Vector3d& p) {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : mesh.triangles) {
    nearest_m = std::min(
        nearest_m, PointTriangleDistance(p, mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]));
  }
  return nearest_m;
}

// A point near the mesh, at times far off.
inline Eigen::Vector3d PointNear(const TestMesh& test, testing_support::Random& random) {
  return random.Vector(test.size_m * (random.Integer(0, 5) == 0 ? 4 : 1.3));
}

}  // namespace clearway
