// The farthest of many points in a direction.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "clearway/geometry/aabb.h"

namespace clearway {

// Points in a frame G, of which those are known that may be the farthest in each of many narrow
// bundles of directions. Immutable; any number of threads may read it.
//
// Making it takes a time that grows with the number of points, whatever they are. Of those that
// cannot be sorted by direction, as all on a line, up to 20,000 are looked at one by one later, and
// more are replaced by the corners of the box around them in G.
class ExtremePoints {
 public:
  explicit ExtremePoints(std::vector<Eigen::Vector3d> points_G);

  // The smallest box around the points, or else around those corners, turned into a frame F. Its
  // origin is G's.
  Aabb BoxTurned(const Eigen::Matrix3d& R_F_G) const;

  // The point, or else the corner, that is farthest in a direction.
  const Eigen::Vector3d& Farthest(const Eigen::Vector3d& direction_G) const;

 private:
  // The directions through a square of one face of the cube around the origin: those with `sign`
  // for their coordinate on `axis`, and u to u + edge and v to v + edge on the two axes after it.
  struct Square {
    int axis;
    double sign, u, v, edge;
  };
  using Indices = std::vector<std::uint32_t>;

  bool Sort(int levels);
  void Split(const Square& square, const Indices& candidates, int level);
  Indices MayBeFarthest(const Square& square, const Indices& candidates) const;
  std::size_t SquareOf(const Eigen::Vector3d& direction) const;

  // Only while it is made.
  std::vector<Eigen::Vector3d> points_G_;
  std::vector<Indices> by_square_;
  std::size_t left_to_look_at_ = 0;

  int levels_ = 0;                    // a face is cut into 2^levels_ squares each way
  std::vector<std::uint32_t> first_;  // of each square in candidates_G_, and the end
  std::vector<Eigen::Vector3d> candidates_G_;
};

}  // namespace clearway
