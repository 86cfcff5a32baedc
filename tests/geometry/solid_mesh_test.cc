// What becomes of meshes whose faces are turned, doubled, loose or missing.
#include "clearway/geometry/solid_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "support/random.h"

namespace clearway {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing_support::Random;

Mesh Cube(const Eigen::Vector3d& center = Eigen::Vector3d::Zero(), double half_m = 0.5) {
  Mesh mesh;
  for (int corner = 0; corner < 8; ++corner) {
    mesh.vertices.push_back(center + half_m * Eigen::Vector3d(corner & 1 ? 1 : -1,
                                                              corner & 2 ? 1 : -1,
                                                              corner & 4 ? 1 : -1));
  }
  mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return mesh;
}

Mesh Both(Mesh a, const Mesh& b) {
  const auto shift = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& [i, j, k] : b.triangles) {
    a.triangles.push_back({i + shift, j + shift, k + shift});
  }
  return a;
}

void Turn(std::array<std::uint32_t, 3>& face) { std::swap(face[1], face[2]); }

Mesh InsideOut(Mesh mesh) {
  for (auto& face : mesh.triangles) Turn(face);
  return mesh;
}

Mesh TurnedAtRandom(Mesh mesh, unsigned seed) {
  Random random(seed);
  for (auto& face : mesh.triangles) {
    if (random.Integer(0, 1) == 1) Turn(face);
  }
  return mesh;
}

Mesh Soup(const Mesh& mesh, double jitter_m = 0) {
  Random random(7);
  Mesh soup;
  for (const auto& face : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    for (const std::uint32_t corner : face) {
      soup.vertices.push_back(mesh.vertices[corner] + random.Vector(jitter_m));
    }
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

SolidMesh Made(const Mesh& mesh) { return SolidMeshOf(std::make_shared<const Mesh>(mesh)); }

bool Holds(const SolidMesh& solid, const Eigen::Vector3d& p) {
  return Contains(TriangleMesh{solid.mesh}, p);
}

// That it holds the cube of 1 m round the origin and, if asked, nothing beside it.
void ExpectCube(const SolidMesh& dut, bool nothing_else = true) {
  Random random(1);
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d p = random.Vector(0.8);
    const double out_m = p.cwiseAbs().maxCoeff() - 0.5;
    if (out_m < -1e-4) {
      EXPECT_TRUE(Holds(dut, p)) << p.transpose() << ": " << dut.note;
    } else if (out_m > 1e-4 && nothing_else) {
      EXPECT_FALSE(Holds(dut, p)) << p.transpose() << ": " << dut.note;
    }
  }
}

TEST(SolidMesh, Empty) {
  EXPECT_EQ(SolidMeshOf(nullptr).mesh, nullptr);
  const auto none = std::make_shared<const Mesh>();
  EXPECT_EQ(SolidMeshOf(none).mesh, none);
  const auto flat = std::make_shared<const Mesh>(Mesh{{{0, 0, 0}, {1, 0, 0}}, {{0, 1, 1}}});
  EXPECT_EQ(SolidMeshOf(flat).mesh, flat);
}

TEST(SolidMesh, MeshesWithoutFaultsStayAsTheyAre) {
  for (const Mesh& mesh :
       {Cube(), Soup(Cube()), Both(Cube(), Cube({3, 0, 0})), Both(Cube(), Cube({0.3, 0.2, 0.1}))}) {
    const auto given = std::make_shared<const Mesh>(mesh);
    const SolidMesh dut = SolidMeshOf(given);
    EXPECT_EQ(dut.mesh, given);
    EXPECT_THAT(dut.note, IsEmpty());
  }
}

TEST(SolidMesh, TurnsFaces) {
  const SolidMesh inverted = Made(InsideOut(Cube()));
  ExpectCube(inverted);
  EXPECT_EQ(inverted.note, "12 of 12 faces turned");
  Mesh half = Cube();
  for (int i = 0; i < 6; ++i) Turn(half.triangles[i]);
  EXPECT_EQ(Made(half).note, "6 of 12 faces turned");
  ExpectCube(Made(half));
  for (unsigned seed = 0; seed < 50; ++seed) {
    ExpectCube(Made(TurnedAtRandom(Cube(), seed)));
    ExpectCube(Made(Soup(TurnedAtRandom(Cube(), seed))));
  }
}

TEST(SolidMesh, DropsDoubledFaces) {
  Mesh some = Cube();
  some.triangles.push_back({4, 6, 0});
  some.triangles.push_back({3, 1, 7});
  EXPECT_THAT(Made(some).note, HasSubstr("2 doubled faces dropped"));
  ExpectCube(Made(some));
  ExpectCube(Made(Both(Cube(), Cube())));
  ExpectCube(Made(Both(Cube(), InsideOut(Cube()))));
  ExpectCube(Made(TurnedAtRandom(Both(Both(Cube(), Cube()), Cube()), 3)));
  ExpectCube(Made(Both(Cube(), Soup(TurnedAtRandom(Cube(), 4), 1e-7))));
}

TEST(SolidMesh, WeldsVerticesThatRoundingMovedApart) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const SolidMesh dut = Made(Soup(TurnedAtRandom(Cube(), seed), 1e-7));
    ExpectCube(dut);
    EXPECT_THAT(dut.note, HasSubstr("close vertices welded"));
  }
}

