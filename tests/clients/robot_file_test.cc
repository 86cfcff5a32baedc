#include "cli/robot_file.h"

#include <gmock/gmock.h>

#include <fstream>

#include "support/temporary_folder.h"

namespace clearway::cli {
namespace {

using ::testing::HasSubstr;

std::string MessageOf(const std::string& text) {
  return std::string(ParseRobot("r.json", text).status().message());
}

// A robot of one link with this list of shapes.
std::string WithShapes(const std::string& shapes) {
  return R"({"name": "r", "links": [{"name": "base", "shapes": )" + shapes + "}]}";
}

TEST(RobotFile, Empty) { EXPECT_THAT(MessageOf(""), HasSubstr("r.json: parse error at line 1")); }

TEST(RobotFile, ReadsLinksWithPoses) {
  const auto dut = ParseRobot("r.json", R"({"name": "cart", "links": [
    {"name": "body", "pose": {"position_m": [0, 0, 0.5]}, "shapes": [
      {"type": "box", "size_m": [1, 0.7, 1]},
      {"type": "cylinder", "radius_m": 0.1, "length_m": 0.4,
       "pose": {"position_m": [0.2, 0, 0.7], "rpy_rad": [1.5707963267948966, 0, 0]}}]},
    {"name": "mast", "pose": {"rotation_xyzw": [0, 0, 1, 0]}, "shapes": [
      {"type": "capsule", "radius_m": 0.05, "length_m": 1}, {"type": "sphere", "radius_m": 0.2}]}
  ]})");
  ASSERT_TRUE(dut.ok()) << dut.status();
  ASSERT_EQ(dut->robot.links.size(), 2u);
  EXPECT_EQ(dut->robot.name, "cart");
  EXPECT_EQ(dut->T_R_L[0].translation, Eigen::Vector3d(0, 0, 0.5));
  const LinkShape& cylinder = dut->robot.links[0].shapes[1];
  EXPECT_EQ(std::get<Cylinder>(cylinder.shape).length_m, 0.4);
  // Rolled by a quarter turn, z points to -y.
  EXPECT_LT((cylinder.T_L_G * Eigen::Vector3d(0, 0, 1) - Eigen::Vector3d(0.2, -1, 0.7)).norm(),
            1e-12);
  EXPECT_TRUE(Validate(dut->robot).ok()) << Validate(dut->robot);
}

TEST(RobotFile, MakesHullsOfPoints) {
  const auto dut = ParseRobot("r.json", WithShapes(R"([{"type": "hull", "points_m":
        [[0,0,0], [1,0,0], [0,1,0], [0,0,1], [0.1,0.1,0.1]]}])"));
  ASSERT_TRUE(dut.ok()) << dut.status();
  const auto& hull = std::get<ConvexPolytope>(dut->robot.links[0].shapes[0].shape);
  EXPECT_EQ(hull.mesh->triangles.size(), 4u);
  EXPECT_TRUE(Validate(dut->robot).ok()) << Validate(dut->robot);
}

TEST(RobotFile, FindsMeshesNextToItself) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "tetra.obj")
      << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  std::ofstream(folder.path() / "r.json")
      << WithShapes(R"([{"type": "mesh", "file": "tetra.obj", "scale": 2}])");
  const auto dut = LoadRobot((folder.path() / "r.json").string());
  ASSERT_TRUE(dut.ok()) << dut.status();
  const auto& mesh = std::get<TriangleMesh>(dut->robot.links[0].shapes[0].shape);
  EXPECT_EQ(mesh.mesh->triangles.size(), 4u);
  EXPECT_EQ(BoundingBox(mesh).max, Eigen::Vector3d(2, 2, 2));
}

TEST(RobotFile, ReadsShapesInShort) {
  const auto box = LoadRobot("box:1,0.7,1");
  ASSERT_TRUE(box.ok()) << box.status();
  EXPECT_EQ(std::get<Box>(box->robot.links[0].shapes[0].shape).size_m, Eigen::Vector3d(1, 0.7, 1));
  EXPECT_TRUE(LoadRobot("sphere:0.3").ok());
  EXPECT_TRUE(LoadRobot("cylinder:0.3,1.2").ok());
  EXPECT_TRUE(LoadRobot("capsule:0.3,0.6").ok());
}

