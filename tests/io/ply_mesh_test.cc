#include "io/ply_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "io/ply_mesh_reading.h"
#include "io/tetrahedra_example.h"

namespace clearway {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing_support::PlyErrorOf;
using testing_support::ReadPly;
using testing_support::With;

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

TEST(PlyMesh, Empty) {
  EXPECT_EQ(PlyErrorOf(""), "a.ply: the file is empty");
  const std::string none =
      "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\n"
      "property float y\nproperty float z\n";
  EXPECT_THAT(PlyErrorOf(none + "end_header\n"), HasSubstr("no element face: a cloud of points"));
  EXPECT_EQ(PlyErrorOf(none + "element face 0\nproperty list uchar int vertex_index\nend_header\n"),
            "a.ply: no triangle with an area");
}

TEST(PlyMesh, FilesOfEachFormatAreRead) {
  const auto ascii = ReadPly(AsciiPly());
  ASSERT_TRUE(ascii.ok()) << ascii.status();
  EXPECT_EQ(ascii->vertices.size(), 12u);
  EXPECT_EQ(ascii->triangles.size(), 12u);
  const auto windows = ReadPly(With(AsciiPly(), "\n", "\r\n"));
  ASSERT_TRUE(windows.ok()) << windows.status();
  EXPECT_EQ(*windows, *ascii);
  for (const bool big_endian : {false, true}) {
    const auto binary = ReadPly(BinaryPly(big_endian));
    ASSERT_TRUE(binary.ok()) << binary.status();
    EXPECT_THAT(binary->vertices, ElementsAre(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0, 1, 0),
                                              Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 0, 1)));
    EXPECT_EQ(binary->triangles, (Triangles{{0, 1, 2}, {0, 2, 3}, {2, 1, 3}, {1, 0, 3}}));
  }
}

TEST(PlyMesh, OtherElementsAndPropertiesArePassedOver) {
  for (const bool big_endian : {false, true}) {
    std::string ply = absl::StrCat(
        "ply\nformat binary_", big_endian ? "big" : "little",
        "_endian 1.0\nobj_info x\nelement camera 2\nproperty list ushort double k\n"
        "property char c\nelement vertex 3\nproperty short z\nproperty list uchar float w\n"
        "property double x\nproperty uchar red\nproperty int8 y\nelement empty 99\n"
        "element face 1\nproperty uchar flags\nproperty list uint ushort vertex_index\n"
        "property list uchar float texcoord\nelement edge 1\nproperty int vertex1\nend_header\n");
    const auto put = [&](auto value) { Put(ply, value, big_endian); };
    for (const std::uint16_t length : {2, 0}) {
      put(length);
      for (int i = 0; i < length; ++i) put(0.5);
      put(std::int8_t{-1});
    }
    for (int i = 0; i < 3; ++i) {
      put(static_cast<std::int16_t>(-300));
      put(static_cast<std::uint8_t>(i));
      for (int k = 0; k < i; ++k) put(1.5f);
      put(0.1 * i);
      put(std::uint8_t{255});
      put(static_cast<std::int8_t>(-i * i));
    }
    put(std::uint8_t{7});
    put(std::uint32_t{3});
    for (const std::uint16_t corner : {2, 1, 0}) put(corner);
    put(std::uint8_t{1});
    put(0.5f);
    put(std::int32_t{1});
    const auto mesh = ReadPly(ply);
    ASSERT_TRUE(mesh.ok()) << mesh.status();
    EXPECT_THAT(mesh->vertices,
                ElementsAre(Eigen::Vector3d(0.2, -4, -300), Eigen::Vector3d(0.1, -1, -300),
                            Eigen::Vector3d(0, 0, -300)));
    EXPECT_EQ(mesh->triangles, (Triangles{{0, 1, 2}}));
  }
}

TEST(PlyMesh, EqualVerticesAreJoinedAndTrianglesWithoutAreaLeftOut) {
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\n"
      "property float z\nelement face 3\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n1 0 0\n1 1 0\n-0 1 0\n3 0 1 2\n3 3 4 5\n3 0 1 3\n\n \n";
  const auto mesh = ReadPly(ply);
  ASSERT_TRUE(mesh.ok()) << mesh.status();
  EXPECT_EQ(mesh->vertices.size(), 4u);
  EXPECT_EQ(mesh->triangles, (Triangles{{0, 1, 2}, {1, 3, 2}}));
  EXPECT_THAT(PlyErrorOf(PlyFace({{1, 1, 1}, {2, 2, 2}, {3, 3, 3}})), HasSubstr("no triangle"));
}

TEST(PlyMesh, PolygonsAreCut) {
  MeshFileOptions options;
  options.scale = 0.5;
  const auto quad = ReadPly(PlyFace({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}), options);
  ASSERT_TRUE(quad.ok()) << quad.status();
  EXPECT_EQ(quad->triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(quad->vertices[2], Eigen::Vector3d(1, 1, 0));
  // A fan around the first corner would cover what is outside.
  const auto dart = ReadPly(PlyFace({{0, 0, 0}, {1, 2, 0}, {0, 1, 0}, {-1, 2, 0}}));
  ASSERT_TRUE(dart.ok()) << dart.status();
  EXPECT_EQ(dart->triangles.size(), 2u);
  const auto notch = ReadPly(PlyFace({{4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {0, 4, 0}, {0, 0, 0}}));
  ASSERT_TRUE(notch.ok()) << notch.status();
  double area = 0;
  for (const auto& [a, b, c] : notch->triangles) {
    const auto& v = notch->vertices;
    area += (v[b] - v[a]).cross(v[c] - v[a]).z() / 2;
    EXPECT_GT((v[b] - v[a]).cross(v[c] - v[a]).z(), 0);
  }
  EXPECT_DOUBLE_EQ(area, 10);
}

TEST(PlyMesh, FacesThatAreNotSimpleAreRefused) {
  EXPECT_THAT(PlyErrorOf(PlyFace({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 2, 0}})),
              HasSubstr("face 0 crosses or touches itself: export triangles"));
  const std::vector<Eigen::Vector3d> many(10'001, Eigen::Vector3d(1, 2, 3));
  EXPECT_THAT(PlyErrorOf(PlyFace(many)),
              HasSubstr("face 0 has a list of 10001 vertices; a face has 3"));
}

}  // namespace
}  // namespace clearway
