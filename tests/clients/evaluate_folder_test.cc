// clearway evaluate on folders in which something is strange.
#include <gmock/gmock.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_format.h"
#include "clients/run_clearway.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// A LiDAR folder of 12 frames: a wall, and an object, by default 1, which is measured at (10, 0,
// 0). Object 1 has a box there, but in frame 6 elsewhere.
class StrangeBoxes {
 public:
  StrangeBoxes(double size_m, double jump_m, std::int16_t label = 1) : label_(label) {
    constexpr int kFrames = 12;
    constexpr char kPose[] = "1,0,0,%g,0,1,0,0,0,0,1,0\n";
    std::string poses = "frame,T00,T01,T02,T03,T10,T11,T12,T13,T20,T21,T22,T23\n";
    std::string objects =
        "frame,track,type,l,w,h,n_points,T00,T01,T02,T03,T10,T11,T12,T13,T20,T21,T22,T23\n";
    for (int k = 0; k < kFrames; ++k) {
      poses += absl::StrFormat("%d,", k) + absl::StrFormat(kPose, 0.0);
      objects += absl::StrFormat("%d,1,Car,%g,%g,2,9,", k, size_m, size_m) +
                 absl::StrFormat(kPose, k == 6 ? 10 + jump_m : 10);
      WritePoints(absl::StrFormat("%04d.bin", k));
    }
    folder_.Write("poses.csv", poses);
    folder_.Write("objects.csv", objects);
  }

  std::string path() const { return folder_.path(); }

 private:
  void WritePoints(const std::string& name) {
    std::filesystem::create_directories(folder_.path() / "points");
    std::ofstream out(folder_.path() / "points" / name, std::ios::binary);
    const auto write = [&out](float x, float y, std::int16_t label) {
      const float xyz[] = {x, y, 0};
      out.write(reinterpret_cast<const char*>(xyz), sizeof(xyz));
      out.write(reinterpret_cast<const char*>(&label), sizeof(label));
    };
    for (int i = -20; i < 20; ++i) {
      write(30, 0.2f * i, 0);
      write(9, 0.05f * i, label_);
    }
  }

  std::int16_t label_;
  TemporaryFolder folder_;
};

Finished Evaluated(const StrangeBoxes& folder, const std::vector<std::string>& flags = {}) {
  std::vector<std::string> arguments = {"evaluate", folder.path()};
  arguments.insert(arguments.end(), flags.begin(), flags.end());
  return RunClearway(arguments);
}

// What is too large to look at is left out of the tables, and takes no time.
TEST(EvaluateFolder, BoxesThatJumpOrAreHuge) {
  for (const auto& [size_m, jump_m] : {std::pair(4.4, 500.0), {4.4, 90'000.0}, {600.0, 0.0}}) {
    SCOPED_TRACE(testing::Message() << "size " << size_m << ", jump " << jump_m);
    const StrangeBoxes folder(size_m, jump_m);
    const Finished dut = Evaluated(folder, {"--json"});
    ASSERT_EQ(dut.exit_code, 0) << dut.err;
    const auto json = nlohmann::json::parse(dut.out);
    EXPECT_GT(json["objects"][0]["prediction"][0]["count"], 0);
    EXPECT_EQ(json.contains("ways"), size_m < 100);
  }
}

TEST(EvaluateFolder, TellsWhatPointsItLeftOut) {
  const StrangeBoxes folder(4.4, 0);
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr int kPointBytes = 14;
  std::ofstream(folder.path() + "/points/0003.bin", std::ios::binary | std::ios::app)
      .write(std::string(reinterpret_cast<const char*>(&kNan), sizeof kNan)
                 .append(kPointBytes - sizeof kNan, '\0')
                 .data(),
             kPointBytes);
  std::filesystem::resize_file(folder.path() + "/points/0005.bin", 0);
  const Finished text = Evaluated(folder);
  EXPECT_THAT(text.out,
              HasSubstr("\n880 points used, 1 left out as not finite; frames without any: 1.\n"))
      << text.err;
  const Finished json = Evaluated(folder, {"--json"});
  const auto points = nlohmann::json::parse(json.out)["points"];
  EXPECT_EQ(points["used"], 880);
  EXPECT_EQ(points["not_finite"], 1);
  EXPECT_EQ(points["frames_without"], 1);
}

TEST(EvaluateFolder, LabelsThatNoBoxHas) {
  const StrangeBoxes folder(4.4, 0, 2);
  const Finished text = Evaluated(folder);
  EXPECT_THAT(text.out, HasSubstr("labels and truth have no id in common"));
  EXPECT_THAT(text.out, Not(HasSubstr("no boxes")));
  const Finished json = Evaluated(folder, {"--json"});
  const auto prediction = nlohmann::json::parse(json.out)["prediction"];
  ASSERT_EQ(prediction.size(), 4u);
  EXPECT_EQ(prediction[1]["ahead_s"], 1);
  EXPECT_EQ(prediction[1]["count"], 0);
  EXPECT_TRUE(prediction[1]["median_m"].is_null());
}

}  // namespace
}  // namespace clearway
