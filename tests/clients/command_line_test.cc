// The tool as a program, without a server: help, usage errors, files.
#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "clients/run_clearway.h"
#include "clients/subprocess.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

std::vector<std::string> Commands() {
  return {"simulate",     "info",      "evaluate", "record",      "replay", "status",
          "objects",      "occupancy", "plan",     "check",       "export", "load-prior",
          "clear-region", "keep-out",  "reset",    "server-info", "bench"};
}

TEST(CommandLine, Empty) {
  const Finished dut = RunClearway({});
  EXPECT_EQ(dut.exit_code, 2);
  EXPECT_THAT(dut.err, StartsWith("clearway: give a command"));
  EXPECT_THAT(dut.out, IsEmpty());
}

TEST(CommandLine, HelpNamesEveryCommand) {
  const Finished dut = RunClearway({"--help"});
  EXPECT_EQ(dut.exit_code, 0);
  for (const std::string& command : Commands()) EXPECT_THAT(dut.out, HasSubstr("\n  " + command));
}

TEST(CommandLine, EveryCommandShowsAnExampleAndHasJson) {
  for (const std::string& command : Commands()) {
    const Finished dut = RunClearway({command, "--help"});
    EXPECT_EQ(dut.exit_code, 0) << command;
    EXPECT_THAT(dut.out, HasSubstr("clearway " + command + " "));
    EXPECT_THAT(dut.out, HasSubstr("Example"));
    EXPECT_THAT(dut.out, HasSubstr("--json"));
  }
}

TEST(CommandLine, NoLineOfHelpIsWiderThanATerminal) {
  for (const std::string& command : Commands()) {
    std::istringstream help(RunClearway({command, "--help"}).out);
    for (std::string line; std::getline(help, line);) EXPECT_LE(line.size(), 100u) << line;
  }
}

TEST(CommandLine, UsageErrorsExitWithTwoAndNameTheFlag) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"fly"}, "fly"},
      {{"status", "--fast"}, "--fast"},
      {{"evaluate", "--bogus"}, "--bogus"},
      {{"evaluate", "sim:small", "--html", ""}, "--html"},
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
      {{"clear-region"}, "box"},
      {{"clear-region", "0,0,0,1,1"}, "x0,y0,z0,x1,y1,z1"},
      {{"clear-region", "0,0,0,1,1,nan"}, "x0,y0,z0,x1,y1,z1"},
      {{"clear-region", "-inf,0,0,1,1,1"}, "neither a flag nor a list of finite numbers"},
      {{"clear-region", "0,0,2,1,1,1"}, "z0 must not exceed z1"},
      {{"clear-region", "-1,-1,-1,1,inf,1"}, "x0,y0,z0,x1,y1,z1"},
      {{"keep-out", "--add", "3,0,0,1,1,1"}, "--add"},
      {{"keep-out", "--add", "0,0,0,1,1,nan"}, "--add"},
      {{"keep-out", "--add"}, "--add"},
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
    const Finished dut = RunClearway(arguments);
    EXPECT_EQ(dut.exit_code, 2) << dut.err;
    EXPECT_THAT(dut.err, StartsWith("clearway: "));
    EXPECT_THAT(dut.err, HasSubstr(named));
    EXPECT_THAT(dut.out, IsEmpty());
  }
}

TEST(CommandLine, SaysWhenItsOutputCannotBeWritten) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  for (const std::string flags : {"--version", "--help", "info sim:small --json"}) {
    const Finished dut =
        RunProgram({"/bin/sh", "-c", std::string(CLEARWAY_BINARY) + " " + flags + " > /dev/full"});
    EXPECT_EQ(dut.exit_code, 1) << flags;
    EXPECT_THAT(dut.err, HasSubstr("the output cannot be written")) << flags;
  }
}

TEST(CommandLine, RefusesNumbersOutOfRangeShortly) {
  for (const std::string bad : {"nan", "-1", "inf", "1e9", "x"}) {
    const Finished dut = RunClearway({"check", "--robot", "sphere:1", "--state", "0,0,0,0",
                                      "--padding=" + bad, "--server", "127.0.0.1:1"});
    EXPECT_EQ(dut.exit_code, 2) << bad;
    EXPECT_THAT(dut.err, HasSubstr("--padding: " + bad + " is not between 0 and 100000")) << bad;
  }
  EXPECT_EQ(RunClearway({"status", "--timeout", "nan"}).exit_code, 2);
}

