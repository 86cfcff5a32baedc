// Quick answers of a shape against axis-aligned cubes.
#pragma once

#include <Eigen/Core>

#include "collision/narrowphase.h"

namespace clearway {

// A placed shape with a margin round it, asked about cubes of any size: voxels, and what holds many
// of them. Refers to the shape.
class CubeContact {
 public:
  CubeContact(const PlacedShape& shape, double margin_m) : shape_(shape), margin_m_(margin_m) {}

  // kNo and kYes are certain, with 1e-9 m to spare; kOpen is not known.
  enum class Answer { kNo, kYes, kOpen };
  Answer Of(const Eigen::Vector3d& center_F, double half_edge_m) const;

 private:
  const PlacedShape& shape_;
  double margin_m_;
};

}  // namespace clearway
