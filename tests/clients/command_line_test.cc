// The tool as a program, without a server: help, usage errors, files.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "clients/subprocess.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

Finished Clearway(std::vector<std::string> arguments, const std::string& input = "") {
  arguments.insert(arguments.begin(), CLEARWAY_BINARY);
  return RunProgram(arguments, input);
}

std::vector<std::string> Commands() {
  return {"simulate", "info",  "evaluate", "replay",     "status", "objects",     "occupancy",
          "plan",     "check", "export",   "load-prior", "reset",  "server-info", "bench"};
}

TEST(CommandLine, Empty) {
  const Finished dut = Clearway({});
  EXPECT_EQ(dut.exit_code, 2);
  EXPECT_THAT(dut.err, StartsWith("clearway: give a command"));
  EXPECT_THAT(dut.out, IsEmpty());
}

TEST(CommandLine, HelpNamesEveryCommand) {
  const Finished dut = Clearway({"--help"});
  EXPECT_EQ(dut.exit_code, 0);
  for (const std::string& command : Commands()) EXPECT_THAT(dut.out, HasSubstr("\n  " + command));
}

TEST(CommandLine, EveryCommandShowsAnExampleAndHasJson) {
  for (const std::string& command : Commands()) {
    const Finished dut = Clearway({command, "--help"});
    EXPECT_EQ(dut.exit_code, 0) << command;
    EXPECT_THAT(dut.out, HasSubstr("clearway " + command + " "));
    EXPECT_THAT(dut.out, HasSubstr("Example"));
    EXPECT_THAT(dut.out, HasSubstr("--json"));
  }
}

TEST(CommandLine, NoLineOfHelpIsWiderThanATerminal) {
  for (const std::string& command : Commands()) {
    std::istringstream help(Clearway({command, "--help"}).out);
    for (std::string line; std::getline(help, line);) EXPECT_LE(line.size(), 100u) << line;
  }
}

TEST(CommandLine, UsageErrorsExitWithTwoAndNameTheFlag) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"fly"}, "fly"},
      {{"status", "--fast"}, "--fast"},
      {{"replay"}, "source"},
      {{"simulate", "small", "--out", "x", "--noise", "loud"}, "--noise"},
      {{"occupancy", "--at", "1,2"}, "--at"},
      {{"occupancy", "--at", "1,2,3", "--time", "soon"}, "--time"},
      {{"occupancy"}, "--slice"},
      {{"occupancy", "--at", "1,2,3", "--slice", "1"}, "--slice"},
      {{"check", "--state", "0,0,0,0"}, "--robot"},
      {{"check", "--robot", "box:1,1,1"}, "--state"},
      {{"check", "--robot", "box:1,1", "--state", "0,0,0,0"}, "--robot"},
      {{"check", "--robot", "box:1,1,1", "--state", "0,0,0,0", "--unknown", "2"}, "--unknown"},
      {{"check", "--robot", "box:1,1,1", "--state", "0,0,0,0", "--allow", "arm:0"}, "--allow"},
      {{"export", "--what", "all", "--out", "m.bt"}, "--what"},
      {{"export", "--out", "map"}, "--format"},
      {{"load-prior", "map.ply"}, ".bt"},
      {{"bench", "--points", "0"}, "--points"},
      {{"bench", "--seed", "-1"}, "--seed"},
      {{"simulate", "street", "--out", "x", "--seed", "-1"}, "--seed"},
      {{"bench", "--points", "5", "--states", "5"}, "--states"},
      {{"bench", "--robot", "sphere:1"}, "--states"},
      {{"bench", "--points", "5", "--unknown", "free"}, "--states"},
      {{"bench", "--connections", "0"}, "--connections"},
      {{"bench", "--seconds", "nan"}, "--seconds"},
      {{"bench", "--states", "9", "--unknown", "2"}, "--unknown"},
  };
  for (const auto& [arguments, named] : cases) {
    const Finished dut = Clearway(arguments);
    EXPECT_EQ(dut.exit_code, 2) << dut.err;
    EXPECT_THAT(dut.err, StartsWith("clearway: "));
    EXPECT_THAT(dut.err, HasSubstr(named));
    EXPECT_THAT(dut.out, IsEmpty());
  }
}

TEST(CommandLine, RefusesNumbersOutOfRangeShortly) {
  for (const std::string bad : {"nan", "-1", "inf", "1e9", "x"}) {
    const Finished dut = Clearway({"check", "--robot", "sphere:1", "--state", "0,0,0,0",
                                   "--padding=" + bad, "--server", "127.0.0.1:1"});
    EXPECT_EQ(dut.exit_code, 2) << bad;
    EXPECT_THAT(dut.err, HasSubstr("--padding: " + bad + " is not between 0 and 100000")) << bad;
  }
  EXPECT_EQ(Clearway({"status", "--timeout", "nan"}).exit_code, 2);
}