// The cube, with four vertices on the border of one side that belong to that side alone.
Mesh CubeWithVerticesOnEdges() {
  Mesh mesh = Cube();
  mesh.triangles.erase(mesh.triangles.begin() + 10, mesh.triangles.end());
  const auto add = [&](double x, double y) {
    mesh.vertices.emplace_back(x, y, 0.5);
    return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  };
  const std::vector<std::uint32_t> border = {
      4, add(-0.2, -0.5), 5, add(0.5, -0.3), add(0.5, 0.1), 7, 6, add(-0.5, 0.17)};
  const std::uint32_t middle = add(0.1, 0);
  for (std::size_t i = 0; i < border.size(); ++i) {
    mesh.triangles.push_back({border[i], border[(i + 1) % border.size()], middle});
  }
  return mesh;
}

TEST(SolidMesh, SplitsEdgesAtVerticesOnThem) {
  const Mesh mesh = CubeWithVerticesOnEdges();
  for (unsigned seed = 0; seed < 20; ++seed) {
    const SolidMesh dut = Made(TurnedAtRandom(mesh, seed));
    ExpectCube(dut);
    EXPECT_THAT(dut.note, HasSubstr("edges split"));
  }
}

TEST(SolidMesh, CountsFacesAfterTheyWereSplit) {
  const Mesh mesh = InsideOut(CubeWithVerticesOnEdges());
  ASSERT_EQ(mesh.triangles.size(), 18u);  // of which each vertex on an edge splits one
  EXPECT_EQ(Made(mesh).note, "edges split at vertices on them; 22 of 22 faces turned");
}

TEST(SolidMesh, SeveralSolidsAreTurnedEach) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const SolidMesh apart = Made(Both(Cube(), TurnedAtRandom(Cube({3, 0, 0}), seed)));
    ExpectCube(apart);
    EXPECT_TRUE(Holds(apart, {3, 0, 0}));
    const SolidMesh overlapping = Made(Both(Cube(), InsideOut(Cube({0.5, 0.5, 0.5}))));
    ExpectCube(overlapping, false);
    EXPECT_TRUE(Holds(overlapping, {0.8, 0.8, 0.8}));
    EXPECT_FALSE(Holds(overlapping, {0.8, 0.8, -0.2}));
  }
}

TEST(SolidMesh, FillsCavities) {
  ExpectCube(Made(Both(Cube(), InsideOut(Cube({0, 0, 0}, 0.3)))));
  ExpectCube(Made(Both(InsideOut(Cube()), Cube({0, 0, 0}, 0.3))));
  ExpectCube(Made(TurnedAtRandom(Both(Cube(), Cube({0, 0, 0}, 0.3)), 8)));
}

// Two cubes of which the second is moved: corners at the same place are one.
TEST(SolidMesh, SolidsMayShareEdgesAndSides) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    for (const Eigen::Vector3d& at :
         {Eigen::Vector3d(1, 1, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(1, 1, 1)}) {
      const SolidMesh dut = Made(TurnedAtRandom(Both(Cube(), Cube(at)), seed));
      ExpectCube(dut, false);
      EXPECT_TRUE(Holds(dut, at)) << dut.note;
      EXPECT_TRUE(Holds(dut, at + Eigen::Vector3d(0.3, 0.4, -0.4))) << dut.note;
      EXPECT_FALSE(Holds(dut, {-0.2, 0.9, 0.1})) << dut.note;
      EXPECT_FALSE(Holds(dut, {0.6, -0.6, 0.1})) << dut.note;
    }
  }
}

