// COLLADA files that contradict themselves, refer to nothing or need what is not supported.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "absl/strings/str_replace.h"
#include "clearway/io/mesh_file.h"
#include "io/mesh_example.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using ::testing::HasSubstr;

absl::StatusOr<Mesh> Read(const std::string& bytes) {
  const TemporaryFolder folder;
  return ReadMesh(folder.Write("a.dae", bytes));
}

std::string ErrorOf(const std::string& bytes) {
  const auto mesh = Read(bytes);
  EXPECT_EQ(mesh.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(std::string(mesh.status().message()), HasSubstr("a.dae: "));
  return std::string(mesh.status().message());
}

std::string With(const std::string& from, const std::string& to) {
  const std::string whole = Dae();
  EXPECT_THAT(whole, HasSubstr(from));
  return absl::StrReplaceAll(whole, {{from, to}});
}

// The example with other primitives in its second part.
std::string WithPrimitives(const std::string& primitives) {
  const std::string old = DaePolylist("B");
  return With(old, primitives);
}

Aabb BoxAround(const Mesh& mesh) {
  Aabb box;
  for (const Eigen::Vector3d& vertex : mesh.vertices) box.Extend(vertex);
  return box;
}

TEST(MeshContentDae, Empty) {
  ErrorOf("");
  EXPECT_THAT(ErrorOf("<COLLADA version='1.4.1'/>"), HasSubstr("it has no <scene>"));
  EXPECT_THAT(ErrorOf(Dae("", "")), HasSubstr("it has no faces"));
}

TEST(MeshContentDae, PartsStandWhereTheirNodesPlaceThem) {
  const auto mesh = Read(Dae());
  ASSERT_TRUE(mesh.ok()) << mesh.status();
  EXPECT_EQ(mesh->triangles.size(), 8u);
  // The second one is scaled along z, turned from x to y, and moved by 3 m along x.
  EXPECT_TRUE(BoxAround(*mesh).min.isApprox(Eigen::Vector3d(0, 0, 0), 1e-6) ||
              BoxAround(*mesh).min.norm() < 1e-6);
  EXPECT_TRUE(BoxAround(*mesh).max.isApprox(Eigen::Vector3d(3, 1, 2), 1e-6));
}

TEST(MeshContentDae, UnitsApply) {
  const auto mesh = Read(With("meter=\"1\"", "meter=\"0.0254\""));
  ASSERT_TRUE(mesh.ok()) << mesh.status();
  EXPECT_NEAR(BoxAround(*mesh).max.x(), 3 * 0.0254, 1e-7);
  for (const char* unit : {"0", "-1", "nan", "inch", ""}) {
    EXPECT_THAT(ErrorOf(With("meter=\"1\"", absl::StrCat("meter=\"", unit, "\""))),
                HasSubstr("line 5: <unit>: meter is"));
  }
  EXPECT_THAT(ErrorOf(With("Z_UP", "Q_UP")), HasSubstr("X_UP"));
}

TEST(MeshContentDae, AllKindsOfPrimitivesMakeTheSameFaces) {
  const auto whole = Read(Dae());
  const std::string inputs = DaeInputs("B");
  for (const std::string& primitives :
       {DaeTriangles("B"),
        "<polygons count=\"4\">" + inputs +
            "<p>0 0 2 0 1 0</p><p>0 0 1 0 3 0</p><p>1 0 2 0 3 0</p><p>2 0 0 0 3 0</p></polygons>",
        "<trifans count=\"2\">" + inputs + "<p>0 0 2 0 1 0 3 0 2 0</p><p>1 0 2 0 3 0</p></trifans>",
        "<tristrips count=\"1\">" + inputs + "<p>0 0 2 0 1 0 3 0 0 0 2 0</p></tristrips>"}) {
    const auto mesh = Read(WithPrimitives(primitives));
    ASSERT_TRUE(mesh.ok()) << mesh.status();
    EXPECT_EQ(mesh->vertices.size(), whole->vertices.size());
    EXPECT_EQ(mesh->triangles.size(), whole->triangles.size());
  }
}

TEST(MeshContentDae, LinesAreNoFaces) {
  // As SketchUp writes them, with a wrong count.
  const auto mesh = Read(WithPrimitives(DaePolylist("B") + "<lines count=\"7\">" + DaeInputs("B") +
                                        "<p>0 0 1 0 1 0 2 0</p></lines>"));
  ASSERT_TRUE(mesh.ok()) << mesh.status();
  EXPECT_EQ(mesh->triangles.size(), 8u);
}

TEST(MeshContentDae, ReferencesAreWithinTheFile) {
  EXPECT_THAT(ErrorOf(With("url=\"#B-mesh\"", "url=\"#C-mesh\"")),
              HasSubstr("<instance_geometry> of <node> 'B': url is '#C-mesh', which is no "
                        "<geometry> of this file"));
  EXPECT_THAT(ErrorOf(With("url=\"#B-mesh\"", "url=\"b.dae#B-mesh\"")), HasSubstr("'b.dae#B-"));
  EXPECT_THAT(ErrorOf(With(DaeInstance("B"), "<instance_node url=\"#C\"/>")),
              HasSubstr("url is '#C', which is no <node>"));
  EXPECT_THAT(ErrorOf(With(DaeInstance("B"), "<instance_node url=\"c.dae#C\"/>")),
              HasSubstr("url is 'c.dae#C'"));
  EXPECT_THAT(ErrorOf(With(DaeInstance("B"), "<instance_controller url=\"#C\"/>")),
              HasSubstr("<instance_controller> of <node> 'B': it is not supported"));
  EXPECT_THAT(ErrorOf(With("\"#B-mesh-positions\"", "\"#B-mesh-position\"")),
              HasSubstr("which is no <source>"));
  EXPECT_THAT(ErrorOf(With("url=\"#Scene\"", "url=\"#Scenes\"")), HasSubstr("<visual_scene>"));
}

TEST(MeshContentDae, WhatTheSceneLeavesOutIsMissed) {
  EXPECT_THAT(ErrorOf(With(DaeInstance("B"), "")),
              HasSubstr("<geometry> 'B-mesh': no node of the scene has it"));
  EXPECT_THAT(ErrorOf(WithPrimitives("")),
              HasSubstr("<geometry> 'B-mesh': 4 of 4 vertices belong to no face"));
  EXPECT_THAT(ErrorOf(With("id=\"B-mesh\"", "id=\"A-mesh\"")),
              HasSubstr("<geometry> 'A-mesh': another one has the same id"));
}

TEST(MeshContentDae, NodesMayBeInstances) {
  const auto mesh = Read(
      With(DaeInstance("B"), DaeInstance("B") + "<node><translate>5 0 0"
                                                "</translate><instance_node url=\"#A\"/></node>"));
  ASSERT_TRUE(mesh.ok()) << mesh.status();
  EXPECT_EQ(mesh->triangles.size(), 12u);
  EXPECT_THAT(ErrorOf(With(DaeInstance("B"), DaeInstance("B") + "<instance_node url=\"#B\"/>")),
              HasSubstr("nodes nest deeper than 1000"));
}

TEST(MeshContentDae, CountsAreThoseOfTheFile) {
  EXPECT_THAT(ErrorOf(With("<triangles material=\"red\" count=\"4\">",
                           "<triangles material=\"red\" count=\"5\">")),
              HasSubstr("<triangles> of <geometry> 'A-mesh': it states 5 faces and has 4"));
  EXPECT_THAT(ErrorOf(With("<polylist count=\"4\">", "<polylist count=\"3\">")),
              HasSubstr("it states 3 faces and has 4"));
  EXPECT_THAT(ErrorOf(With("<vcount>3 3 3 3 ", "<vcount>3 3 3 ")),
              HasSubstr("it has 12 corners; vcount states 9"));
  EXPECT_THAT(ErrorOf(With("<vcount>3 3 3 3 ", "<vcount>3 3 0 6 ")),
              HasSubstr("a face of 0 vertices at corner 6 of 12"));
  EXPECT_THAT(ErrorOf(With("count=\"12\">0 0 0", "count=\"13\">0 0 0")),
              HasSubstr("<float_array> 'A-mesh-positions-array': it states 13 numbers and has 12"));
  EXPECT_THAT(ErrorOf(With("count=\"4\" stride=\"3\"", "count=\"5\" stride=\"3\"")),
              HasSubstr("it states 5 vertices of 3 numbers, and there are 12"));
  EXPECT_THAT(ErrorOf(WithPrimitives("<polygons count=\"6\">" + DaeInputs("B") +
                                     "<p>0 0 2 0 1 0</p><p>0 0 1 0 3 0</p></polygons>")),
              HasSubstr("it states 6 lists and has 2 in 2 <p>"));
}

TEST(MeshContentDae, IndicesAreThoseOfVertices) {
  for (const char* index : {"4", "-1", "x", "1.5", "99999999999999999999"}) {
    EXPECT_THAT(ErrorOf(With("<p>0 0 2 0", absl::StrCat("<p>0 0 ", index, " 0"))),
                HasSubstr("<p> of <geometry> 'A-mesh': "))
        << index;
  }
  EXPECT_THAT(ErrorOf(With("<p>0 0 2 0", "<p>0 0 4 0")), HasSubstr("it names vertex 4 of 4"));
  EXPECT_THAT(ErrorOf(With("<p>0 0 2 0", "<p>0 0 2")), HasSubstr("a corner has 2"));
  EXPECT_THAT(ErrorOf(With("<param name=\"X\"", "<param name=\"U\"")), HasSubstr("'U Y Z' of 3"));
}

// A param without a name is a number to be skipped (COLLADA 1.4.1, <accessor>).
TEST(MeshContentDae, NumbersBetweenCoordinatesAreSkipped) {
  const auto skipping = [](const std::string& numbers, const std::string& params) {
    return absl::StrReplaceAll(
        Dae(), {{"count=\"12\">0 0 0 1 0 0 0 1 0 0 0 1<", "count=\"16\">" + numbers + "<"},
                {"count=\"4\" stride=\"3\"", "count=\"4\" stride=\"4\""},
                {"<param name=\"X\" type=\"float\"/>", params}});
  };
  const std::string skip = "<param type=\"float\"/>", x = "<param name=\"X\" type=\"float\"/>";
  for (const auto& mesh : {Read(skipping("9 0 0 0 9 1 0 0 9 0 1 0 9 0 0 1", skip + x)),
                           Read(skipping("0 9 0 0 1 9 0 0 0 9 1 0 0 9 0 1", x + skip)),
                           Read(skipping("0 0 0 9 1 0 0 9 0 1 0 9 0 0 1 9", x))}) {
    ASSERT_TRUE(mesh.ok()) << mesh.status();
    EXPECT_TRUE(BoxAround(*mesh).max.isApprox(Eigen::Vector3d(3, 1, 2), 1e-6));
  }
  EXPECT_THAT(ErrorOf(skipping("9 9 0 0 9 9 1 0 9 9 0 1 9 9 0 0", skip + skip + x)),
              HasSubstr("'X Y Z' of 5 and its stride is 4"));
}

TEST(MeshContentDae, NothingIsStatedTwice) {
  const auto twice = [](const std::string& element, const std::string& other) {
    return ErrorOf(With(element, other + element));
  };
  const std::string unit = "<unit name=\"inch\" meter=\"0.0254\"/>";
  EXPECT_THAT(ErrorOf(With("<up_axis>", unit + "<up_axis>")), HasSubstr("<unit>: another one"));
  EXPECT_THAT(twice("<asset>", "<asset>" + unit + "</asset>"), HasSubstr("<asset>: another one"));
  EXPECT_THAT(twice("<up_axis>", "<up_axis>X_UP</up_axis>"), HasSubstr("<up_axis>: another one"));
  EXPECT_THAT(twice("meter=\"1\"", "meter=\"2\" "), HasSubstr("the attribute meter twice"));
  EXPECT_THAT(twice("<scene>", "<scene/>"), HasSubstr("<scene>: another one"));
}

TEST(MeshContentDae, WhatIsNotSupportedIsNamed) {
  EXPECT_THAT(ErrorOf(WithPrimitives("<polygons count=\"1\">" + DaeInputs("B") +
                                     "<ph><p>0 0 2 0 1 0</p><h>0 0 1 0 3 0</h></ph></polygons>")),
              HasSubstr("<ph> of <geometry> 'B-mesh': it is not read"));
  EXPECT_THAT(ErrorOf(With("<scale sid=\"scale\">1 1 2</scale>", "<skew>0 1 0 0 0 0 1</skew>")),
              HasSubstr("<skew> of <node> 'B': it is not supported"));
  EXPECT_THAT(ErrorOf(With("0 0 0 1</matrix>", "0 0 1 1</matrix>")), HasSubstr("last row"));
  EXPECT_THAT(ErrorOf(With("1 1 2</scale>", "1 2</scale>")),
              HasSubstr("<scale> of <node> 'B': it has 2 numbers; it must have 3"));
  EXPECT_THAT(ErrorOf(With("0 0 1 90</rotate>", "0 0 0 90</rotate>")), HasSubstr("no length"));
  EXPECT_THAT(ErrorOf(With("version=\"1.4.1\"", "version=\"1.3.0\"")), HasSubstr("version 1.4"));
}

TEST(MeshContentDae, ElementsMayNotNestTooDeep) {
  std::string nodes;
  for (int i = 0; i < 200'000; ++i) nodes += "<node>";
  nodes += DaeInstance("A");
  for (int i = 0; i < 200'000; ++i) nodes += "</node>";
  EXPECT_THAT(ErrorOf(Dae(DaeGeometry("A", DaeTriangles("A")), nodes)), HasSubstr("nest too deep"));
}

}  // namespace
}  // namespace clearway
