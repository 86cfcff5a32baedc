// Random solids as meshes, and what programs do to meshes.
#pragma once

#include <string>
#include <vector>

#include "clearway/geometry/shape.h"
#include "support/random.h"

namespace clearway {

// A solid of one or more closed meshes, that may overlap.
struct RandomSolid {
  std::string kind;
  std::vector<Mesh> parts;

  Mesh Joined() const;
  // By the number of faces that rays cross, whichever way these are turned.
  bool Contains(const Eigen::Vector3d& p) const;
  // Of the part nearest to the point, 0 inside.
  double DistanceTo(const Eigen::Vector3d& p) const;
};

// Convex hulls, dented balls, rings, extruded outlines with notches, several at once. About a metre
// across.
RandomSolid AnySolid(testing_support::Random& random);

// The same surface with faces turned and doubled at random, in another order, with vertices shared
// or not.
Mesh Damaged(const Mesh& mesh, testing_support::Random& random);

}  // namespace clearway