// The sides that the cubes share are cut along the other diagonal.
TEST(SolidMesh, FacesThatLieOnEachOtherGiveAHull) {
  Mesh other = Cube({1, 0, 0});
  other.triangles[0] = {0, 4, 2};
  other.triangles[1] = {4, 6, 2};
  const SolidMesh dut = Made(TurnedAtRandom(Both(Cube(), other), 5));
  ExpectCube(dut, false);
  EXPECT_TRUE(Holds(dut, {1.2, 0.3, 0.2}));
  EXPECT_THAT(dut.note, HasSubstr("convex hull"));
}

TEST(SolidMesh, AHoleIsClosedByWindingNumbers) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    for (const std::size_t missing : {1, 2}) {
      Mesh mesh = TurnedAtRandom(Cube(), seed);
      mesh.triangles.resize(12 - missing);
      const SolidMesh dut = Made(mesh);
      ExpectCube(dut);
      EXPECT_THAT(dut.note, HasSubstr("the surface is open"));
    }
  }
}

TEST(SolidMesh, SeveralOpenSurfacesGiveTheirHull) {
  Mesh sides;  // of the cube, with gaps between them
  for (std::size_t side = 0; side < 6; ++side) {
    Mesh two = Cube();
    two.triangles = {two.triangles[2 * side], two.triangles[2 * side + 1]};
    if (side % 2 == 0) two = InsideOut(two);
    for (Eigen::Vector3d& v : two.vertices) v *= 1 + 1e-3 * static_cast<double>(side);
    sides = Both(sides, two);
  }
  const SolidMesh dut = Made(sides);
  ExpectCube(dut, false);
  EXPECT_THAT(dut.note, HasSubstr("12 faces replaced by their convex hull, as they are several"));
}

// A fin in the plane of nothing else stays a surface, and changes no inside.
TEST(SolidMesh, FinsStaySurfaces) {
  Mesh mesh = Cube();
  mesh.vertices.emplace_back(0.9, 0.9, 0);
  mesh.triangles.push_back({3, 7, 8});
  const SolidMesh dut = Made(TurnedAtRandom(mesh, 2));
  ExpectCube(dut);
  EXPECT_TRUE(BoundingBox(TriangleMesh{dut.mesh}).Contains({0.9, 0.9, 0}));
  EXPECT_FALSE(Holds(dut, {0.6, 0.61, 0}));
}

TEST(SolidMesh, FacesInAPlaneHaveNoInsideAndSaySo) {
  const Mesh sheet{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}};
  const Mesh apart{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}},
                   {{0, 1, 2}, {3, 4, 5}}};
  EXPECT_THAT(Made(sheet).note, HasSubstr("the surface is open"));
  EXPECT_THAT(Made(apart).note,
              HasSubstr("2 faces lie in a plane: they have a surface, but no inside"));
  for (const Mesh& mesh : {sheet, apart}) EXPECT_FALSE(Holds(Made(mesh), {0.2, 0.2, 0.1}));
}

// As a band with a half turn.
TEST(SolidMesh, OneSidedSurfacesGiveTheirHull) {
  Mesh band;
  constexpr std::uint32_t kCount = 20;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const double u = 2 * std::numbers::pi * i / kCount;
    for (const double across : {-0.2, 0.2}) {
      const double out_m = 0.5 + across * std::cos(u / 2);
      band.vertices.emplace_back(out_m * std::cos(u), out_m * std::sin(u),
                                 across * std::sin(u / 2));
    }
  }
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const bool last = i + 1 == kCount;
    const std::uint32_t a = 2 * i, b = a + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
    band.triangles.push_back({a, b, d});
    band.triangles.push_back({a, d, c});
  }
  const SolidMesh dut = Made(band);
  EXPECT_THAT(dut.note, HasSubstr("40 faces replaced by their convex hull"));
  EXPECT_TRUE(Holds(dut, {0, 0, 0}));
}

TEST(SolidMesh, FacesWithoutAreaChangeNothing) {
  Mesh mesh = TurnedAtRandom(Cube(), 6);
  mesh.vertices.emplace_back(-0.5, -0.5, 0.1);  // on the edge from 0 to 4
  mesh.triangles.push_back({0, 4, 4});
  mesh.triangles.push_back({0, 8, 4});
  mesh.triangles.push_back({2, 2, 2});
  ExpectCube(Made(mesh));
  EXPECT_EQ(Made(mesh).mesh->triangles.size(), 12u);
}

TEST(SolidMesh, TheSameMeshGivesTheSameSolid) {
  const Mesh mesh = Soup(TurnedAtRandom(Both(Cube(), Cube({1, 1, 0})), 9), 1e-7);
  EXPECT_EQ(*Made(mesh).mesh, *Made(mesh).mesh);
  EXPECT_EQ(Made(mesh).note, Made(mesh).note);
}

}  // namespace
}  // namespace clearway
