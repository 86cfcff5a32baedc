#include "clearway/io/mesh_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "io/mesh_example.h"
#include "support/data_folder.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using ::testing::HasSubstr;

constexpr char kTetrahedron[] =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

std::string BinaryStl(const std::vector<std::array<float, 9>>& triangles) {
  std::string stl(80, ' ');
  const std::uint32_t count = static_cast<std::uint32_t>(triangles.size());
  stl.append(reinterpret_cast<const char*>(&count), 4);
  for (const std::array<float, 9>& corners : triangles) {
    stl.append(12, '\0');
    stl.append(reinterpret_cast<const char*>(corners.data()), 36);
    stl.append(2, '\0');
  }
  return stl;
}

Aabb BoxAround(const Mesh& mesh) {
  Aabb box;
  for (const Eigen::Vector3d& vertex : mesh.vertices) box.Extend(vertex);
  return box;
}

double VolumeOf(const Mesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    volume += mesh.vertices[a].dot(mesh.vertices[b].cross(mesh.vertices[c])) / 6;
  }
  return volume;
}

std::string ErrorOf(const std::filesystem::path& path) {
  const auto mesh = ReadMesh(path);
  EXPECT_EQ(mesh.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(std::string(mesh.status().message()), HasSubstr(path.string()));
  return std::string(mesh.status().message());
}

TEST(MeshFile, Empty) {
  TemporaryFolder folder;
  for (const char* name : {"a.stl", "a.obj", "a.ply", "a.off", "a.dae", "a.gltf", "a.glb"}) {
    ErrorOf(folder.Write(name, ""));
  }
  EXPECT_EQ(ReadMesh(folder / "none.stl").status().code(), absl::StatusCode::kNotFound);
}

TEST(MeshFile, ReadsTriangles) {
  TemporaryFolder folder;
  const auto dut = ReadMesh(folder.Write("a.obj", kTetrahedron));
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->vertices.size(), 4u);
  EXPECT_EQ(dut->triangles.size(), 4u);
  EXPECT_NEAR(VolumeOf(*dut), 1.0 / 6, 1e-6);  // wound outwards
}

TEST(MeshFile, JoinsEqualVertices) {
  TemporaryFolder folder;
  const auto dut = ReadMesh(
      folder.Write("a.stl", BinaryStl({{0, 0, 0, 1, 0, 0, 0, 1, 0}, {1, 0, 0, 1, 1, 0, 0, 1, 0}})));
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->vertices.size(), 4u);
  EXPECT_EQ(dut->triangles.size(), 2u);
}

TEST(MeshFile, CutsPolygonsAndScales) {
  TemporaryFolder folder;
  MeshFileOptions options;
  options.scale = 0.01;
  const auto dut = ReadMesh(
      folder.Write("a.obj", "v 0 0 0\nv 100 0 0\nv 100 100 0\nv 0 100 0\nf 1 2 3 4\n"), options);
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->triangles.size(), 2u);
  EXPECT_TRUE(BoxAround(*dut).max.isApprox(Eigen::Vector3d(1, 1, 0), 1e-9));
}

TEST(MeshFile, MaterialsDoNotMatter) {
  TemporaryFolder folder;
  std::filesystem::create_directories(folder / "robots");
  // Neither a name nor a path by which assimp would look for the file of materials, nor what
  // stands there, makes a difference.
  for (const char* library : {"missing.mtl", "../mesh", "a/../../mesh/missing.mtl", "/dev/zero"}) {
    for (const char* name : {"foo.obj", "longname.obj"}) {
      folder.Write(std::string("mesh/") + name,
                   std::string("mtllib ") + library + "\nusemtl red\n" + kTetrahedron);
      for (const char* place : {"mesh/", "robots/../mesh/", "robots/..//mesh/"}) {
        const auto dut = ReadMesh(folder / (std::string(place) + name));
        ASSERT_TRUE(dut.ok()) << dut.status() << library;
        EXPECT_EQ(dut->triangles.size(), 4u);
      }
    }
  }
}

TEST(MeshFile, RefusesFolders) {
  TemporaryFolder folder;
  std::filesystem::create_directories(folder / "a.stl");
  EXPECT_THAT(ErrorOf(folder / "a.stl"), HasSubstr("is a folder"));
}

TEST(MeshFile, LeavesOutTrianglesWithoutArea) {
  TemporaryFolder folder;
  const auto dut = ReadMesh(
      folder.Write("a.stl", BinaryStl({{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 0, 0, 1, 1, 1, 2, 2, 2}})));
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->triangles.size(), 1u);
}

TEST(MeshFile, RefusesMeshesWithoutATriangle) {
  TemporaryFolder folder;
  EXPECT_THAT(ErrorOf(folder.Write("a.obj", "v 0 0 0\nv 1 1 1\nl 1 2\n")), HasSubstr("triangle"));
  EXPECT_THAT(ErrorOf(folder.Write("a.stl", BinaryStl({{1, 1, 1, 1, 1, 1, 1, 1, 1}}))),
              HasSubstr("triangle"));
}

