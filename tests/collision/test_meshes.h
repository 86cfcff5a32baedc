// Meshes for tests: closed, open, thin, tiny, huge, nested and degenerate ones.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "clearway/geometry/shape.h"

namespace clearway {

struct TestMesh {
  std::string name;
  std::shared_ptr<const Mesh> mesh;
  // The same set of points, without triangles that have no area.
  std::shared_ptr<const Mesh> regular;
  double size_m;  // about half its extent
};
std::vector<TestMesh> TestMeshes();

// A closed mesh round the origin, of 2 * rings * corners triangles, its radius given by the
// direction.
Mesh BallMesh(int rings, int corners,
              const std::function<double(const Eigen::Vector3d& direction)>& radius_m);

}  // namespace clearway
