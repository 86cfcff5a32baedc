// clearway plan against a real server.
#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <future>
#include <nlohmann/json.hpp>
#include <set>

#include "clients/cli_server.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

using CliPlan = CliServer;

// Every file that comes with Clearway.
TEST_F(CliPlan, PlansInScenarios) {
  int scenarios = 0;
  for (const auto& entry : std::filesystem::directory_iterator(CLEARWAY_SCENARIOS)) {
    ++scenarios;
    const std::string file = entry.path().string();
    std::ifstream stream(file);
    const json scenario = json::parse(stream);
    if (scenario.contains("tracks")) continue;  // a recording's
    const bool solvable = scenario.value("solvable", true);
    const Finished dut = Clearway({"plan", file, "--first", "--budget", solvable ? "20" : "0.1"});
    if (solvable) {
      EXPECT_EQ(dut.exit_code, 0) << file << ": " << dut.err;
      EXPECT_THAT(dut.out, HasSubstr("arrives after"));
    }
    EXPECT_EQ(Ask({"objects"})["objects"], json::array());  // they are taken away again
  }
  EXPECT_GE(scenarios, 9);
}

TEST_F(CliPlan, APlanIsAPathInTime) {
  const std::string file = std::string(CLEARWAY_SCENARIOS) + "/one_door.json";
  const json dut = Ask({"plan", file, "--budget", "0.5"});
  EXPECT_EQ(dut["found"], true);
  ASSERT_FALSE(dut["plans"].empty());
  const double arrival_s = dut["plans"].back()["arrival_s"];
  EXPECT_GE(arrival_s, 15.4);
  EXPECT_EQ(dut["horizon_s"], 5);
  EXPECT_EQ(dut["inflation_mps"], 0);
  const json& path = dut["path"];
  EXPECT_EQ(path.front()["t_s"], 0);
  EXPECT_EQ(path.front()["configuration"], json({-5.0, 0.0}));
  EXPECT_EQ(path.back()["t_s"], arrival_s);
}

// Where it has to wait for the door, it does so at the start, and goes straight to the goal then.
TEST_F(CliPlan, AWaitComesWithoutADetour) {
  const std::string file = std::string(CLEARWAY_SCENARIOS) + "/one_door.json";
  for (int i = 0; i < 5; ++i) {
    const json dut = Ask({"plan", file, "--budget", "0.3"});
    ASSERT_EQ(dut["found"], true);
    for (const json& place : dut["path"]) EXPECT_GE(place["configuration"][0], -5.0);
  }
}

// By what it is in the file.
TEST_F(CliPlan, WhatBlocksIsNamed) {
  const TemporaryFolder folder;
  const auto plan = [&](const std::string& about) {
    return Clearway({"plan",
                     folder.Write("blocked.json", R"({"name": "b", "robot": "sphere:0.3",
      "space": {"type": "flight", "turns": false}, "area_m": [[90, 90, 0], [99, 99, 2]],
      "max_speed_mps": 1, "start": [91, 95, 1], "goal": [98, 95, 1], "time_limit_s": 60,
      "unknown": "free", "objects": [{"id": 1002, )" + about +
                                                      R"("shape": {"type": "sphere", "radius_m": 1},
                                "pose": {"position_m": [91, 95, 1]}}]})")})
        .err;
  };
  EXPECT_THAT(plan(""), HasSubstr("the start is blocked by object 1002"));
  EXPECT_THAT(plan(R"("about": "a large ball", )"),
              HasSubstr("the start is blocked by object 1002, a large ball"));
}

TEST_F(CliPlan, ABudgetAboveTheServersLimitIsRefusedWithTheLimit) {
  const std::string file = std::string(CLEARWAY_SCENARIOS) + "/one_door.json";
  const Finished dut = Clearway({"plan", file, "--budget", "100"});
  EXPECT_NE(dut.exit_code, 0);
  EXPECT_THAT(dut.err, HasSubstr("--budget is 100 s; the server's limit"));
  EXPECT_THAT(dut.err, HasSubstr("is 60 s"));
  EXPECT_EQ(Ask({"objects"})["objects"], json::array());
  EXPECT_THAT(Clearway({"plan", "--help"}).out, HasSubstr("limits.max_planning_s"));
}

