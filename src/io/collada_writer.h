// COLLADA files of nothing but polygons.
#pragma once

#include <Eigen/Geometry>
#include <pugixml.hpp>
#include <string>

#include "io/collada_geometry.h"

namespace clearway {

// Writes a scene whose nodes each place one geometry. Numbers have the precision in which assimp
// reads them.
class ColladaWriter {
 public:
  ColladaWriter();

  // The up-axis is X_UP, Y_UP or Z_UP.
  void SetAsset(double metres_per_unit, const std::string& up_axis);
  // Once for each id.
  void AddGeometry(const std::string& id, const ColladaFaces& faces);
  void AddInstance(const std::string& id, const Eigen::Affine3d& T_scene_geometry);
  std::string Text() const;

 private:
  pugi::xml_document document_;
  pugi::xml_node asset_, geometries_, scene_;
};

}  // namespace clearway
