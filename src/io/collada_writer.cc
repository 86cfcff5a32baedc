#include "io/collada_writer.h"

#include <sstream>

#include "absl/strings/str_join.h"
#include "clearway/base/number_text.h"

namespace clearway {
namespace {

using Node = pugi::xml_node;

Node WithId(Node node, const std::string& id) {
  node.append_attribute("id") = id.c_str();
  return node;
}

Node AddInput(Node node, const char* semantic, const std::string& source) {
  Node input = node.append_child("input");
  input.append_attribute("semantic") = semantic;
  input.append_attribute("source") = ("#" + source).c_str();
  return input;
}

template <class It>
std::string Words(It begin, It end) {
  return absl::StrJoin(begin, end, " ", [](std::string* words, double number) {
    words->append(NumberText(static_cast<float>(number)));
  });
}

void AddPositions(Node mesh, const std::string& id, const std::vector<double>& coordinates) {
  Node source = WithId(mesh.append_child("source"), id + "-source");
  Node array = WithId(source.append_child("float_array"), id + "-array");
  array.append_attribute("count") = coordinates.size();
  array.text() = Words(coordinates.begin(), coordinates.end()).c_str();
  Node accessor = source.append_child("technique_common").append_child("accessor");
  accessor.append_attribute("source") = ("#" + id + "-array").c_str();
  accessor.append_attribute("count") = coordinates.size() / 3;
  accessor.append_attribute("stride") = 3;
  for (const char* const axis : {"X", "Y", "Z"}) {
    Node param = accessor.append_child("param");
    param.append_attribute("name") = axis;
    param.append_attribute("type") = "float";
  }
}

}  // namespace

ColladaWriter::ColladaWriter() {
  Node root = document_.append_child("COLLADA");
  root.append_attribute("version") = "1.4.1";
  asset_ = root.append_child("asset");
  geometries_ = root.append_child("library_geometries");
  scene_ = WithId(root.append_child("library_visual_scenes").append_child("visual_scene"), "scene");
  root.append_child("scene").append_child("instance_visual_scene").append_attribute("url") =
      "#scene";
}

void ColladaWriter::SetAsset(double metres_per_unit, const std::string& up_axis) {
  asset_.append_child("unit").append_attribute("meter") = NumberText(metres_per_unit).c_str();
  asset_.append_child("up_axis").text() = up_axis.c_str();
}

void ColladaWriter::AddGeometry(const std::string& id, const ColladaFaces& faces) {
  Node mesh = WithId(geometries_.append_child("geometry"), id).append_child("mesh");
  AddPositions(mesh, id, faces.coordinates);
  AddInput(WithId(mesh.append_child("vertices"), id + "-vertices"), "POSITION", id + "-source");
  Node polygons = mesh.append_child("polylist");
  polygons.append_attribute("count") = faces.sizes.size();
  AddInput(polygons, "VERTEX", id + "-vertices").append_attribute("offset") = 0;
  polygons.append_child("vcount").text() = absl::StrJoin(faces.sizes, " ").c_str();
  polygons.append_child("p").text() = absl::StrJoin(faces.corners, " ").c_str();
}

void ColladaWriter::AddInstance(const std::string& id, const Eigen::Affine3d& T_scene_geometry) {
  const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> matrix = T_scene_geometry.matrix();
  Node node = scene_.append_child("node");
  node.append_child("matrix").text() = Words(matrix.data(), matrix.data() + 16).c_str();
  node.append_child("instance_geometry").append_attribute("url") = ("#" + id).c_str();
}

std::string ColladaWriter::Text() const {
  std::ostringstream text;
  document_.save(text, "", pugi::format_raw);
  return std::move(text).str();
}

}  // namespace clearway
