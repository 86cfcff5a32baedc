// DynoSAM's logs in the tool: info, replay and evaluate.
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
using ::testing::Not;

constexpr int kFrameCount = 30, kRows = 8;
constexpr int kWallPoints = 40 * 40, kObjectPoints = kRows * kRows;

// A camera that looks along W's z at a wall 4 m away; object 5 goes past at 2 m, 1 m/s along x.
class DynosamLogs : public CliServer {
 protected:
  DynosamLogs() {
    std::string camera = "timestamp,frame_id,tx,ty,tz,qx,qy,qz,qw\n";
    std::string poses = "timestamp,frame_id,object_id,tx,ty,tz,qx,qy,qz,qw\n", motions = poses;
    std::string points = "frame_id,object_id,tracklet_id,x_world,y_world,z_world";
    for (int i = 0; i < kWallPoints; ++i) {
      absl::StrAppendFormat(&points, "\n18446744073709551615,0,%d,%.2f,%.2f,4.05", i,
                            0.1 * (i % 40) - 1.95, 0.1 * (i / 40) - 1.95);
    }
    for (int k = 0; k < kFrameCount; ++k) {
      const std::string key = absl::StrFormat("%d,%d", 1'000'000'000 + 100'000'000LL * k, k);
      const double x_m = 0.1 * k - 1.2;
      absl::StrAppend(&camera, key, ",0,0,0,0,0,0,1\n");
      absl::StrAppendFormat(&poses, "%s,5,%.3f,0,2.1,0,0,0,1\n", key, x_m);
      absl::StrAppend(&motions, key, k == 0 ? ",5,0" : ",5,0.1", ",0,0,0,0,0,1\n");
      for (int i = 0; i < kObjectPoints; ++i) {
        absl::StrAppendFormat(&points, "\n%d,5,%d,%.3f,%.3f,2.05", k, 10'000 + i,
                              x_m + 0.08 * (i % kRows) - 0.28, 0.08 * (i / kRows) - 0.28);
      }
    }
    folder_.Write("hybrid_backend_camera_pose_log.csv", camera);
    folder_.Write("hybrid_backend_object_pose_log.csv", poses);
    folder_.Write("hybrid_backend_object_motion_log.csv", motions);
    folder_.Write("hybrid_backend_map_points_log.csv", points);
  }
  std::string path() const { return folder_.path().string(); }

  TemporaryFolder folder_;
};

TEST_F(DynosamLogs, InfoTellsWhatTheyHold) {
  for (const char* log : {"", "/hybrid_backend_camera_pose_log.csv"}) {
    const Finished text = RunClearway({"info", path() + log});
    EXPECT_EQ(text.exit_code, 0) << text.err;
    EXPECT_THAT(text.out, HasSubstr(absl::StrCat("DynoSAM logs ", path(), "/hybrid_backend_*")));
  }
  const json info = json::parse(RunClearway({"info", path(), "--json"}).out);
  EXPECT_EQ(info["frames"], kFrameCount);
  EXPECT_EQ(info["points"], kWallPoints + kFrameCount * kObjectPoints);
  EXPECT_EQ(info["first_stamp_ns"], 1'000'000'000);
  ASSERT_EQ(info["objects"].size(), 1u);
  EXPECT_EQ(info["objects"][0]["id"], 5);
}

TEST_F(DynosamLogs, ReplayFillsAServer) {
  EXPECT_EQ(Ask({"replay", path(), "--quiet"})["applied"], kFrameCount);
  const json objects = Ask({"objects"})["objects"];
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects[0]["id"], 5);
  EXPECT_NEAR(objects[0]["speed_mps"].get<double>(), 1, 1e-6);
  EXPECT_THAT(Ask({"occupancy", "--at", "1.55,1.05,4.05"}).dump(), HasSubstr("OCCUPIED"));
  // No ray says that the space before the wall is free.
  EXPECT_THAT(Ask({"occupancy", "--at", "1.55,1.05,3.85"}).dump(), HasSubstr("UNKNOWN"));
  EXPECT_THAT(Ask({"occupancy", "--at", "0,0,1"}).dump(), HasSubstr("FREE"));
}

TEST_F(DynosamLogs, EvaluateJudgesByThePosesOfObjects) {
  const Finished text = RunClearway({"evaluate", path()});
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_THAT(text.out, Not(HasSubstr("true boxes")));  // nobody told their sizes
  const json found = json::parse(RunClearway({"evaluate", path(), "--json"}).out);
  ASSERT_EQ(found["objects"].size(), 1u);
  EXPECT_EQ(found["objects"][0]["id"], 5);
}

TEST_F(DynosamLogs, ErrorsNameTheLine) {
  folder_.Write("hybrid_backend_object_pose_log.csv", "frame_id,object_id\n1,2\n");
  const Finished dut = RunClearway({"replay", path()});
  EXPECT_NE(dut.exit_code, 0);
  EXPECT_THAT(dut.err, HasSubstr("hybrid_backend_object_pose_log.csv, line 1: no column tx"));
}

}  // namespace
}  // namespace clearway