TEST(MeshFile, RefusesPartsWithoutATriangle) {
  TemporaryFolder folder;
  const std::string flat = "o flat\nv 5 0 0\nv 6 0 0\nv 7 0 0\nf 5 6 7\n";
  EXPECT_THAT(ErrorOf(folder.Write("a.obj", kTetrahedron + flat)),
              HasSubstr("mesh 'flat' has no triangle with an area"));
}

TEST(MeshFile, RefusesPartsThatRoundingFlattens) {
  TemporaryFolder folder;
  nlohmann::json json = GltfJson();
  for (const double x : {4e9, 1e30}) {
    json["nodes"][1]["translation"][0] = x;
    EXPECT_THAT(ErrorOf(folder.Write("a.glb", Glb(json))), HasSubstr("loses its area")) << x;
  }
}

TEST(MeshFile, RefusesNumbersThatAreNotFinite) {
  TemporaryFolder folder;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  ErrorOf(folder.Write("a.stl", BinaryStl({{0, 0, 0, 1, 0, 0, 0, nan, 0}})));
}

TEST(MeshFile, RefusesOtherKinds) {
  TemporaryFolder folder;
  EXPECT_THAT(ErrorOf(folder.Write("a.xyz", kTetrahedron)), HasSubstr("the extension must be"));
  ErrorOf(folder.Write("b.dae", "<html><body>no</body></html>"));
  ErrorOf(folder.Write("c.glb", kTetrahedron));
}

TEST(MeshFile, RefusesWhatExceedsTheLimits) {
  TemporaryFolder folder;
  const auto path = folder.Write("a.obj", kTetrahedron);
  MeshFileOptions options;
  options.max_triangles = 3;
  EXPECT_EQ(ReadMesh(path, options).status().code(), absl::StatusCode::kResourceExhausted);
  options = {};
  options.max_bytes = 10;
  EXPECT_EQ(ReadMesh(path, options).status().code(), absl::StatusCode::kResourceExhausted);
  options = {};
  options.scale = 0;
  EXPECT_EQ(ReadMesh(path, options).status().code(), absl::StatusCode::kInvalidArgument);
}

// Text formats may be whole meshes when they are cut between two lines; binary ones never are.
TEST(MeshFile, SurvivesFilesCutOffAtAnyByte) {
  TemporaryFolder folder;
  const std::string stl = BinaryStl({{0, 0, 0, 1, 0, 0, 0, 1, 0}, {1, 0, 0, 1, 1, 0, 0, 1, 0}});
  for (std::size_t size = 0; size < stl.size(); ++size) {
    EXPECT_FALSE(ReadMesh(folder.Write("a.stl", stl.substr(0, size))).ok()) << size;
  }
  const std::string obj = kTetrahedron;
  for (std::size_t size = 0; size < obj.size(); ++size) {
    const auto dut = ReadMesh(folder.Write("a.obj", obj.substr(0, size)));
    if (!dut.ok()) continue;
    for (const auto& triangle : dut->triangles) {
      for (std::uint32_t index : triangle) EXPECT_LT(index, dut->vertices.size()) << size;
    }
  }
}

TEST(MeshFile, ReadsTheRealProblemsInTheirOwnCoordinates) {
  const auto path = DataPath("ompl/Easy_env.dae");
  if (!path) GTEST_SKIP() << "no recorded data";
  MeshFileOptions options;
  options.collada_y_up = true;  // as the bounds in Easy.cfg are
  const auto dut = ReadMesh(*path, options);
  ASSERT_TRUE(dut.ok()) << dut.status();
  const Aabb box = BoxAround(*dut);
  EXPECT_TRUE(box.min.isApprox(Eigen::Vector3d(14.4604492188, -24.25, -504.855102539), 1e-6));
  EXPECT_TRUE(box.max.isApprox(Eigen::Vector3d(457.960449219, 321.25, -72.8550872803), 1e-6));
  EXPECT_EQ(ReadMesh(*path)->triangles.size(), 174u);  // 176 in the file, 2 without area
  EXPECT_NEAR(BoxAround(*ReadMesh(*path)).max.y(), 504.855, 1e-3);  // as it stands in the file
}

TEST(MeshFile, SurvivesRealMeshesCutOffAnywhere) {
  const auto path = DataPath("ompl/Easy_robot.dae");
  if (!path) GTEST_SKIP() << "no recorded data";
  TemporaryFolder folder;
  const std::string whole = BytesOf(*path);
  ASSERT_TRUE(ReadMesh(*path).ok());
  for (std::size_t size = 0; size < whole.size() - 2; size += 211) {
    EXPECT_FALSE(ReadMesh(folder.Write("a.dae", whole.substr(0, size))).ok()) << size;
  }
}

}  // namespace
}  // namespace clearway
