// Sequences of the ClusterSLAM dataset in the tool: info, replay and evaluate.
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

constexpr int kFrameCount = 30;

// A stereo camera that looks along W's z; cluster 1 crosses before it, 1 m/s along x.
class ClusterSequence : public CliServer {
 protected:
  ClusterSequence() {
    std::string mapping;
    for (int i = 0; i < 100; ++i) absl::StrAppend(&mapping, i, i < 50 ? " 0\n" : " 1\n");
    folder_.Write("landmark_mapping.txt", mapping);
    folder_.Write("intrinsic.txt",
                  "500 0 320 0\n0 500 240 0\n0 0 1 0\n\n500 0 320 -250\n0 500 240 0\n0 0 1 0\n");
    for (int k = 0; k < kFrameCount; ++k) {
      const std::string name = absl::StrFormat("%04d.txt", k);
      const double x_m = 0.1 * k - 1.5;
      folder_.Write("pose/" + name, absl::StrFormat("0 0 0 1 0 0 0\n%.3f 0 5 1 0 0 0\n", x_m));
      folder_.Write("landmarks/left/" + name, Seen(x_m, 0));
      folder_.Write("landmarks/right/" + name, Seen(x_m, 0.5));
    }
  }
  static std::string Seen(double x_m, double right_m) {
    std::string text;
    for (int i = 0; i < 100; ++i) {
      const bool moves = i >= 50;
      const double x = (moves ? x_m + 0.1 * (i % 5) : 0.1 * i - 2.45) - right_m;
      const double y = 0.1 * (i % 10) - 0.45, z = moves ? 5.05 : 8.05;
      absl::StrAppendFormat(&text, "%d %.4f %.4f\n", i, 320 + 500 * x / z, 240 + 500 * y / z);
    }
    return text;
  }
  std::string path() const { return folder_.path().string(); }

  TemporaryFolder folder_;
};

TEST_F(ClusterSequence, InfoReplayAndEvaluate) {
  EXPECT_THAT(RunClearway({"info", path()}).out, HasSubstr("ClusterSLAM sequence " + path()));
  EXPECT_EQ(Ask({"replay", path(), "--quiet"})["points"], kFrameCount * 100);
  const json objects = Ask({"objects"})["objects"];
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_NEAR(objects[0]["speed_mps"].get<double>(), 1, 1e-6);
  EXPECT_EQ(json::parse(RunClearway({"evaluate", path(), "--json"}).out)["objects"].size(), 1u);
}

TEST_F(ClusterSequence, ReplayMayLeaveOutWhatIsFar) {
  EXPECT_EQ(Ask({"replay", path(), "--quiet", "--max-depth", "6"})["points"], kFrameCount * 50);
}

}  // namespace
}  // namespace clearway
