// glTF files that contradict themselves, refer to nothing or need what is not supported.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "absl/strings/escaping.h"
#include "clearway/io/mesh_file.h"
#include "io/assimp_import.h"
#include "io/mesh_example.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

absl::StatusOr<Mesh> Read(const std::string& name, const std::string& bytes) {
  const TemporaryFolder folder;
  folder.Write("a.bin", GltfBuffer());
  return ReadMesh(folder.Write(name, bytes));
}

std::string ErrorOf(const std::string& name, const std::string& bytes) {
  const auto mesh = Read(name, bytes);
  EXPECT_EQ(mesh.status().code(), absl::StatusCode::kInvalidArgument) << bytes;
  EXPECT_THAT(std::string(mesh.status().message()), HasSubstr(name + ": "));
  return std::string(mesh.status().message());
}

// What is said of the example with the value at the pointer ("/meshes/0") replaced.
std::string ErrorWith(const std::string& pointer, const Json& value) {
  Json json = GltfJson();
  json[Json::json_pointer(pointer)] = value;
  const std::string error = ErrorOf("a.gltf", GltfText(json, "a.bin"));
  ErrorOf("a.glb", Glb(json));
  return error;
}

std::string ErrorWithout(const std::string& parent, const std::string& key) {
  Json json = GltfJson();
  json.at(Json::json_pointer(parent)).erase(key);
  return ErrorOf("a.glb", Glb(json));
}

TEST(MeshContentGltf, Empty) {
  ErrorOf("a.gltf", "");
  ErrorOf("a.gltf", "[]");
  EXPECT_THAT(ErrorOf("a.gltf", "{}"), HasSubstr("asset.version"));
  EXPECT_THAT(ErrorWith("/scenes/0/nodes", Json::array()), HasSubstr("nodes[0]: it has a mesh, but "
                                                                     "is not in the scene"));
}

TEST(MeshContentGltf, PartsStandWhereTheirNodesPlaceThem) {
  const std::string data =
      "data:application/octet-stream;base64," + absl::Base64Escape(GltfBuffer());
  for (const auto& mesh :
       {Read("a.gltf", GltfText(GltfJson(), "a.bin")), Read("a.gltf", GltfText(GltfJson(), data)),
        Read("a.glb", Glb(GltfJson()))}) {
    ASSERT_TRUE(mesh.ok()) << mesh.status();
    EXPECT_EQ(mesh->triangles.size(), 8u);
    Aabb box;
    for (const Eigen::Vector3d& vertex : mesh->vertices) box.Extend(vertex);
    // The second one is scaled along z, turned from z to x, and moved by 3 m along x.
    EXPECT_LT((box.min - Eigen::Vector3d(0, 0, -1)).norm(), 1e-6);
    EXPECT_LT((box.max - Eigen::Vector3d(5, 1, 1)).norm(), 1e-6);
  }
}

TEST(MeshContentGltf, FilesAreReadWholeOrNotAtAll) {
  const TemporaryFolder folder;
  const std::string gltf = GltfText(GltfJson(), "a.bin"), buffer = GltfBuffer();
  // In this process: thousands of children take minutes.
  const auto is_read = [](const std::filesystem::path& path) {
    return ImportByAssimp(path, path.extension().string(), BytesOf(path), {}).ok();
  };
  const auto path = folder.Write("a.gltf", gltf);
  for (std::size_t size = 0; size <= buffer.size(); ++size) {
    folder.Write("a.bin", buffer.substr(0, size));
    EXPECT_EQ(is_read(path), size == buffer.size()) << size;
  }
  for (std::size_t size = 0; size < gltf.size(); ++size) {
    EXPECT_FALSE(is_read(folder.Write("a.gltf", gltf.substr(0, size)))) << size;
  }
  const std::string glb = Glb(GltfJson());
  for (std::size_t size = 0; size < glb.size(); ++size) {
    EXPECT_FALSE(is_read(folder.Write("a.glb", glb.substr(0, size)))) << size;
  }
  EXPECT_THAT(ErrorOf("a.glb", glb + "x"), HasSubstr("bytes and has"));
}

