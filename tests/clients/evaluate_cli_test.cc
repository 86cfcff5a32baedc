// clearway evaluate as a program, on simulations and on recordings.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "clients/run_clearway.h"
#include "io/recording_example.h"
#include "support/frames.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using ::testing::HasSubstr;

TEST(Evaluate, PredictionsAgainstTheSimulatorsTruth) {
  const Finished dut = RunClearway({"evaluate", "sim:small", "--frames", "30", "--json"});
  ASSERT_EQ(dut.exit_code, 0) << dut.err;
  const auto json = nlohmann::json::parse(dut.out);
  EXPECT_EQ(json["command"], "clearway evaluate sim:small --frames 30 --json");
  ASSERT_FALSE(json["objects"].empty());
  for (const auto& object : json["objects"]) {
    const auto& ahead = object["prediction"];
    ASSERT_EQ(ahead.size(), 4u);
    EXPECT_EQ(ahead[0]["ahead_s"], 0.5);
    ASSERT_GT(ahead[0]["count"], 10) << object;
    EXPECT_GE(ahead[0]["p95_m"], ahead[0]["median_m"]) << object;
    EXPECT_LE(ahead[0]["median_m"], ahead[1]["median_m"]) << object;
  }
  const Finished noisy =
      RunClearway({"evaluate", "sim:small", "--frames", "30", "--noise", "table1", "--json"});
  const auto with_noise = nlohmann::json::parse(noisy.out);
  EXPECT_GT(with_noise["objects"][0]["prediction"][0]["median_m"],
            json["objects"][0]["prediction"][0]["median_m"]);
  const Finished brief = RunClearway({"evaluate", "sim:small", "--frames", "3", "--json"});
  const auto too_short = nlohmann::json::parse(brief.out)["objects"][0]["prediction"][0];
  EXPECT_EQ(too_short["count"], 0);
  EXPECT_TRUE(too_short["median_m"].is_null());
}

TEST(Evaluate, APartOfASequence) {
  const auto evaluate = [](std::vector<std::string> flags) {
    flags.insert(flags.begin(), {"evaluate", "sim:small", "--frames", "30", "--json"});
    const Finished dut = RunClearway(flags);
    EXPECT_EQ(dut.exit_code, 0) << dut.err;
    return nlohmann::json::parse(dut.out);
  };
  const auto numbers = evaluate({"--from", "11", "--to", "25"});
  EXPECT_EQ(numbers["frames"], 15);
  EXPECT_THAT(numbers["source"].get<std::string>(), HasSubstr(", frames 11 to 25"));
  // Ten frames a second: what is predicted from frame 11 on is compared with the truth.
  const auto& object = numbers["objects"][0];
  EXPECT_GT(object["prediction"][0]["count"], 0);
  EXPECT_EQ(object["reconstruction"]["completeness"], 1);
  EXPECT_FALSE(object["solids"].empty());
  const auto seconds = evaluate({"--from", "1.1s", "--to", "2.5s"});
  EXPECT_EQ(seconds["objects"], numbers["objects"]);
  EXPECT_EQ(seconds["static"], numbers["static"]);
}

TEST(Evaluate, APartThatIsNotThereIsRefused) {
  const auto refused = [](std::vector<std::string> flags) {
    flags.insert(flags.begin(), {"evaluate", "sim:small", "--frames", "30"});
    const Finished dut = RunClearway(flags);
    EXPECT_EQ(dut.exit_code, 2);
    return dut.err;
  };
  EXPECT_THAT(refused({"--from", "30"}), HasSubstr("ends at frame 29, 2.9 s after frame 0"));
  EXPECT_THAT(refused({"--to", "3s"}), HasSubstr("--to 3.0 s is beyond the last frame"));
  EXPECT_THAT(refused({"--from", "2.01s", "--to", "2.02s"}), HasSubstr("no frame lies between"));
  EXPECT_THAT(refused({"--from", "soon"}), HasSubstr("--from"));
}

