#include "clearway/io/ply.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "clearway/io/mesh_file.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using ::testing::HasSubstr;

constexpr std::size_t kVertexBytes = 19;

struct Vertex {
  Eigen::Vector3f p_W;
  std::array<std::uint8_t, 3> color;
  std::int32_t object;
};

Vertex VertexOf(const std::string& ply, std::size_t index) {
  const std::size_t begin = ply.find("end_header\n") + 11 + index * kVertexBytes;
  Vertex vertex;
  std::memcpy(vertex.p_W.data(), ply.data() + begin, 12);
  std::memcpy(vertex.color.data(), ply.data() + begin + 12, 3);
  std::memcpy(&vertex.object, ply.data() + begin + 15, 4);
  return vertex;
}

TEST(Ply, Empty) {
  const std::string dut = SerializePly({}, PlyStyle::kPoints);
  EXPECT_THAT(dut, HasSubstr("ply\nformat binary_little_endian 1.0\n"));
  EXPECT_THAT(dut, HasSubstr("element vertex 0\n"));
  EXPECT_TRUE(dut.ends_with("end_header\n"));
}

TEST(Ply, PointsLieAtTheCentresOfOccupiedVoxels) {
  VoxelMap map(0.5);
  map.Set({2, -1, 0}, map.model().clamp_max);
  map.Set({9, 9, 9}, map.model().clamp_min);  // free
  const PlyLayer layer{&map, Pose::Translation(10, 0, 0), 7, {1, 2, 3}};
  const std::string dut = SerializePly({&layer, 1}, PlyStyle::kPoints);
  EXPECT_THAT(dut, HasSubstr("element vertex 1\n"));
  const Vertex vertex = VertexOf(dut, 0);
  EXPECT_EQ(vertex.p_W, Eigen::Vector3f(11.25f, -0.25f, 0.25f));
  EXPECT_THAT(vertex.color, ::testing::ElementsAre(1, 2, 3));
  EXPECT_EQ(vertex.object, 7);
  EXPECT_EQ(dut.size(), dut.find("end_header\n") + 11 + kVertexBytes);
}

TEST(Ply, CubesAreClosedAndWoundOutwards) {
  TemporaryFolder folder;
  VoxelMap map(0.5);
  for (int i = 0; i < 27; ++i) map.Set({i % 3, i / 3 % 3, i / 9}, map.model().clamp_max);
  ASSERT_TRUE(WritePly(folder / "m.ply", map, PlyStyle::kCubes).ok());
  EXPECT_THAT(BytesOf(folder / "m.ply"), HasSubstr("element face 54\n"));
  const auto mesh = ReadMesh(folder / "m.ply");
  ASSERT_TRUE(mesh.ok()) << mesh.status();
  double volume = 0;
  for (const auto& [a, b, c] : mesh->triangles) {
    volume += mesh->vertices[a].dot(mesh->vertices[b].cross(mesh->vertices[c])) / 6;
  }
  EXPECT_NEAR(volume, 1.5 * 1.5 * 1.5, 1e-6);
  EXPECT_EQ(mesh->triangles.size(), 108u);
}

TEST(Ply, AnOriginIsAddedInDoublePrecision) {
  VoxelMap map(0.5);
  map.Set({2, -1, 0}, map.model().clamp_max);
  map.Set({3, -1, 0}, map.model().clamp_max);
  const PlyLayer layer{&map, {}, 7, {1, 2, 3}};
  const auto dut =
      WithOriginAdded(SerializePly({&layer, 1}, PlyStyle::kPoints), {500'000.125, 4'100'000, -1});
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_THAT(*dut, HasSubstr("comment origin 500000.125,4100000,-1 added to x, y, z\n"
                              "element vertex 2\nproperty double x\n"));
  constexpr std::size_t kRow = 24 + 7;
  const std::size_t begin = dut->find("end_header\n") + 11;
  ASSERT_EQ(dut->size(), begin + 2 * kRow);
  Eigen::Vector3d p;
  std::memcpy(p.data(), dut->data() + begin, 24);
  EXPECT_EQ(p, Eigen::Vector3d(500'001.375, 4'099'999.75, -0.75));
  EXPECT_EQ((*dut)[begin + 24], 1);
  std::memcpy(p.data(), dut->data() + begin + kRow, 24);
  EXPECT_EQ(p, Eigen::Vector3d(500'001.875, 4'099'999.75, -0.75));
}

TEST(Ply, AnOriginIsAddedToNothingElse) {
  const std::string ply = SerializePly({}, PlyStyle::kPoints);
  EXPECT_TRUE(WithOriginAdded(ply, {1, 2, 3}).ok());
  for (const std::string& bytes : {std::string(), ply.substr(0, 40), ply + "x", "x" + ply,
                                   SerializePly({}, PlyStyle::kCubes)}) {
    EXPECT_EQ(WithOriginAdded(bytes, {1, 2, 3}).status().code(),
              absl::StatusCode::kInvalidArgument);
  }
}

TEST(Ply, ObjectsHaveTheirColours) {
  EXPECT_EQ(PlyColorOf(kStaticLabel), PlyLayer().color);
  EXPECT_NE(PlyColorOf(1), PlyColorOf(2));
  EXPECT_EQ(PlyColorOf(3), PlyColorOf(3));
}

TEST(Ply, RefusesAPlaceThatCannotBeWritten) {
  TemporaryFolder folder;
  EXPECT_EQ(WritePly(folder / "no/folder/m.ply", VoxelMap(0.1), PlyStyle::kPoints).code(),
            absl::StatusCode::kUnavailable);
}

}  // namespace
}  // namespace clearway
