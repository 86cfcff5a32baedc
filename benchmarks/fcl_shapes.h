// Robots for collision benchmarks, and FCL's answers for them.
#pragma once

#include <octomap/OcTree.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "clearway/geometry/pose.h"
#include "clearway/geometry/shape.h"

namespace clearway::bench {

struct NamedShape {
  std::string name;
  Shape shape;
};
// A box of 4 x 1.8 x 1.5 m, a sphere of 0.3 m, a capsule of 0.2 x 0.8 m, and a closed mesh of 1,000
// triangles about 1 m across.
std::vector<NamedShape> BenchShapes();

// FCL's collision geometry of the shape against an fcl::OcTree.
class FclChecker {
 public:
  FclChecker(const Shape& shape, std::shared_ptr<const octomap::OcTree> tree);
  ~FclChecker();
  bool Collides(const Pose& T_W_G) const;
  // Beyond up_to_m FCL need not search.
  double Distance(const Pose& T_W_G, double up_to_m = std::numeric_limits<double>::max()) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace clearway::bench
