// Robots whose mesh files are damaged, through the command line and a server.
#include <gmock/gmock.h>

#include <array>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "clearway/io/recording.h"
#include "clients/cli_server.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A cube of one metre about the origin as ASCII STL; face i is inside out if `flipped` has i, and
// there twice if `doubled` has it.
std::string CubeStl(const std::vector<int>& flipped, const std::vector<int>& doubled = {}) {
  constexpr std::array<std::array<int, 3>, 12> kFaces = {{{0, 2, 1},
                                                          {1, 2, 3},
                                                          {4, 5, 6},
                                                          {5, 7, 6},
                                                          {0, 1, 4},
                                                          {1, 5, 4},
                                                          {2, 6, 3},
                                                          {3, 6, 7},
                                                          {0, 4, 2},
                                                          {2, 4, 6},
                                                          {1, 3, 5},
                                                          {3, 7, 5}}};
  std::string text = "solid cube\n";
  const auto add = [&](std::array<int, 3> face, bool flip) {
    if (flip) std::swap(face[1], face[2]);
    absl::StrAppend(&text, "facet normal 0 0 0\nouter loop\n");
    for (const int corner : face) {
      absl::StrAppend(&text, "vertex ", corner & 1 ? 0.5 : -0.5, " ", corner & 2 ? 0.5 : -0.5, " ",
                      corner & 4 ? 0.5 : -0.5, "\n");
    }
    absl::StrAppend(&text, "endloop\nendfacet\n");
  };
  for (int i = 0; i < 12; ++i) {
    const bool flip = std::ranges::count(flipped, i) > 0;
    add(kFaces[i], flip);
    if (std::ranges::count(doubled, i) > 0) add(kFaces[i], !flip);
  }
  return text + "endsolid cube\n";
}

class MeshCli : public CliServer {
 protected:
  // One hit at (5, 0, 1), seen from (0, 0, 1).
  void SetUp() override {
    CliServer::SetUp();
    Frame frame;
    frame.sensor_id = "lidar";
    frame.T_W_S = Pose::Translation(0, 0, 1);
    frame.points_S = {{5.0f, 0.0f, 0.0f}};
    frame.labels = {kStaticLabel};
    const auto recording = RecordingWriter::Create(folder_ / "hit.cwr");
    ASSERT_TRUE(recording.ok() && (*recording)->Append(frame).ok() && (*recording)->Close().ok());
    Ask({"replay", (folder_ / "hit.cwr").string(), "--quiet"});
    folder_.Write("robot.json", R"({"name": "r", "links": [{"name": "b", "shapes": [
        {"type": "mesh", "file": "cube.stl"}]}]})");
  }

  // The check of the robot with this mesh about the hit.
  Finished CheckAbout(const std::string& stl, const std::string& state = "5,0,1,0") {
    folder_.Write("cube.stl", stl);
    return Clearway({"check", "--robot", (folder_ / "robot.json").string(), "--state", state,
                     "--unknown", "free", "--json"});
  }

  TemporaryFolder folder_;
};

std::string StatusOf(const Finished& finished) {
  return json::parse(finished.out, nullptr, false)["states"][0]["status"];
}

TEST_F(MeshCli, AWholeCubeIsOccupiedByWhatIsInsideWithoutANote) {
  const Finished dut = CheckAbout(CubeStl({}));
  EXPECT_EQ(StatusOf(dut), "OCCUPIED");
  EXPECT_THAT(dut.err, IsEmpty());
  EXPECT_EQ(StatusOf(CheckAbout(CubeStl({}), "5,2,1,0")), "FREE");
}

TEST_F(MeshCli, FacesThatAreInsideOutAreTurnedAndNoted) {
  const Finished half = CheckAbout(CubeStl({0, 3, 4, 7, 8, 11}));
  EXPECT_EQ(StatusOf(half), "OCCUPIED");
  EXPECT_THAT(half.err, HasSubstr("note: robot.links[0].shapes[0].mesh: "));
  EXPECT_THAT(half.err, HasSubstr("of 12 faces turned"));
  EXPECT_EQ(StatusOf(CheckAbout(CubeStl({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}))), "OCCUPIED");
  EXPECT_EQ(StatusOf(CheckAbout(CubeStl({0, 3, 4, 7, 8, 11}), "5,2,1,0")), "FREE");
}

TEST_F(MeshCli, DoubledFacesAreDroppedAndNoted) {
  const Finished dut = CheckAbout(CubeStl({}, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}));
  EXPECT_EQ(StatusOf(dut), "OCCUPIED");
  EXPECT_THAT(dut.err, HasSubstr("12 doubled faces dropped"));
}

}  // namespace
}  // namespace clearway