TEST(Evaluate, MapsAgainstTheSimulatorsTruth) {
  const Finished dut =
      RunClearway({"evaluate", "sim:small", "--frames", "30", "--motion", "track", "--json"});
  ASSERT_EQ(dut.exit_code, 0) << dut.err;
  const auto json = nlohmann::json::parse(dut.out);
  for (const auto& object : json["objects"]) {
    EXPECT_EQ(object["reconstruction"]["completeness"], 1) << object;
    EXPECT_LT(object["reconstruction"]["accuracy_m"], 0.05) << object;
    EXPECT_EQ(object["solids"][1]["ahead_s"], 1);
    EXPECT_EQ(object["size"]["true_m"].size(), 3u);
    EXPECT_LT(object["size"]["worst_difference_m"], 0.25);
    EXPECT_EQ(object["ways"].size(), 5u);
    EXPECT_LE(object["ways"][2]["truly_occupied"]["occupied"],
              json["ways"][2]["truly_occupied"]["occupied"]);
  }
  EXPECT_GT(json["solids"][1]["f_score"], 0.8);
  EXPECT_LE(json["solids"][1]["whole_f_score"], json["solids"][1]["f_score"]);
  EXPECT_LT(json["reconstruction"]["worst_accuracy_voxels"], 0.5);
  EXPECT_EQ(json["reconstruction"]["completeness"], 1);
  EXPECT_LT(json["prediction"][1]["median_turn_rad"], 0.01);
  EXPECT_GT(json["static"]["grid"]["truly_free"]["free"], 1000);
  EXPECT_EQ(json["static"]["residual_voxels"], 0);
  EXPECT_EQ(json["static"]["free_precision"], 1);
  const Finished text = RunClearway({"evaluate", "sim:small", "--frames", "3"});
  for (const char* told : {"predictions", "covered", "F-scores", "precision", "nothing static",
                           "map / box", "places that each object passes"}) {
    EXPECT_THAT(text.out, HasSubstr(told));
  }
  EXPECT_EQ(RunClearway({"evaluate", "sim:small", "--motion", "first"}).exit_code, 2);
}

TEST(Evaluate, ObjectsOfSmallerVoxels) {
  const Finished dut =
      RunClearway({"evaluate", "sim:small", "--frames", "3", "--object-voxel", "0.05", "--json"});
  ASSERT_EQ(dut.exit_code, 0) << dut.err;
  EXPECT_EQ(nlohmann::json::parse(dut.out)["objects"][0]["reconstruction"]["voxel_m"], 0.05);
  EXPECT_EQ(RunClearway({"evaluate", "sim:small", "--object-voxel", "0"}).exit_code, 2);
}

// Of the drift of the simulated SLAM hardly anything is left.
TEST(Evaluate, MapsOfMendedSensorPoses) {
  const auto residual = [](std::vector<std::string> flags) {
    flags.insert(flags.begin(),
                 {"evaluate", "sim:small", "--frames", "30", "--noise", "table1", "--json"});
    const Finished dut = RunClearway(flags);
    EXPECT_EQ(dut.exit_code, 0) << dut.err;
    return nlohmann::json::parse(dut.out)["static"]["residual_voxels"].get<int>();
  };
  EXPECT_LT(2 * residual({"--sensor-error", "0.29", "--sensor-error-deg", "2.1"}), residual({}));
}