TEST(MeshContentGltf, RequiredExtensionsAreSupportedOrAboutLooks) {
  for (const char* name : {"EXT_mesh_gpu_instancing", "KHR_mesh_quantization",
                           "KHR_draco_mesh_compression", "EXT_meshopt_compression", "FOO_bar"}) {
    EXPECT_THAT(ErrorWith("/extensionsRequired", {name}),
                HasSubstr(absl::StrCat("extensionsRequired: \"", name, "\" is not supported")));
  }
  Json json = GltfJson();
  json["extensionsRequired"] = {"KHR_materials_unlit", "EXT_texture_webp"};
  EXPECT_TRUE(Read("a.glb", Glb(json)).ok());
  EXPECT_THAT(ErrorWith("/nodes/0/extensions", {{"EXT_mesh_gpu_instancing", Json::object()}}),
              HasSubstr("nodes[0]: EXT_mesh_gpu_instancing is not supported"));
}

TEST(MeshContentGltf, OnlyVersion2IsRead) {
  EXPECT_THAT(ErrorWith("/asset/version", "1.0"), HasSubstr("only version 2"));
  EXPECT_THAT(ErrorWith("/asset/version", 2), HasSubstr("only version 2"));
  std::string glb = Glb(GltfJson());
  glb[4] = 1;
  EXPECT_THAT(ErrorOf("a.glb", glb), HasSubstr("it is version 1 of glTF"));
}

TEST(MeshContentGltf, KeysStandOnce) {
  std::string text = GltfText(GltfJson(), "a.bin");
  text.insert(1, "\"nodes\": [],");
  EXPECT_THAT(ErrorOf("a.gltf", text), HasSubstr("'nodes' is given twice"));
}

TEST(MeshContentGltf, ReferencesAreWithinTheFile) {
  EXPECT_THAT(ErrorWith("/nodes/1/mesh", 2), HasSubstr("nodes[1]: names meshes[2] of 2"));
  EXPECT_THAT(ErrorWith("/nodes/1/mesh", -1), HasSubstr("nodes[1]: names meshes[-1] of 2"));
  EXPECT_THAT(ErrorWith("/nodes/1/mesh", "1"), HasSubstr("names meshes[\"1\"] of 2"));
  EXPECT_THAT(ErrorWith("/nodes/0/children", {7}), HasSubstr("nodes[0]: names nodes[7] of 3"));
  EXPECT_THAT(ErrorWith("/nodes/0/children", {0}), HasSubstr("nodes[0]: the scene has it twice"));
  EXPECT_THAT(ErrorWith("/scene", 1), HasSubstr("scene: names scenes[1] of 1"));
  EXPECT_THAT(ErrorWith("/meshes/1/primitives/0/indices", 9),
              HasSubstr("meshes[1].primitives[0]: names accessors[9] of 5"));
  EXPECT_THAT(ErrorWith("/accessors/0/bufferView", 3),
              HasSubstr("accessors[0]: names bufferViews"));
  EXPECT_THAT(ErrorWith("/bufferViews/0/buffer", 1), HasSubstr("bufferViews[0]: names buffers[1]"));
}

TEST(MeshContentGltf, WhatTheSceneLeavesOutIsMissed) {
  EXPECT_THAT(ErrorWith("/scenes/0/nodes", {0}), HasSubstr("nodes[1]: it has a mesh, but is not"));
  EXPECT_THAT(ErrorWithout("/nodes/1", "mesh"), HasSubstr("meshes[1]: no node of the scene has"));
  EXPECT_THAT(ErrorWithout("/meshes/1/primitives/0", "indices"), HasSubstr("4 corners make no"));
  EXPECT_THAT(ErrorWith("/meshes/1/primitives/0", GltfJson()["meshes"][0]["primitives"][0]),
              HasSubstr("accessors[3]: nothing refers to it"));
  Json json = GltfJson();
  json.erase("scene");
  EXPECT_TRUE(Read("a.glb", Glb(json)).ok());
  json["scenes"].push_back(json["scenes"][0]);
  EXPECT_THAT(ErrorOf("a.glb", Glb(json)), HasSubstr("scene: is missing, though there are 2"));
}