TEST(RobotFile, RefusesShapesInShortThatMakeNoSense) {
  for (const char* text : {"box:1,1", "box:1,1,0", "sphere:-1", "ball:1", "sphere:", "sphere:x"}) {
    EXPECT_FALSE(LoadRobot(text).ok()) << text;
  }
}

TEST(RobotFile, RefusesShapesInShortWithoutSizeAndSaysWhy) {
  EXPECT_THAT(std::string(LoadRobot("sphere:0").status().message()),
              HasSubstr("not 'sphere:0'; lengths are above 0"));
  EXPECT_FALSE(LoadRobot("box:0x1,1,1").ok());
}

TEST(RobotFile, RefusesKeysThatAreGivenTwice) {
  EXPECT_EQ(MessageOf(WithShapes(R"([{"type": "sphere", "radius_m": 1, "radius_m": 2}])")),
            "r.json: links[0].shapes[0].radius_m: given twice");
}

TEST(RobotFile, NamesAMissingFile) {
  EXPECT_THAT(std::string(LoadRobot("no_such.json").status().message()),
              HasSubstr("no_such.json: no such robot file"));
}

TEST(RobotFile, NamesTheFieldThatIsWrong) {
  EXPECT_EQ(MessageOf("[]"), "r.json: the file: expected an object, not []");
  EXPECT_EQ(MessageOf(R"({"name": "r"})"), "r.json: links: missing");
  EXPECT_EQ(MessageOf(R"({"name": 3, "links": []})"), "r.json: name: expected a text, not 3");
  EXPECT_THAT(MessageOf(R"({"name": "r", "links": []})"), HasSubstr("links: expected a list"));
  EXPECT_THAT(MessageOf(R"({"name": "r", "limbs": []})"), HasSubstr("limbs: unknown field"));
  EXPECT_EQ(MessageOf(WithShapes(R"([{"type": "sphere"}])")),
            "r.json: links[0].shapes[0].radius_m: missing");
  EXPECT_EQ(MessageOf(WithShapes(R"([{"type": "sphere", "radius_m": -1}])")),
            "r.json: links[0].shapes[0].radius_m: expected a number above 0, not -1");
  EXPECT_THAT(MessageOf(WithShapes(R"([{"type": "cone"}])")),
              HasSubstr("links[0].shapes[0].type: expected box"));
  EXPECT_THAT(MessageOf(WithShapes(R"([{"type": "box", "size_m": [1, 2, 3], "radius_m": 1}])")),
              HasSubstr("links[0].shapes[0].radius_m: unknown field"));
  EXPECT_THAT(MessageOf(WithShapes(R"([{"type": "box", "size_m": [1, 2]}])")),
              HasSubstr("links[0].shapes[0].size_m: expected 3 numbers"));
  EXPECT_THAT(MessageOf(WithShapes(R"([{"type": "mesh", "file": "none.stl"}])")),
              HasSubstr("links[0].shapes[0].file: "));
  EXPECT_THAT(MessageOf(WithShapes(R"([{"type": "hull", "points_m": [[0,0,0], [1,0,0]]}])")),
              HasSubstr("links[0].shapes[0].points_m: the points do not span a volume"));
  EXPECT_THAT(MessageOf(WithShapes(
                  R"([{"type": "sphere", "radius_m": 1, "pose": {"rotation_xyzw": [0,0,0,0]}}])")),
              HasSubstr("links[0].shapes[0].pose.rotation_xyzw: has length 0"));
}

TEST(RobotFile, RefusesTwoLinksOfOneName) {
  const std::string link = R"({"name": "a", "shapes": [{"type": "sphere", "radius_m": 1}]})";
  EXPECT_THAT(MessageOf(R"({"name": "r", "links": [)" + link + "," + link + "]}"),
              HasSubstr("links[1].name: two links are called \"a\""));
}

TEST(RobotFile, RefusesAFileCutOffAtAnyByte) {
  const std::string whole = WithShapes(R"([{"type": "sphere", "radius_m": 0.25}])");
  ASSERT_TRUE(ParseRobot("r.json", whole).ok());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_FALSE(ParseRobot("r.json", whole.substr(0, size)).ok()) << size;
  }
}

}  // namespace
}  // namespace clearway::cli
