#include "io/mesh_bytes.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

namespace clearway {
namespace {

Mesh Tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 0.1, 0}, {0, 0, -1e300}},
          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

TEST(MeshBytes, Empty) {
  const auto dut = MeshFromBytes(MeshToBytes({}));
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(*dut, Mesh());
  EXPECT_FALSE(MeshFromBytes("").ok());
}

TEST(MeshBytes, AMeshIsTheSameAgain) {
  const auto dut = MeshFromBytes(MeshToBytes(Tetrahedron()));
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(*dut, Tetrahedron());
}

TEST(MeshBytes, NoMeshTakesMoreThanStated) {
  const Mesh apart = {std::vector<Eigen::Vector3d>(6, {1, 2, 3}), {{0, 1, 2}, {3, 4, 5}}};
  EXPECT_EQ(MeshToBytes(apart).size(), MaxMeshBytes(2));
  constexpr auto kMost = std::numeric_limits<std::uint64_t>::max();
  EXPECT_EQ(MaxMeshBytes(kMost), kMost);
  EXPECT_EQ(MaxMeshBytes(kMost / 80), kMost);
}

TEST(MeshBytes, OtherBytesAreRefused) {
  const std::string whole = MeshToBytes(Tetrahedron());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_FALSE(MeshFromBytes(whole.substr(0, size)).ok()) << size;
  }
  EXPECT_FALSE(MeshFromBytes(whole + '\0').ok());
  // Counts whose bytes would overflow, in turn of vertices and triangles.
  for (const std::size_t place : {0, 8}) {
    for (std::uint64_t count :
         {std::uint64_t{1} << 61, std::uint64_t{1} << 62, ~std::uint64_t{0}}) {
      std::string damaged = whole;
      count += 4;
      std::memcpy(damaged.data() + place, &count, sizeof count);
      EXPECT_FALSE(MeshFromBytes(damaged).ok()) << count;
    }
  }
}

TEST(MeshBytes, IndicesAndCoordinatesAreChecked) {
  Mesh mesh = Tetrahedron();
  mesh.triangles[3][1] = 4;
  EXPECT_FALSE(MeshFromBytes(MeshToBytes(mesh)).ok());
  mesh = Tetrahedron();
  mesh.vertices[3].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(MeshFromBytes(MeshToBytes(mesh)).ok());
}

}  // namespace
}  // namespace clearway