TEST(Evaluate, OnAPageThatNeedsNothingElse) {
  const TemporaryFolder folder;
  const std::string page = folder / "small.html", other = folder / "small.html.png";
  std::ofstream(other) << "somebody's own";
  const Finished dut =
      RunClearway({"evaluate", "sim:small", "--frames", "12", "--html", page, "--json"});
  ASSERT_EQ(dut.exit_code, 0) << dut.err;
  const std::string html = BytesOf(page);
  for (const char* part : {"<!doctype html>", "<svg", "maps grow", "map / box", "--frames 12",
                           "alt='The scene after", "</html>"}) {
    EXPECT_THAT(html, HasSubstr(part));
  }
  const std::string image = "src='data:image/png;base64,";
  EXPECT_NE(html.find(image, html.find(image) + 1), std::string::npos);  // two
  EXPECT_EQ(html.find("src='http"), std::string::npos);
  EXPECT_EQ(BytesOf(other), "somebody's own");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2);
}

TEST(Evaluate, ReplacesNothingButAPage) {
  const TemporaryFolder folder;
  const std::string other = folder / "other", page = folder / "page.html";
  std::ofstream(other) << "somebody's own";
  std::filesystem::create_symlink(page, folder / "link.html");
  const std::vector<std::pair<std::string, std::string>> cases = {
      {other, "exists and is no page; name another file"},
      {folder / "missing/small.html", "missing/small.html: there is no such folder"},
      {folder.path(), ": is a folder"},
      {"/dev/null", "--html: /dev/null: is a device, not a file"},
      {page, ""},
      {folder / "link.html", ""}};
  for (const auto& [file, why] : cases) {
    const Finished dut = RunClearway({"evaluate", "sim:small", "--frames", "2", "--html", file});
    EXPECT_EQ(dut.exit_code, why.empty() ? 0 : 1) << file;
    EXPECT_THAT(dut.err, HasSubstr(why));
  }
  EXPECT_EQ(BytesOf(other), "somebody's own");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.html"));
  EXPECT_THAT(BytesOf(page), HasSubstr("</html>"));
}

TEST(Evaluate, AcrossAGapOfADay) {
  const TemporaryFolder folder;
  std::vector<Frame> frames;
  for (const double seconds : {1.0, 1.1, 86'401.0, 86'401.1}) {
    Frame frame = testing_support::FrameAt(seconds);
    testing_support::AddObject(frame, 1, Pose::Translation(5, 0, 1),
                               testing_support::BoxSurface({1, 1, 1}, 0.2));
    frame.poses.push_back({1, Pose::Translation(5, 0, 1)});
    frames.push_back(frame);
  }
  WriteFrames(folder / "gap.cwr", frames);
  const std::string file = folder / "gap.cwr";
  const Finished refused = RunClearway({"evaluate", file});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.err, HasSubstr("allow_stamp_jump"));
  const Finished dut = RunClearway({"evaluate", file, "--allow-stamp-jump", "--json"});
  EXPECT_EQ(dut.exit_code, 0) << dut.err;
}

// Whose rays are 1.4 degrees apart.
TEST(Evaluate, WithWrongLabels) {
  const auto object = [](std::vector<std::string> flags) {
    flags.insert(flags.begin(), {"evaluate", "sim:small", "--frames", "20", "--json"});
    return nlohmann::json::parse(RunClearway(flags).out)["objects"][0];
  };
  const auto p95_m = [](const nlohmann::json& of) {
    return of["reconstruction"]["p95_m"].get<double>();
  };
  const auto right = object({}), wrong = object({"--wrong-labels", "0.05"});
  EXPECT_GT(p95_m(wrong), 2 * p95_m(right));
  const auto other = object({"--wrong-labels", "0.05", "--wrong-labels-seed", "2"});
  EXPECT_NE(p95_m(other), p95_m(wrong));
  const auto filtered = object({"--wrong-labels", "0.05", "--filter-labels"});
  EXPECT_LT(p95_m(filtered), p95_m(right) + 0.02);
  EXPECT_LE(filtered["size"]["worst_difference_m"], 0.11);
}