TEST(CommandLine, NumbersAreDecimal) {
  for (const std::vector<std::string>& flags : std::vector<std::vector<std::string>>{
           {"clear-region", "0x1,0,0,20,1,1"},
           {"keep-out", "--add", "0x1,0,0,20,1,1"},
           {"occupancy", "--at", "0x1,0,0"},
           {"occupancy", "--slice", "0x1"},
           {"check", "--robot", "box:0x1,1,1", "--state", "0,0,0,0"},
           {"check", "--robot", "box:1,1,1", "--state", "0x1,0,0,0"},
           {"check", "--robot", "box:1,1,1", "--state", "0,0,0,0", "--padding", "0x1"},
           {"check", "--robot", "box:1,1,1", "--state", "0,0,0,0", "--ignore", "0x10"},
           {"check", "--robot", "box:1,1,1", "--state", "0,0,0,0", "--ignore", "010"},
           {"objects", "--remove", "7,010"},
           {"simulate", "small", "--out", "/nonexistent/x.cwr", "--seed", "0x10"},
           {"simulate", "small", "--out", "/nonexistent/x.cwr", "--frames", "010"},
           {"status", "--timeout", "0x1"}}) {
    std::vector<std::string> line = flags;
    const bool asks = line.front() != "simulate";
    if (asks) line.insert(line.end(), {"--server", "127.0.0.1:1"});
    EXPECT_EQ(RunClearway(line).exit_code, 2) << flags.front() << " " << flags.back();
  }
}

TEST(CommandLine, SaysWhatIsWrongWithWholeNumbers) {
  for (const std::string bad : {"abc", "-1", "18446744073709551616", "1.5"}) {
    EXPECT_THAT(RunClearway({"replay", "sim:small", "--sensor-run=" + bad}).err,
                HasSubstr("--sensor-run: expected a whole number from 0 to 18446744073709551615, "
                          "not '" +
                          bad + "'"));
  }
  const Finished most = RunClearway({"replay", "sim:small", "--sensor-run", "18446744073709551615",
                                     "--server", "127.0.0.1:1", "--timeout", "1"});
  EXPECT_EQ(most.exit_code, 1) << most.err;
}

TEST(CommandLine, FlagsBehindTwoDashesAreNone) {
  const Finished dut = RunClearway({"clear-region", "--", "-1,-1,-1,2,2,2", "--json"});
  EXPECT_EQ(dut.exit_code, 2);
  EXPECT_THAT(dut.err, HasSubstr("--json comes after --, so it is not read as a flag"));
  EXPECT_THAT(RunClearway({"clear-region", "--server", "127.0.0.1:1", "--timeout", "1", "--",
                           "-1,-1,-1,2,2,2"})
                  .err,
              HasSubstr("no server answers"));
}

TEST(CommandLine, FarOriginsAreRefusedWithTheLimit) {
  EXPECT_THAT(RunClearway({"export", "--out", "x.ply", "--origin", "1e9,0,0"}).err,
              HasSubstr("--origin: '1e9,0,0' is beyond the limit of 1e+08 m either way"));
}

TEST(CommandLine, SaysThatNoServerAnswers) {
  for (const char* command : {"status", "bench"}) {
    // Port 1 is nobody's.
    const Finished dut = RunClearway({command, "--server", "127.0.0.1:1", "--timeout", "1"});
    EXPECT_EQ(dut.exit_code, 1);
    EXPECT_THAT(dut.err, StartsWith("clearway: no server answers at 127.0.0.1:1"));
    EXPECT_THAT(dut.err, HasSubstr("clearway-server"));
  }
}

TEST(CommandLine, SaysWhatIsWrongWithAnAddress) {
  for (const auto& [address, part] : std::vector<std::pair<std::string, std::string>>{
           {"", "is missing; write host:port or unix:/path"},
           {"127.0.0.1:65537", "port 65537 is out of range; the limit is 65535"},
           {"127.0.0.1:0", "port 0 is out of range; the least is 1"},
           {"127.0.0.1:5x", "port \"5x\" is not a number from 1 to 65535"},
           {"127.0.0.1:5 ", "port \"5 \" is not a number from 1 to 65535"},
           {"localhost", "localhost is neither host:port nor unix:/path; it names no port"},
           {"http://localhost:50151",
            "is a URL and neither host:port nor unix:/path; write "
            "localhost:50151"},
           {"/tmp/x.sock", "write unix:/tmp/x.sock if it is a socket's path"}}) {
    const Finished dut = RunClearway({"status", "--server", address, "--timeout", "1"});
    EXPECT_EQ(dut.exit_code, 1);
    EXPECT_THAT(dut.err, StartsWith("clearway: --server or CLEARWAY_ADDRESS: ")) << address;
    EXPECT_THAT(dut.err, HasSubstr(part));
  }
}