TEST(CommandLine, SaysThatNoServerAnswers) {
  for (const char* command : {"status", "bench"}) {
    // Port 1 is nobody's.
    const Finished dut = Clearway({command, "--server", "127.0.0.1:1", "--timeout", "1"});
    EXPECT_EQ(dut.exit_code, 1);
    EXPECT_THAT(dut.err, StartsWith("clearway: no server answers at 127.0.0.1:1"));
    EXPECT_THAT(dut.err, HasSubstr("clearway-server"));
  }
}

TEST(CommandLine, SimulatesAndListsARecording) {
  const TemporaryFolder folder;
  const std::string file = folder / "small.cwr";
  const Finished written =
      Clearway({"simulate", "small", "--out", file, "--frames", "4", "--seed", "3", "--json"});
  ASSERT_EQ(written.exit_code, 0) << written.err;
  const auto summary = nlohmann::json::parse(written.out);
  EXPECT_EQ(summary["frames"], 4);
  EXPECT_GT(summary["points"], 100);

  const Finished listed = Clearway({"info", file, "--json"});
  ASSERT_EQ(listed.exit_code, 0) << listed.err;
  const auto info = nlohmann::json::parse(listed.out);
  EXPECT_EQ(info["kind"], "recording");
  EXPECT_EQ(info["frames"], 4);
  EXPECT_EQ(info["points"], summary["points"]);
  EXPECT_THAT(Clearway({"info", file}).out, HasSubstr("frames      4 over"));
}

TEST(CommandLine, EvaluatesPredictionsAgainstTheSimulatorsTruth) {
  const Finished dut = Clearway({"evaluate", "sim:small", "--frames", "30", "--json"});
  ASSERT_EQ(dut.exit_code, 0) << dut.err;
  const auto json = nlohmann::json::parse(dut.out);
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
      Clearway({"evaluate", "sim:small", "--frames", "30", "--noise", "table1", "--json"});
  const auto with_noise = nlohmann::json::parse(noisy.out);
  EXPECT_GT(with_noise["objects"][0]["prediction"][0]["median_m"],
            json["objects"][0]["prediction"][0]["median_m"]);
  const Finished brief = Clearway({"evaluate", "sim:small", "--frames", "3", "--json"});
  const auto too_short = nlohmann::json::parse(brief.out)["objects"][0]["prediction"][0];
  EXPECT_EQ(too_short["count"], 0);
  EXPECT_TRUE(too_short["median_m"].is_null());
}

TEST(CommandLine, EvaluatesMapsAgainstTheSimulatorsTruth) {
  const Finished dut =
      Clearway({"evaluate", "sim:small", "--frames", "30", "--motion", "track", "--json"});
  ASSERT_EQ(dut.exit_code, 0) << dut.err;
  const auto json = nlohmann::json::parse(dut.out);
  for (const auto& object : json["objects"]) {
    EXPECT_EQ(object["reconstruction"]["completeness"], 1) << object;
    EXPECT_LT(object["reconstruction"]["accuracy_m"], 0.05) << object;
    EXPECT_EQ(object["solids"][1]["ahead_s"], 1);
    EXPECT_EQ(object["size"]["true_m"].size(), 3u);
    EXPECT_GT(object["size"]["worst_difference_m"], 0);
  }
  EXPECT_GT(json["solids"][1]["f_score"], 0.8);
  EXPECT_EQ(json["static"]["residual_voxels"], 0);
  EXPECT_EQ(json["static"]["free_precision"], 1);
  const Finished text = Clearway({"evaluate", "sim:small", "--frames", "3"});
  for (const char* told :
       {"predictions", "covered", "F-scores", "precision", "nothing static", "map / box"}) {
    EXPECT_THAT(text.out, HasSubstr(told));
  }
  EXPECT_EQ(Clearway({"evaluate", "sim:small", "--motion", "first"}).exit_code, 2);
}

// Of the drift of the simulated SLAM hardly anything is left.
TEST(CommandLine, EvaluatesMapsOfMendedSensorPoses) {
  const auto residual = [](std::vector<std::string> flags) {
    flags.insert(flags.begin(),
                 {"evaluate", "sim:small", "--frames", "30", "--noise", "table1", "--json"});
    const Finished dut = Clearway(flags);
    EXPECT_EQ(dut.exit_code, 0) << dut.err;
    return nlohmann::json::parse(dut.out)["static"]["residual_voxels"].get<int>();
  };
  EXPECT_LT(2 * residual({"--sensor-error", "0.29", "--sensor-error-deg", "2.1"}), residual({}));
}

