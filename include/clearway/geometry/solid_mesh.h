// The solid that a triangle mesh encloses.
#pragma once

#include <memory>
#include <string>

#include "clearway/geometry/shape.h"

namespace clearway {

// A mesh for which Contains(TriangleMesh) holds inside of everything that the given mesh encloses.
struct SolidMesh {
  std::shared_ptr<const Mesh> mesh;  // the given one if nothing was changed
  std::string note;  // what was changed and why, for people; empty if the mesh is used as given
};

// Orients and cleans a mesh whose faces may be turned either way, doubled, or not welded:
//
// - Vertices within 1e-6 of the mesh's size are welded and edges split at vertices that lie on them
//   if the surface is not closed otherwise. Of faces with the same corners one is kept.
// - Each closed part is turned outward. Inner walls and cavities become solid. Where three and more
//   faces share an edge, those are neighbours that follow each other around it.
// - A single open surface is oriented consistently; winding numbers close its holes.
// - Where faces cannot be oriented (several open surfaces, one-sided surfaces, faces that lie on
//   each other), the convex hull of these faces takes their place.
//
// Indices must be valid; a mesh without triangles stays as it is. Takes time in proportion to n log
// n; the same mesh gives the same result on every machine.
SolidMesh SolidMeshOf(std::shared_ptr<const Mesh> mesh);

}  // namespace clearway