TEST(CommandLine, SimulatesAndListsARecording) {
  const TemporaryFolder folder;
  const std::string file = folder / "small.cwr";
  const Finished written =
      RunClearway({"simulate", "small", "--out", file, "--frames", "4", "--seed", "3", "--json"});
  ASSERT_EQ(written.exit_code, 0) << written.err;
  const auto summary = nlohmann::json::parse(written.out);
  EXPECT_EQ(summary["frames"], 4);
  EXPECT_GT(summary["points"], 100);

  const Finished listed = RunClearway({"info", file, "--json"});
  ASSERT_EQ(listed.exit_code, 0) << listed.err;
  const auto info = nlohmann::json::parse(listed.out);
  EXPECT_EQ(info["kind"], "recording");
  EXPECT_EQ(info["frames"], 4);
  EXPECT_EQ(info["points"], summary["points"]);
  EXPECT_THAT(RunClearway({"info", file}).out, HasSubstr("frames      4 over"));
}

TEST(CommandLine, NeverReplacesARecordingUnasked) {
  const TemporaryFolder folder;
  const std::string file = folder.Write("small.cwr", "mine");
  const Finished dut = RunClearway({"simulate", "small", "--out", file, "--frames", "2"});
  EXPECT_EQ(dut.exit_code, 1);
  EXPECT_THAT(dut.err, HasSubstr("exists; --force replaces it"));
  EXPECT_EQ(BytesOf(file), "mine");
  EXPECT_EQ(RunClearway({"simulate", "small", "--out", file, "--frames", "2", "--force"}).exit_code,
            0);
}

TEST(CommandLine, NoiseChangesARecordingAndTheSeedFixesIt) {
  const TemporaryFolder folder;
  const auto simulate = [&folder](const std::string& name, const std::string& seed) {
    RunClearway({"simulate", "small", "-o", folder / name, "--frames", "3", "--noise", "table1",
                 "--seed", seed});
    return BytesOf(folder / name);
  };
  const std::string first = simulate("a", "5");
  EXPECT_FALSE(first.empty());
  EXPECT_EQ(first, simulate("b", "5"));
  EXPECT_NE(first, simulate("c", "6"));
}

TEST(CommandLine, InfoTellsWhatASimulationHolds) {
  const Finished dut = RunClearway({"info", "sim:crossing", "--json"});
  ASSERT_EQ(dut.exit_code, 0) << dut.err;
  const auto info = nlohmann::json::parse(dut.out);
  EXPECT_EQ(info["kind"], "simulation");
  EXPECT_GT(info["objects"].size(), 1u);
}

TEST(CommandLine, AnUnknownScenarioListsTheKnownOnes) {
  const Finished dut = RunClearway({"info", "sim:moon"});
  EXPECT_EQ(dut.exit_code, 1);
  EXPECT_THAT(dut.err, HasSubstr("crossing"));
}

TEST(CommandLine, NamesABadFile) {
  const TemporaryFolder folder;
  for (const char* name : {"broken.cwr", "broken.bt", "broken.ot"}) {
    const std::string file = folder.Write(name, "not a file of this kind");
    const Finished dut = RunClearway({"info", file});
    EXPECT_EQ(dut.exit_code, 1) << name;
    EXPECT_THAT(dut.err, HasSubstr(name));
  }
  const Finished missing = RunClearway({"info", folder / "none.cwr"});
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_THAT(missing.err, HasSubstr("none.cwr"));
  EXPECT_EQ(RunClearway({"info", folder.path()}).exit_code, 1);
}

TEST(CommandLine, ReplayRefusesAMap) {
  const Finished dut = RunClearway({"replay", "map.bt"});
  EXPECT_EQ(dut.exit_code, 1);
  EXPECT_THAT(dut.err, HasSubstr("load-prior"));
}

TEST(CommandLine, NamesTheFieldOfABrokenRobot) {
  const TemporaryFolder folder;
  const std::string file = folder.Write("robot.json", R"({"name": "r", "links": [{}]})");
  const Finished dut = RunClearway({"check", "--robot", file, "--state", "0,0,0,0"});
  EXPECT_EQ(dut.exit_code, 1);
  EXPECT_THAT(dut.err, HasSubstr("robot.json: links[0].name: missing"));
}

TEST(CommandLine, ReadsStatesFromStandardInput) {
  const Finished dut =
      RunClearway({"check", "--robot", "box:1,1,1", "--states", "-"}, "x,y,z,yaw\n1,2,three,4\n");
  EXPECT_EQ(dut.exit_code, 1);
  EXPECT_THAT(dut.err, HasSubstr("stdin, line 2, column z"));
}

}  // namespace
}  // namespace clearway
