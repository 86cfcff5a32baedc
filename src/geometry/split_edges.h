// T-junctions of meshes.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "geometry/face_edges.h"

namespace clearway {

// The faces, cut so that an edge of one face alone ends at every vertex of other such edges that
// lies on it within the tolerance. The surface stays the same within the tolerance. Gives up early,
// with what is cut by then, if there is too much to look at.
std::vector<Face> SplitAtVerticesOnEdges(std::vector<Face> faces,
                                         const std::vector<Eigen::Vector3d>& points,
                                         double tolerance_m);

}  // namespace clearway
