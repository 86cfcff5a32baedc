// The faces of COLLADA geometries.
#pragma once

#include <cstdint>
#include <pugixml.hpp>
#include <vector>

#include "io/collada_text.h"

namespace clearway {

// Polygons, each with its number of corners, which are numbers of vertices.
struct ColladaFaces {
  std::vector<double> coordinates;  // x, y and z of a vertex after the other
  std::vector<std::uint32_t> sizes, corners;
};

// Reads the faces of a <geometry>; strips and fans become triangles. What is wrong goes to the
// text's error, a vertex that belongs to no face, line or point among it.
ColladaFaces ReadColladaGeometry(ColladaText& text, pugi::xml_node geometry);

}  // namespace clearway
