// A TUM RGB-D sequence in the tool: info, evaluate and replay.
#include <gmock/gmock.h>

#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "clients/cli_server.h"
#include "io/png_example.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr int kFrames = 30, kWidth = 32, kHeight = 24;

// A camera that looks along W's z at a wall 4 m away; object 5 goes past at 2 m, 1 m/s along x.
class TumSequence : public CliServer {
 protected:
  TumSequence() {
    std::string depths = "# depth maps\n", masks, track, objects;
    for (int k = 0; k < kFrames; ++k) {
      const std::string stamp = absl::StrFormat("%d.%09d", 100 + k / 10, k % 10 * 100'000'000);
      absl::StrAppend(&depths, stamp, " depth/", k, ".png\n");
      absl::StrAppend(&masks, stamp, " mask/", k, ".png\n");
      absl::StrAppend(&track, stamp, " 0 0 0 0 0 0 1\n");
      absl::StrAppendFormat(&objects, "%s 5 %.3f 0 2.1 0 0 0 1\n", stamp, 0.1 * k - 1.2);
      std::vector<int> depth, mask;
      for (int i = 0; i < kWidth * kHeight; ++i) {
        const double x_m = (i % kWidth - 15.5) / 25 * 2;
        const bool on = std::abs(x_m - (0.1 * k - 1.2)) < 0.3 && std::abs(i / kWidth - 12) < 6;
        depth.push_back(on ? 10'000 : 20'000);
        mask.push_back(on ? 5 : 0);
      }
      folder_.Write(absl::StrCat("depth/", k, ".png"), PngBytes(kWidth, kHeight, depth));
      folder_.Write(absl::StrCat("mask/", k, ".png"), PngBytes(kWidth, kHeight, mask, {.bits = 8}));
    }
    folder_.Write("depth.txt", depths);
    folder_.Write("groundtruth.txt", track);
    folder_.Write("camera.txt", "25 25 15.5 11.5\n");
    folder_.Write("mask.txt", masks);
    folder_.Write("object_poses.txt", objects);
  }
  std::string path() const { return folder_.path().string(); }

  TemporaryFolder folder_;
};

TEST_F(TumSequence, InfoTellsWhatItHolds) {
  const Finished text = RunClearway({"info", path()});
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_THAT(text.out, HasSubstr("TUM RGB-D sequence " + path()));
  const json info = json::parse(RunClearway({"info", path(), "--json"}).out);
  EXPECT_EQ(info["frames"], kFrames);
  EXPECT_EQ(info["points"], kFrames * kWidth * kHeight);
  EXPECT_EQ(info["first_stamp_ns"], 100'000'000'000);
  ASSERT_EQ(info["objects"].size(), 1u);
  EXPECT_EQ(info["objects"][0]["id"], 5);
  EXPECT_TRUE(info["objects"][0]["size_m"].is_null());
}

TEST_F(TumSequence, ReplayFillsAServer) {
  EXPECT_EQ(Ask({"replay", path(), "--quiet"})["applied"], kFrames);
  const json objects = Ask({"objects"})["objects"];
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects[0]["id"], 5);
  EXPECT_NEAR(objects[0]["speed_mps"].get<double>(), 1, 1e-6);
  const json wall = Ask({"occupancy", "--at", "1.5,1,4.0"});
  EXPECT_THAT(wall.dump(), HasSubstr("OCCUPIED"));
}

TEST_F(TumSequence, ReplayMaySendLess) {
  const json all = Ask({"replay", path(), "--quiet", "--stride", "2", "--max-depth", "3"});
  EXPECT_EQ(all["applied"], kFrames);
  EXPECT_LT(all["points"], kFrames * kWidth * kHeight / 8);
}

TEST_F(TumSequence, EvaluateJudgesByThePosesOfObjects) {
  const Finished text = RunClearway({"evaluate", path()});
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_THAT(text.out, Not(HasSubstr("true boxes")));  // nobody told their sizes
  const json found = json::parse(RunClearway({"evaluate", path(), "--json"}).out);
  ASSERT_EQ(found["objects"].size(), 1u);
  EXPECT_EQ(found["objects"][0]["id"], 5);
  EXPECT_FALSE(found["objects"][0].contains("size"));
}

TEST_F(TumSequence, EvaluateRefusesToUnlabelWhatIsNotThere) {
  const Finished dut = RunClearway({"evaluate", path(), "--unlabelled", "5,6"});
  EXPECT_EQ(dut.exit_code, 2);
  EXPECT_THAT(dut.err, HasSubstr("has no object 6; it has 5"));
  EXPECT_EQ(RunClearway({"evaluate", path(), "--unlabelled", "5"}).exit_code, 0);
}

TEST_F(TumSequence, EvaluateNeedsPosesOfObjects) {
  std::filesystem::remove(folder_ / "object_poses.txt");
  const Finished dut = RunClearway({"evaluate", path()});
  EXPECT_EQ(dut.exit_code, 1);
  EXPECT_THAT(dut.err, HasSubstr("no boxes or poses of objects are recorded"));
}

}  // namespace
}  // namespace clearway