TEST(CommandLine, EvaluatesOnAPageThatNeedsNothingElse) {
  const TemporaryFolder folder;
  const std::string page = folder / "small.html";
  const Finished dut =
      Clearway({"evaluate", "sim:small", "--frames", "12", "--html", page, "--json"});
  ASSERT_EQ(dut.exit_code, 0) << dut.err;
  const std::string html = BytesOf(page);
  for (const char* part : {"<!doctype html>", "<svg", "maps grow", "map / box", "</html>"}) {
    EXPECT_THAT(html, HasSubstr(part));
  }
  const std::string image = "src='data:image/png;base64,";
  EXPECT_NE(html.find(image, html.find(image) + 1), std::string::npos);  // two
  EXPECT_EQ(html.find("src='http"), std::string::npos);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
  const Finished nowhere =
      Clearway({"evaluate", "sim:small", "--frames", "2", "--html", folder / "missing/small.html"});
  EXPECT_EQ(nowhere.exit_code, 1);
  EXPECT_THAT(nowhere.err, HasSubstr("missing/small.html"));
}

TEST(CommandLine, EvaluatesWithWrongLabels) {
  const auto p95_m = [](const std::string& share) {
    const Finished dut =
        Clearway({"evaluate", "sim:small", "--frames", "30", "--wrong-labels", share, "--json"});
    const auto json = nlohmann::json::parse(dut.out);
    return json["objects"][0]["reconstruction"]["p95_m"].get<double>();
  };
  EXPECT_GT(p95_m("0.05"), 2 * p95_m("0"));
}

TEST(CommandLine, EvaluatesWithMasksThatAreTooLarge) {
  const auto worst_m = [](const std::string& degrees) {
    const Finished dut =
        Clearway({"evaluate", "sim:small", "--frames", "10", "--mask-bleed", degrees, "--json"});
    const auto json = nlohmann::json::parse(dut.out);
    return json["objects"][0]["size"]["worst_difference_m"].get<double>();
  };
  EXPECT_GT(worst_m("2"), worst_m("0") + 0.2);
}

TEST(CommandLine, EvaluatesWithoutLabels) {
  const auto unlabelled = [](const std::string& life) {
    const Finished dut = Clearway({"evaluate", "sim:street", "--frames", "40", "--unlabelled",
                                   "1,2,3", "--dynamic-life", life, "--json"});
    return nlohmann::json::parse(dut.out)["unlabelled"];
  };
  const auto without = unlabelled("0"), with = unlabelled("0.5");
  EXPECT_LT(without["occupied_at_once"], 0.5) << without;
  EXPECT_GT(with["occupied_at_once"], 0.8) << with;
  EXPECT_LT(with["mean_trail_voxels"], without["mean_trail_voxels"]) << with;
  EXPECT_GT(with["dynamic_voxels"], 0);
  EXPECT_EQ(without["dynamic_voxels"], 0);
  const Finished text = Clearway({"evaluate", "sim:small", "--frames", "5", "--unlabelled", "1"});
  EXPECT_THAT(text.out, HasSubstr("movers that were not labelled"));
}

TEST(CommandLine, EvaluatesWhatIsKnownAgain) {
  const auto identities = [](std::vector<std::string> flags) {
    flags.insert(flags.begin(), {"evaluate", "sim:occlusions", "--seed", "5", "--frames", "60",
                                 "--forget", "0.5", "--motion", "track", "--json"});
    return nlohmann::json::parse(Clearway(flags).out)["identities"];
  };
  const auto without = identities({}), with = identities({"--reidentify"});
  EXPECT_GE(without["came_back"], 3);
  EXPECT_EQ(without["known_again"], 0);
  EXPECT_EQ(with["came_back"], without["came_back"]);
  EXPECT_EQ(with["known_again"], with["came_back"]);
  EXPECT_EQ(with["wrong"], 0);
}

TEST(CommandLine, EvaluatesOnlyWhatTellsTheTruth) {
  const TemporaryFolder folder;
  const std::string recording = folder / "drive.cwr";
  const Finished missing = Clearway({"evaluate", recording});
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_THAT(missing.err, HasSubstr("drive.cwr: no such file"));
  Clearway({"simulate", "small", "--out", recording, "--frames", "1"});
  const Finished dut = Clearway({"evaluate", recording});
  EXPECT_EQ(dut.exit_code, 1);
  EXPECT_THAT(dut.err, HasSubstr("drive.cwr: no frame gives the pose of an object"));
}

