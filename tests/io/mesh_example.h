// Mesh files in the forms that Blender writes: two tetrahedra, the second one beside the first.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>

#include "absl/strings/str_cat.h"

namespace clearway {

// A box, a cylinder and so on in COLLADA by Blender: a geometry.
inline std::string DaeGeometry(const std::string& id, const std::string& triangles) {
  const std::string mesh = id + "-mesh";
  return absl::StrCat(R"(    <geometry id=")", mesh, R"(" name=")", id, R"(">
      <mesh>
        <source id=")",
                      mesh, R"(-positions">
          <float_array id=")",
                      mesh, R"(-positions-array" count="12">0 0 0 1 0 0 0 1 0 0 0 1</float_array>
          <technique_common>
            <accessor source="#)",
                      mesh, R"(-positions-array" count="4" stride="3">
              <param name="X" type="float"/>
              <param name="Y" type="float"/>
              <param name="Z" type="float"/>
            </accessor>
          </technique_common>
        </source>
        <source id=")",
                      mesh, R"(-normals">
          <float_array id=")",
                      mesh, R"(-normals-array" count="3">0 0 1</float_array>
          <technique_common>
            <accessor source="#)",
                      mesh, R"(-normals-array" count="1" stride="3">
              <param name="X" type="float"/>
              <param name="Y" type="float"/>
              <param name="Z" type="float"/>
            </accessor>
          </technique_common>
        </source>
        <vertices id=")",
                      mesh, R"(-vertices">
          <input semantic="POSITION" source="#)",
                      mesh, R"(-positions"/>
        </vertices>
        )",
                      triangles, R"(
      </mesh>
    </geometry>
)");
}

inline std::string DaeInputs(const std::string& id) {
  return absl::StrCat(R"(<input semantic="VERTEX" source="#)", id, R"(-mesh-vertices" offset="0"/>
          <input semantic="NORMAL" source="#)",
                      id, R"(-mesh-normals" offset="1"/>
          )");
}

inline std::string DaeTriangles(const std::string& id) {
  return absl::StrCat(R"(<triangles material="red" count="4">
          )",
                      DaeInputs(id), R"(<p>0 0 2 0 1 0 0 0 1 0 3 0 1 0 2 0 3 0 2 0 0 0 3 0</p>
        </triangles>)");
}

inline std::string DaePolylist(const std::string& id) {
  return absl::StrCat(R"(<polylist count="4">
          )",
                      DaeInputs(id), R"(<vcount>3 3 3 3 </vcount>
          <p>0 0 2 0 1 0 0 0 1 0 3 0 1 0 2 0 3 0 2 0 0 0 3 0</p>
        </polylist>)");
}

inline std::string DaeNode(const std::string& id, const std::string& instance) {
  return absl::StrCat(R"(      <node id=")", id, R"(" name=")", id, R"(" type="NODE">
        )",
                      instance, R"(
      </node>
)");
}

inline std::string DaeInstance(const std::string& id) {
  return absl::StrCat(R"(<instance_geometry url="#)", id, R"(-mesh" name=")", id, R"(">
          <bind_material>
            <technique_common>
              <instance_material symbol="red" target="#red"/>
            </technique_common>
          </bind_material>
        </instance_geometry>)");
}

inline std::string Dae(const std::string& geometries, const std::string& nodes) {
  return absl::StrCat(R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset>
    <contributor><authoring_tool>Blender 3.4.1</authoring_tool></contributor>
    <unit name="meter" meter="1"/>
    <up_axis>Z_UP</up_axis>
  </asset>
  <library_cameras><camera id="Camera-camera" name="Camera"/></library_cameras>
  <library_effects><effect id="red-effect"><profile_COMMON/></effect></library_effects>
  <library_images/>
  <library_materials>
    <material id="red" name="red"><instance_effect url="#red-effect"/></material>
  </library_materials>
  <library_geometries>
)",
                      geometries, R"(  </library_geometries>
  <library_visual_scenes>
    <visual_scene id="Scene" name="Scene">
      <node id="Camera" name="Camera" type="NODE">
        <instance_camera url="#Camera-camera"/>
      </node>
)",
                      nodes, R"(    </visual_scene>
  </library_visual_scenes>
  <scene>
    <instance_visual_scene url="#Scene"/>
  </scene>