// Each plan begins at a stamp that frames may leave behind before it is asked for.
TEST_F(CliPlan, PlansWhileFramesArrive) {
  const TemporaryFolder folder;
  const std::string file = folder.Write("beside.json", R"({"name": "beside", "robot": "sphere:0.3",
    "space": {"type": "flight", "turns": false}, "area_m": [[90, 90, 0], [99, 99, 2]],
    "max_speed_mps": 1, "start": [91, 95, 1], "goal": [98, 95, 1], "time_limit_s": 60,
    "unknown": "free", "objects": [{"id": 1001, "velocity_mps": [0, 0.1, 0],
      "shape": {"type": "sphere", "radius_m": 1}, "pose": {"position_m": [95, 95, 1]}}]})");
  const auto frames = std::async(std::launch::async, [this] {
    for (int frame = 0; frame < 20; ++frame) {
      const std::string index = std::to_string(frame);
      Ask({"replay", "sim:small", "--from", index, "--to", index, "--quiet"});
    }
  });
  std::set<std::uint64_t> stamps_ns;
  while (frames.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
    const Finished dut = Clearway({"plan", file, "--first", "--budget", "10", "--json"});
    ASSERT_EQ(dut.exit_code, 0) << dut.err;
    stamps_ns.insert(json::parse(dut.out)["path"][0]["stamp_ns"].get<std::uint64_t>());
  }
  EXPECT_GE(stamps_ns.size(), 3u);
}

TEST_F(CliPlan, AnInterruptedPlanTakesItsObjectsAway) {
  const std::string file = std::string(CLEARWAY_SCENARIOS) + "/one_door.json";
  const Finished dut = InterruptProgram(
      {CLEARWAY_BINARY, "plan", file, "--budget", "20", "--server", server_->address()},
      [&] { return !Ask({"objects"})["objects"].empty(); });
  EXPECT_EQ(dut.exit_code, 128 + SIGINT) << dut.err;
  EXPECT_EQ(Ask({"objects"})["objects"], json::array());
}

// In the file's own words, whether the command line or the server finds it.
TEST_F(CliPlan, WhatIsWrongInAFileIsNamedAsThere) {
  std::ifstream stream(std::string(CLEARWAY_SCENARIOS) + "/one_door.json");
  const json good = json::parse(stream);
  const TemporaryFolder folder;
  const auto names = [&](const char* message, auto&& spoil) {
    json scenario = good;
    spoil(scenario);
    folder.Write("bad.json", scenario.dump());
    const Finished dut = Clearway({"plan", (folder.path() / "bad.json").string()});
    EXPECT_EQ(dut.exit_code, 1);
    EXPECT_THAT(dut.err, HasSubstr(std::string("bad.json: ") + message));
  };
  names("space.clearance_m", [](json& s) { s["space"]["clearance_m"] = -1; });
  names("objects[0].velocity_mps", [](json& s) { s["objects"][0]["velocity_mps"] = {2000, 0, 0}; });
  names("objects[0].pose.position_m", [](json& s) {
    s["objects"][0]["pose"]["position_m"] = {1e6, 0, 0};
  });
  const json pose = {{"position_m", {0, 3.7, 1}}};
  names(
      "objects[0].future[0].t_s: is -1.0 s; it must be above 0.0 s, the time of the object's pose",
      [&](json& s) {
        s["objects"][0]["future"] = {{{"t_s", -1}, {"pose", pose}}};
      });
  names("objects[0].future[1].t_s: is 2.0 s; it must be above 2.0 s, the one before it",
        [&](json& s) {
          const json sample = {{"t_s", 2}, {"pose", pose}};
          s["objects"][0]["future"] = json::array({sample, sample});
        });
}

TEST_F(CliPlan, NoPlanSaysWhy) {
  const std::string folder = CLEARWAY_SCENARIOS;
  const Finished taken = Clearway({"plan", folder + "/goal_taken.json", "--budget", "0.1"});
  EXPECT_EQ(taken.exit_code, 1);
  EXPECT_THAT(taken.err,
              HasSubstr("the goal was never seen free, first of all blocked by object 1"));
  const Finished walled = Clearway({"plan", folder + "/walled_in.json", "--budget", "0.1"});
  EXPECT_EQ(walled.exit_code, 1);
  EXPECT_THAT(walled.err, HasSubstr("no plan found within 0.1 s"));
  EXPECT_EQ(Clearway({"plan"}).exit_code, 2);
  const Finished missing = Clearway({"plan", folder + "/nothing.json"});
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_THAT(missing.err, HasSubstr("no such scenario"));
}

}  // namespace
}  // namespace clearway
