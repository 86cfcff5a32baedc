// Mesh files as assimp exports them are read back.
#include <assimp/postprocess.h>
#include <gtest/gtest.h>

#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>

#include "clearway/io/mesh_file.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

// A tetrahedron and a cube of quadrangles.
constexpr char kObj[] =
    "o first\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\no second\n"
    "v 2 0 0\nv 3 0 0\nv 3 1 0\nv 2 1 0\nv 2 0 1\nv 3 0 1\nv 3 1 1\nv 2 1 1\n"
    "f 5 8 7 6\nf 9 10 11 12\nf 5 6 10 9\nf 6 7 11 10\nf 7 8 12 11\nf 8 5 9 12\n";

TEST(MeshExport, WhatAssimpWritesIsReadWhole) {
  const TemporaryFolder folder;
  const auto obj = folder.Write("a.obj", kObj);
  const auto whole = ReadMesh(obj);
  ASSERT_TRUE(whole.ok()) << whole.status();
  for (const auto& [format, name] :
       {std::pair("collada", "b.dae"), std::pair("gltf2", "b.gltf"), std::pair("glb2", "b.glb"),
        std::pair("obj", "b.obj"), std::pair("stl", "b.stl"), std::pair("stlb", "c.stl"),
        std::pair("ply", "b.ply"), std::pair("plyb", "c.ply")}) {
    Assimp::Importer importer;
    const aiScene* scene =
        importer.ReadFile(obj.string(), aiProcess_Triangulate | aiProcess_GenNormals);
    ASSERT_NE(scene, nullptr);
    const auto path = folder / name;
    ASSERT_EQ(Assimp::Exporter().Export(scene, format, path.string()), aiReturn_SUCCESS) << format;
    const auto mesh = ReadMesh(path);
    ASSERT_TRUE(mesh.ok()) << format << ": " << mesh.status();
    EXPECT_EQ(mesh->triangles.size(), whole->triangles.size()) << format;
    EXPECT_EQ(mesh->vertices.size(), whole->vertices.size()) << format;
  }
}

}  // namespace
}  // namespace clearway