TEST(CommandLine, EvaluatesARecordingByThePosesThatItGives) {
  const TemporaryFolder folder;
  const std::string recording = folder / "drive.cwr";
  Clearway({"simulate", "small", "--out", recording, "--frames", "12", "--objects", "poses"});
  const Finished dut = Clearway({"evaluate", recording, "--json"});
  ASSERT_EQ(dut.exit_code, 0) << dut.err;
  const auto json = nlohmann::json::parse(dut.out);
  EXPECT_THAT(json["truth"], HasSubstr("poses of objects that the recording gives"));
  ASSERT_FALSE(json["objects"].empty());
  for (const auto& object : json["objects"]) {
    EXPECT_GT(object["prediction"][0]["count"], 0) << object;
    EXPECT_EQ(object["growth"].size(), 12u);
    EXPECT_FALSE(object.contains("reconstruction"));
  }
}

TEST(CommandLine, NeverReplacesARecordingUnasked) {
  const TemporaryFolder folder;
  const std::string file = folder.Write("small.cwr", "mine");
  const Finished dut = Clearway({"simulate", "small", "--out", file, "--frames", "2"});
  EXPECT_EQ(dut.exit_code, 1);
  EXPECT_THAT(dut.err, HasSubstr("exists; --force replaces it"));
  EXPECT_EQ(BytesOf(file), "mine");
  EXPECT_EQ(Clearway({"simulate", "small", "--out", file, "--frames", "2", "--force"}).exit_code,
            0);
}

TEST(CommandLine, NoiseChangesARecordingAndTheSeedFixesIt) {
  const TemporaryFolder folder;
  const auto simulate = [&folder](const std::string& name, const std::string& seed) {
    Clearway({"simulate", "small", "-o", folder / name, "--frames", "3", "--noise", "table1",
              "--seed", seed});
    return BytesOf(folder / name);
  };
  const std::string first = simulate("a", "5");
  EXPECT_FALSE(first.empty());
  EXPECT_EQ(first, simulate("b", "5"));
  EXPECT_NE(first, simulate("c", "6"));
}

TEST(CommandLine, InfoTellsWhatASimulationHolds) {
  const Finished dut = Clearway({"info", "sim:crossing", "--json"});
  ASSERT_EQ(dut.exit_code, 0) << dut.err;
  const auto info = nlohmann::json::parse(dut.out);
  EXPECT_EQ(info["kind"], "simulation");
  EXPECT_GT(info["objects"].size(), 1u);
}

TEST(CommandLine, AnUnknownScenarioListsTheKnownOnes) {
  const Finished dut = Clearway({"info", "sim:moon"});
  EXPECT_EQ(dut.exit_code, 1);
  EXPECT_THAT(dut.err, HasSubstr("crossing"));
}

TEST(CommandLine, NamesABadFile) {
  const TemporaryFolder folder;
  for (const char* name : {"broken.cwr", "broken.bt", "broken.ot"}) {
    const std::string file = folder.Write(name, "not a file of this kind");
    const Finished dut = Clearway({"info", file});
    EXPECT_EQ(dut.exit_code, 1) << name;
    EXPECT_THAT(dut.err, HasSubstr(name));
  }
  const Finished missing = Clearway({"info", folder / "none.cwr"});
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_THAT(missing.err, HasSubstr("none.cwr"));
  EXPECT_EQ(Clearway({"info", folder.path()}).exit_code, 1);
}

TEST(CommandLine, ReplayRefusesAMap) {
  const Finished dut = Clearway({"replay", "map.bt"});
  EXPECT_EQ(dut.exit_code, 1);
  EXPECT_THAT(dut.err, HasSubstr("load-prior"));
}

TEST(CommandLine, NamesTheFieldOfABrokenRobot) {
  const TemporaryFolder folder;
  const std::string file = folder.Write("robot.json", R"({"name": "r", "links": [{}]})");
  const Finished dut = Clearway({"check", "--robot", file, "--state", "0,0,0,0"});
  EXPECT_EQ(dut.exit_code, 1);
  EXPECT_THAT(dut.err, HasSubstr("robot.json: links[0].name: missing"));
}

TEST(CommandLine, ReadsStatesFromStandardInput) {
  const Finished dut =
      Clearway({"check", "--robot", "box:1,1,1", "--states", "-"}, "x,y,z,yaw\n1,2,three,4\n");
  EXPECT_EQ(dut.exit_code, 1);
  EXPECT_THAT(dut.err, HasSubstr("stdin, line 2, column z"));
}

}  // namespace
}  // namespace clearway
