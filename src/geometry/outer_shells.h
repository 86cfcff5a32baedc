// The outer sides of surfaces.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "geometry/face_edges.h"

namespace clearway {

enum class Side : std::uint8_t {
  kFront,    // the outside is where the corners are counter-clockwise
  kBack,     // it is on the other side
  kNone,     // the face is an inner wall
  kUnknown,  // the outside cannot be told from the inside
};

// Faces connected by edges.
struct Surface {
  std::vector<std::uint32_t> faces;
  bool closed;  // no face has an edge alone
};
std::vector<Surface> SurfacesOf(const std::vector<Face>& faces);

// For each of the faces on which side of it the outside is. At an edge of several faces a side
// faces that of the next one around the edge (as arrangements are cut into cells by Zhou et al.,
// "Mesh Arrangements for Solid Geometry", 2016). Of the parts of space that the sides of a closed
// surface bound, the outside is the one around the largest volume. An open surface has two sides,
// of which the one that more faces have in front is taken. All faces of a surface are kUnknown if
// that fails: it is one-sided, has no volume, or faces that share an edge lie on each other.
std::vector<Side> OuterSidesOf(const std::vector<Face>& faces, const std::vector<Surface>& surfaces,
                               const std::vector<Eigen::Vector3d>& points);

}  // namespace clearway