</COLLADA>
)");
}

inline std::string Dae() {
  return Dae(DaeGeometry("A", DaeTriangles("A")) + DaeGeometry("B", DaePolylist("B")),
             DaeNode("A", R"(<matrix sid="transform">1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>
        )" + DaeInstance("A")) +
                 DaeNode("B", R"(<translate sid="location">3 0 0</translate>
        <rotate sid="rotationZ">0 0 1 90</rotate>
        <scale sid="scale">1 1 2</scale>
        )" + DaeInstance("B")));
}

// The buffer of GltfJson: positions, normals, indices.
inline std::string GltfBuffer() {
  std::string buffer;
  constexpr std::array<float, 12> kPositions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  constexpr std::array<float, 12> kNormals = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
  constexpr std::array<std::uint16_t, 12> kIndices = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
  buffer.append(reinterpret_cast<const char*>(kPositions.data()), sizeof kPositions);
  buffer.append(reinterpret_cast<const char*>(kNormals.data()), sizeof kNormals);
  buffer.append(reinterpret_cast<const char*>(kIndices.data()), sizeof kIndices);
  return buffer;  // 48, 48 and 24 bytes
}

// Without a uri, as in .glb files.
inline nlohmann::json GltfJson() {
  return nlohmann::json::parse(R"({
    "asset": {"generator": "Khronos glTF Blender I/O v3.4.50", "version": "2.0"},
    "extensionsUsed": ["KHR_materials_ior"],
    "scene": 0,
    "scenes": [{"name": "Scene", "nodes": [0, 1, 2]}],
    "nodes": [{"mesh": 0, "name": "A"},
              {"mesh": 1, "name": "B", "translation": [3, 0, 0], "scale": [1, 1, 2],
               "rotation": [0, 0.7071067690849304, 0, 0.7071067690849304]},
              {"camera": 0, "name": "Camera"}],
    "cameras": [{"type": "perspective", "perspective": {"yfov": 0.4, "znear": 0.1}}],
    "materials": [{"doubleSided": true, "name": "red",
                   "extensions": {"KHR_materials_ior": {"ior": 1.45}},
                   "pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0.4}}],
    "meshes": [{"name": "A", "primitives": [
                 {"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2, "material": 0}]},
               {"name": "B", "primitives": [
                 {"attributes": {"POSITION": 3, "NORMAL": 1}, "indices": 4, "material": 0}]}],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
       "max": [1, 1, 1], "min": [0, 0, 0]},
      {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3"},
      {"bufferView": 2, "componentType": 5123, "count": 12, "type": "SCALAR"},
      {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
       "max": [1, 1, 1], "min": [0, 0, 0]},
      {"bufferView": 2, "componentType": 5123, "count": 12, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteLength": 48, "byteOffset": 0, "target": 34962},
                    {"buffer": 0, "byteLength": 48, "byteOffset": 48, "target": 34962},
                    {"buffer": 0, "byteLength": 24, "byteOffset": 96, "target": 34963}],
    "buffers": [{"byteLength": 120}]})");
}

inline std::string GltfText(nlohmann::json json, const std::string& uri) {
  json["buffers"][0]["uri"] = uri;
  return json.dump();
}

inline void AppendNumber(std::string& bytes, std::uint32_t number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

inline std::string Glb(const nlohmann::json& json) {
  std::string text = json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::string buffer = GltfBuffer();
  std::string glb = "glTF";
  AppendNumber(glb, 2);
  AppendNumber(glb, static_cast<std::uint32_t>(28 + text.size() + buffer.size()));
  AppendNumber(glb, static_cast<std::uint32_t>(text.size()));
  glb += "JSON" + text;
  AppendNumber(glb, static_cast<std::uint32_t>(buffer.size()));
  return glb + std::string("BIN\0", 4) + buffer;
}

}  // namespace clearway