TEST(MeshContentGltf, MeshesHavePrimitivesOfTriangles) {
  EXPECT_THAT(ErrorWith("/meshes/1/primitives", Json::array()),
              HasSubstr("meshes[1]: it has no primitives"));
  EXPECT_THAT(ErrorWith("/meshes/1/primitives/0/mode", 1), HasSubstr("mode is 1; only 4, 5 and 6"));
  EXPECT_THAT(ErrorWithout("/meshes/1/primitives/0/attributes", "POSITION"),
              HasSubstr("it has no POSITION"));
}

TEST(MeshContentGltf, IndicesAreThoseOfVertices) {
  Json json = GltfJson();
  json["accessors"][3] = {
      {"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}};
  EXPECT_THAT(ErrorOf("a.glb", Glb(json)),
              HasSubstr("meshes[1]: 3 of its 4 triangles name vertices that are not there"));
}

TEST(MeshContentGltf, VerticesReachAsFarAsStated) {
  EXPECT_THAT(ErrorWith("/accessors/3/max/0", 2),
              HasSubstr("meshes[1]: its vertices reach from (0, 0, 0) to (1, 1, 1); their accessor "
                        "states min (0, 0, 0) and max (2, 1, 1)"));
}

TEST(MeshContentGltf, AccessorsFitTheirBuffers) {
  EXPECT_THAT(ErrorWith("/accessors/3/count", 5),
              HasSubstr("accessors[3]: it ends at byte 60 of bufferViews[0], which has 48 bytes"));
  EXPECT_THAT(ErrorWith("/accessors/3/byteOffset", 60000), HasSubstr("bufferViews[0]"));
  EXPECT_THAT(ErrorWith("/accessors/3/count", -1), HasSubstr("count is '-1'"));
  EXPECT_THAT(ErrorWith("/accessors/3/count", 1.5), HasSubstr("count is '1.5'"));
  EXPECT_THAT(ErrorWith("/bufferViews/0/byteStride", 4), HasSubstr("4 bytes apart"));
  EXPECT_THAT(ErrorWith("/bufferViews/2/byteLength", 100),
              HasSubstr("bufferViews[2]: it ends at byte 196 of buffers[0], which has 120 bytes"));
  EXPECT_THAT(ErrorWith("/accessors/3/componentType", 5122), HasSubstr("accessors[3]: type"));
  EXPECT_THAT(ErrorWith("/accessors/3/sparse", {{"count", 1}}),
              HasSubstr("accessors[3]: sparse accessors are not supported"));
  EXPECT_THAT(ErrorWith("/accessors/3/normalized", true), HasSubstr("normalized"));
  EXPECT_THAT(ErrorWithout("/accessors/3", "bufferView"), HasSubstr("bufferView is missing"));
}

TEST(MeshContentGltf, AllNumbersOfAViewAreInAnAccessor) {
  Json json = GltfJson();
  json["accessors"][2]["componentType"] = 5121;  // half of the shorts, as bytes
  json["accessors"][4]["componentType"] = 5121;
  EXPECT_THAT(ErrorOf("a.glb", Glb(json)), HasSubstr("bufferViews[2]: its last 12 bytes"));
  EXPECT_THAT(ErrorWith("/bufferViews/0/byteLength", 56), HasSubstr("are in no accessor"));
}

TEST(MeshContentGltf, OtherChunksAreIgnored) {
  const auto with_chunk = [](std::string chunk) {
    std::string bytes = Glb(GltfJson()) + chunk;
    const auto size = static_cast<std::uint32_t>(bytes.size());
    std::memcpy(bytes.data() + 8, &size, sizeof size);
    return bytes;
  };
  const std::string chunk("\4\0\0\0ABCDdata", 12);
  const auto mesh = Read("a.glb", with_chunk(chunk + chunk));
  EXPECT_TRUE(mesh.ok()) << mesh.status();
  EXPECT_THAT(ErrorOf("a.glb", with_chunk(chunk.substr(0, 10))), HasSubstr("chunk"));
}

TEST(MeshContentGltf, BuffersAreWhereTheySay) {
  Json json = GltfJson();
  EXPECT_THAT(ErrorOf("a.gltf", json.dump()), HasSubstr("buffers[0]: uri is missing"));
  const std::string data = "data:application/octet-stream;base64,";
  EXPECT_THAT(ErrorOf("a.gltf", GltfText(json, data + "!!!!")), HasSubstr("not base64"));
  EXPECT_THAT(ErrorOf("a.gltf", GltfText(json, data + "AAAA")), HasSubstr("120 bytes and has 3"));
  EXPECT_THAT(ErrorOf("a.gltf", GltfText(json, "data:,AAAA")), HasSubstr("not base64"));
  json["buffers"][0]["uri"] = "a.bin";
  EXPECT_THAT(ErrorOf("a.glb", Glb(json)), HasSubstr("must be in the file itself"));
}

TEST(MeshContentGltf, BuffersAreNotLookedForElsewhere) {
  EXPECT_THAT(ErrorOf("a.gltf", GltfText(GltfJson(), "../a.bin")), HasSubstr("cannot be read"));
  EXPECT_THAT(ErrorOf("a.gltf", GltfText(GltfJson(), "/a.bin")), HasSubstr("cannot be read"));
  const auto mesh = Read("a.gltf", GltfText(GltfJson(), "b/a.bin"));  // not the a.bin that is there
  EXPECT_EQ(mesh.status().code(), absl::StatusCode::kNotFound) << mesh.status();
}

TEST(MeshContentGltf, NamesOfBuffersMayBeEscaped) {
  const TemporaryFolder folder;
  folder.Write("a b%.bin", GltfBuffer());
  const auto mesh = ReadMesh(folder.Write("a.gltf", GltfText(GltfJson(), "a%20b%25.bin")));
  EXPECT_TRUE(mesh.ok()) << mesh.status();
  EXPECT_FALSE(ReadMesh(folder.Write("a.gltf", GltfText(GltfJson(), "a%2"))).ok());
}

TEST(MeshContentGltf, ValuesMayNestDeep) {
  constexpr std::size_t kDepth = 200'000;
  std::string text = "{\"extras\": ";
  text.append(kDepth, '[').append(kDepth, ']').append(",");
  text.append(GltfText(GltfJson(), "a.bin").substr(1));
  EXPECT_TRUE(Read("a.gltf", text).ok());
}

TEST(MeshContentGltf, TransformsAreWhole) {
  EXPECT_THAT(ErrorWith("/nodes/0/matrix", {1, 0, 0}), HasSubstr("matrix must be 16 numbers"));
  EXPECT_THAT(ErrorWith("/nodes/0/matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, "x", 0, 0, 1}),
              HasSubstr("nodes[0]: matrix must be 16 numbers"));
  EXPECT_THAT(ErrorWith("/nodes/0/matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2}),
              HasSubstr("nodes[0]: its matrix must be alone and end"));
  EXPECT_THAT(ErrorWith("/nodes/1/rotation/1", 0), HasSubstr("not a unit quaternion"));
  EXPECT_THAT(ErrorWith("/nodes/1/scale", {1, 1}), HasSubstr("scale must be 3 numbers"));
}

TEST(MeshContentGltf, ShapesThatAnArmatureOrShapeKeysChangeAreRefused) {
  EXPECT_THAT(ErrorWith("/nodes/0/skin", 0), HasSubstr("nodes[0]: skins are not supported"));
  EXPECT_THAT(ErrorWith("/nodes/0/weights", {0.5}), HasSubstr("weights of morph targets"));
  EXPECT_THAT(ErrorWith("/meshes/0/weights", {0.5}), HasSubstr("weights of morph targets"));
  Json json = GltfJson();
  json["meshes"][0]["weights"] = {0};
  EXPECT_TRUE(Read("a.glb", Glb(json)).ok());
}

}  // namespace
}  // namespace clearway