TEST(Evaluate, OnlyBySeedsThatAreNumbers) {
  const Finished dut = RunClearway({"evaluate", "sim:small", "--seed", "99999999999999999999"});
  EXPECT_EQ(dut.exit_code, 2);
  EXPECT_THAT(dut.err, HasSubstr("--seed: expected a whole number from 0 to 18446744073709551615"));
  const Finished alone = RunClearway({"evaluate", "sim:small", "--wrong-labels-seed", "2"});
  EXPECT_EQ(alone.exit_code, 2);
  EXPECT_THAT(alone.err, HasSubstr("requires --wrong-labels"));
}

TEST(Evaluate, WithMasksThatAreTooLarge) {
  const auto worst_m = [](const std::string& degrees) {
    const Finished dut =
        RunClearway({"evaluate", "sim:small", "--frames", "10", "--mask-bleed", degrees, "--json"});
    const auto json = nlohmann::json::parse(dut.out);
    return json["objects"][0]["size"]["worst_difference_m"].get<double>();
  };
  EXPECT_GT(worst_m("2"), worst_m("0") + 0.2);
}

TEST(Evaluate, WithoutLabels) {
  const auto unlabelled = [](const std::string& life) {
    const Finished dut = RunClearway({"evaluate", "sim:street", "--frames", "40", "--unlabelled",
                                      "1,2,3", "--dynamic-life", life, "--json"});
    return nlohmann::json::parse(dut.out)["unlabelled"];
  };
  const auto without = unlabelled("0"), with = unlabelled("0.5");
  EXPECT_LT(without["occupied_at_once"], 0.5) << without;
  EXPECT_GT(with["occupied_at_once"], 0.8) << with;
  EXPECT_LT(with["mean_trail_voxels"], without["mean_trail_voxels"]) << with;
  EXPECT_GT(with["dynamic_voxels"], 0);
  EXPECT_EQ(without["dynamic_voxels"], 0);
  const Finished text =
      RunClearway({"evaluate", "sim:small", "--frames", "5", "--unlabelled", "1,2,3"});
  EXPECT_THAT(text.out, HasSubstr("movers that were not labelled"));
  EXPECT_THAT(text.out, Not(HasSubstr("not\nknown")));
}

TEST(Evaluate, OnlyWhatTellsTheTruth) {
  const TemporaryFolder folder;
  const std::string recording = folder / "drive.cwr";
  const Finished missing = RunClearway({"evaluate", recording});
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_THAT(missing.err, HasSubstr("drive.cwr: no such file"));
  RunClearway({"simulate", "small", "--out", recording, "--frames", "1"});
  const Finished dut = RunClearway({"evaluate", recording});
  EXPECT_EQ(dut.exit_code, 1);
  EXPECT_THAT(dut.err, HasSubstr("drive.cwr: no frame gives the pose of an object"));
  const Finished other = RunClearway({"evaluate", recording, "--unlabelled", "77"});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.err, HasSubstr("drive.cwr has no object 77; it has 1"));
}

TEST(Evaluate, ARecordingByThePosesThatItGives) {
  const TemporaryFolder folder;
  const std::string recording = folder / "drive.cwr";
  RunClearway({"simulate", "small", "--out", recording, "--frames", "12", "--objects", "poses"});
  const Finished dut = RunClearway({"evaluate", recording, "--json"});
  ASSERT_EQ(dut.exit_code, 0) << dut.err;
  const auto json = nlohmann::json::parse(dut.out);
  EXPECT_THAT(json["truth"], HasSubstr("poses of objects that the recording gives"));
  ASSERT_FALSE(json["objects"].empty());
  for (const auto& object : json["objects"]) {
    EXPECT_GT(object["prediction"][0]["count"], 0) << object;
    EXPECT_EQ(object["growth"].size(), 12u);
    EXPECT_FALSE(object.contains("reconstruction"));
    EXPECT_FALSE(object.contains("ways"));
  }
  EXPECT_FALSE(json.contains("ways"));
  EXPECT_THAT(RunClearway({"evaluate", recording}).out, HasSubstr("objects pass are not\nknown"));
}

}  // namespace
}  // namespace clearway
