// Scans of CARLA's semantic LiDAR in the tool: info, replay and evaluate.
#include <gmock/gmock.h>

#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "clients/cli_server.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

constexpr int kFrameCount = 30, kFirst = 400;

// A point in CARLA's left-handed world, which here is the sensor's frame, too.
std::string Hit(double x, double y, double z, int actor) {
  return absl::StrFormat("%.4f %.4f %.4f 1.0000 %d 14\n", x, y, z, actor);
}

// A LiDAR that stands still sees a wall 10 m ahead, the left end of which is missing; actor 24 goes
// past at 5 m, 1 m/s to the right, which is CARLA's +y.
class CarlaScans : public CliServer {
 protected:
  static constexpr int kColumns = 60, kRows = 20, kObject = 100;

  CarlaScans() {
    std::string sensor = "frame,timestamp,x,y,z,roll,pitch,yaw\n";
    std::string actors =
        "frame,id,type,x,y,z,roll,pitch,yaw,box_x,box_y,box_z,extent_x,extent_y,extent_z\n";
    for (int k = 0; k < kFrameCount; ++k) {
      const double y_m = 0.1 * k - 1.2;
      absl::StrAppendFormat(&sensor, "%d,%.17g,0,0,0,0,0,0\n", kFirst + k, 7 + 0.1 * k);
      absl::StrAppendFormat(&actors, "%d,24,walker.pedestrian.0004,5.3,%.3f,0,0,0,90,0,0,0,%s\n",
                            kFirst + k, y_m, "0.5,0.3,0.5");
      folder_.Write(absl::StrFormat("%06d.ply", kFirst + k), Scan(y_m));
    }
    folder_.Write("carla_sensor.csv", sensor);
    folder_.Write("carla_actors.csv", actors);
  }
  static std::string Scan(double y_m) {
    std::string text = absl::StrCat(
        "ply\nformat ascii 1.0\nelement vertex ", kColumns * kRows + kObject,
        "\nproperty float32 x\nproperty float32 y\nproperty float32 z\n"
        "property float32 CosAngle\nproperty uint32 ObjIdx\nproperty uint32 ObjTag\nend_header\n");
    for (int i = 0; i < kColumns * kRows; ++i) {
      text += Hit(10.05, 0.1 * (i % kColumns) - 2.45, 0.1 * (i / kColumns) - 0.95, 0);
    }
    for (int i = 0; i < kObject; ++i) {
      text += Hit(5.05, y_m + 0.08 * (i % 10) - 0.36, 0.08 * (i / 10) - 0.36, 24);
    }
    return text;
  }
  std::string path() const { return folder_.path().string(); }

  TemporaryFolder folder_;
};

TEST_F(CarlaScans, InfoTellsWhatTheyHold) {
  const Finished text = RunClearway({"info", path()});
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_THAT(text.out, HasSubstr("CARLA scans " + path()));
  EXPECT_THAT(text.out, HasSubstr("walker.pedestrian.0004"));
  const json info = json::parse(RunClearway({"info", path(), "--json"}).out);
  EXPECT_EQ(info["frames"], kFrameCount);
  EXPECT_EQ(info["points"], kFrameCount * (kColumns * kRows + kObject));
  EXPECT_EQ(info["first_stamp_ns"], 7'000'000'000);
  ASSERT_EQ(info["objects"].size(), 1u);
  EXPECT_EQ(info["objects"][0]["id"], 24);
  EXPECT_EQ(info["objects"][0]["size_m"], json({1, 0.6, 1}));
}

TEST_F(CarlaScans, ReplayFillsAServer) {
  EXPECT_EQ(Ask({"replay", path(), "--quiet"})["applied"], kFrameCount);
  const json objects = Ask({"objects"})["objects"];
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects[0]["id"], 24);
  EXPECT_NEAR(objects[0]["speed_mps"].get<double>(), 1, 1e-6);
  EXPECT_LT(objects[0]["box_world"]["max_m"][1].get<double>(), -1);  // to the right
  // The wall reaches from 2.5 m to the left to 3.5 m to the right.
  EXPECT_THAT(Ask({"occupancy", "--at", "10.05,-3.25,0.05"}).dump(), HasSubstr("OCCUPIED"));
  EXPECT_THAT(Ask({"occupancy", "--at", "10.05,3.25,0.05"}).dump(), HasSubstr("UNKNOWN"));
}

TEST_F(CarlaScans, EvaluateJudgesByActors) {
  const json found = json::parse(RunClearway({"evaluate", path(), "--json"}).out);
  ASSERT_EQ(found["objects"].size(), 1u);
  EXPECT_EQ(found["objects"][0]["id"], 24);
}

TEST_F(CarlaScans, ErrorsNameTheLine) {
  folder_.Write("000400.ply", "ply\nformat ascii 2.0\nend_header\n");
  const char* const line = "000400.ply, line 2: format ascii";
  const Finished dut = RunClearway({"evaluate", path()});
  EXPECT_NE(dut.exit_code, 0);
  EXPECT_THAT(dut.err, HasSubstr(line));
  EXPECT_THAT(RunClearway({"info", path()}).out, HasSubstr(line));
}

}  // namespace
}  // namespace clearway
