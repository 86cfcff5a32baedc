#include "cli/scenario_file.h"

#include <gmock/gmock.h>

#include <fstream>
#include <optional>

#include "support/data_variable.h"
#include "support/temporary_folder.h"

namespace clearway::cli {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr char kDoor[] = R"({
  "name": "door", "robot": "cylinder:0.3,1", "space": {"type": "plane", "turns": false},
  "area_m": [[-6, -4, 0], [6, 4, 0]], "max_speed_mps": 1.5, "start": [-5, 0], "goal": [5, 0],
  "start_s": 2, "time_limit_s": 60, "unknown": "free", "padding_m": 0.1, "optimum_s": 9,
  "objects": [
    {"id": 3, "shape": {"type": "box", "size_m": [0.2, 1.6, 2]}, "pose": {"position_m": [0, 0, 1]},
     "future": [{"t_s": 10, "pose": {"position_m": [0, 0, 7]}}]},
    {"id": 4, "shape": {"type": "sphere", "radius_m": 0.5}, "velocity_mps": [1, 0, 0]}
  ]})";

// kDoor with one text in the place of another.
std::string Spoilt(const std::string& what, const std::string& by) {
  std::string text = kDoor;
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}
std::string MessageOf(const std::string& text) {
  return std::string(ParseScenario("s.json", text).status().message());
}

TEST(ScenarioFile, ReadsAllOfIt) {
  const auto dut = ParseScenario("s.json", kDoor);
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->name, "door");
  EXPECT_EQ(std::get<Cylinder>(dut->robot.links[0].shapes[0].shape), (Cylinder{0.3, 1}));
  EXPECT_FALSE(std::get<PlaneSpace>(dut->task.space).turns);
  EXPECT_EQ(dut->task.area_W, (Aabb{{-6, -4, 0}, {6, 4, 0}}));
  EXPECT_EQ(dut->task.max_speed_mps, 1.5);
  EXPECT_EQ(dut->task.start, (std::vector<double>{-5, 0}));
  EXPECT_EQ(dut->task.start_time, Time() + std::chrono::seconds(2));
  EXPECT_EQ(dut->task.time_limit, std::chrono::seconds(60));
  EXPECT_EQ(dut->task.options.check.unknown, UnknownPolicy::kFree);
  EXPECT_EQ(dut->task.options.check.padding_m, 0.1);
  EXPECT_EQ(dut->optimum_s, 9);
  EXPECT_TRUE(dut->solvable);
  ASSERT_EQ(dut->objects.size(), 2u);
  EXPECT_EQ(dut->objects[0].id, 3);
  EXPECT_EQ(dut->objects[0].future[0].stamp, Time() + std::chrono::seconds(10));
  EXPECT_EQ(dut->objects[0].future[0].T_W_O.translation, Eigen::Vector3d(0, 0, 7));
  EXPECT_EQ(dut->objects[1].velocity_O->linear, Eigen::Vector3d(1, 0, 0));
}

TEST(ScenarioFile, DelayMovesAllTimes) {
  auto scenario = ParseScenario("s.json", kDoor);
  ASSERT_TRUE(scenario.ok());
  Scenario& dut = *scenario;
  Delay(std::chrono::seconds(100), dut);
  EXPECT_EQ(dut.task.start_time, Time() + std::chrono::seconds(102));
  EXPECT_EQ(dut.objects[0].pose.stamp, Time() + std::chrono::seconds(100));
  EXPECT_EQ(dut.objects[0].future[0].stamp, Time() + std::chrono::seconds(110));
}

TEST(ScenarioFile, ReadsArmsAndFlight) {
  const auto arm = ParseScenario("s.json", R"({"name": "arm", "robot": {"name": "r", "links": [
      {"name": "base", "shapes": [{"type": "box", "size_m": [1, 1, 1]}]},
      {"name": "one", "shapes": [{"type": "box", "size_m": [1, 1, 1]}]}]},
    "space": {"type": "arm", "base": {"position_m": [1, 2, 3]}, "joints": [
      {"pose": {"position_m": [0, 0, 1]}, "axis": [0, 1, 0], "min_rad": -1, "max_rad": 2, "max_radps": 0.5}]},
    "start": [0], "goal": [1], "time_limit_s": 10})");
  ASSERT_TRUE(arm.ok()) << arm.status();
  const auto& space = std::get<ArmSpace>(arm->task.space);
  EXPECT_EQ(space.T_W_B.translation, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(space.joints[0].axis_J, Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(space.joints[0].max_rad, 2);
  const auto flight = ParseScenario(
      "s.json", R"({"name": "f", "robot": "sphere:1", "space": {"type": "flight", "turns": false},
    "area_m": [[0, 0, 0], [9, 9, 9]], "max_speed_mps": 1, "start": [1, 1, 1], "goal": [2, 2, 2],
    "time_limit_s": 10})");
  ASSERT_TRUE(flight.ok()) << flight.status();
  EXPECT_FALSE(std::get<FlightSpace>(flight->task.space).turns);
}

TEST(ScenarioFile, WhatIsWrongIsNamed) {
  const auto expect = [](const char* what, const char* by, const char* message) {
    EXPECT_THAT(MessageOf(Spoilt(what, by)), HasSubstr(message)) << what << " -> " << by;
  };
  EXPECT_THAT(MessageOf("{"), HasSubstr("s.json: parse error at line 1"));
  expect("\"name\": \"door\",", "", "s.json: name: missing");
  expect("\"padding_m\"", "\"paddin\"", "s.json: paddin: unknown field");
  expect("\"plane\"", "\"plain\"", "space.type: expected plane, flight or arm");
  expect("\"turns\": false", "\"turns\": 1", "space.turns: expected true or false");
  expect("\"turns\": false", "\"turns\": false, \"clearance_m\": -0.1",
         "space.clearance_m: is below 0");
  expect("[6, 4, 0]]", "[6, 4]]", "area_m[1]: expected 3 numbers");
  expect("\"start\": [-5, 0]", "\"start\": [-5]", "start has 1 numbers; it must have 2");
  expect("\"start\": [-5, 0]", "\"start\": [-50, 0]", "start[0] is -50");
  expect("\"max_speed_mps\": 1.5", "\"max_speed_mps\": 0", "max_speed_mps is 0");
  expect("\"free\"", "\"fre\"", "unknown: ");
  expect("cylinder:0.3,1", "cylinder:0.3", "s.json: robot: expected box:x,y,z");
  expect("\"id\": 3", "\"id\": 3.5", "objects[0].id: expected a whole number");
  expect("\"t_s\": 10, ", "", "objects[0].future[0].t_s: missing");
  expect("\"t_s\": 10, ", "\"t_s\": 1e15, ",
         "objects[0].future[0].t_s: is 1e+15 s, must be at most 1e+06 s either way");
  expect("\"radius_m\": 0.5", "\"radius_m\": -1", "objects[1].shape.radius_m");
  expect("\"id\": 4", "\"id\": 3", "s.json: objects[1].id: 3 is the id of objects[0], too");
  expect("\"id\": 3", "\"id\": 1e10",
         "objects[0].id: expected a whole number from 1 to 999999999, not 1e+10");
  for (const char* limit : {"0", "3601", "1e300"}) {
    expect("\"time_limit_s\": 60", (std::string("\"time_limit_s\": ") + limit).c_str(),
           "; it must be above 0, and at most 3600");
  }
}

TEST(ScenarioFile, KeysThatAreGivenTwiceAreNamed) {
  const auto expect = [](const char* what, const char* by, const char* message) {
    EXPECT_EQ(MessageOf(Spoilt(what, by)), message);
  };
  expect("\"start_s\": 2,", "\"start_s\": 2, \"name\": \"other\",", "s.json: name: given twice");
  expect("\"id\": 4,", "\"id\": 4, \"id\": 5,", "s.json: objects[1].id: given twice");
  expect("\"t_s\": 10,", "\"t_s\": 10, \"t_s\": 10,",
         "s.json: objects[0].future[0].t_s: given twice");
  EXPECT_TRUE(ParseScenario("s.json", kDoor).ok());
}

// Two people: one is seen from 8 s to 12 s and goes along x, one long before.
TEST(ScenarioFile, RecordedPeopleGoStraightBeforeAndAfterTheyAreSeen) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "people.txt")
      << "200 7 1 0 5 1 0 0\n300 7 5 0 5 2 0 0\n\n10 8 0 0 0 0 0 0\n";
  std::optional<DataVariable> data(folder.path());
  const std::string text = Spoilt(
      "\"objects\"", R"("tracks": {"format": "ucy", "file": "people.txt", "from_s": 6, "for_s": 10,
                        "radius_m": 0.3, "height_m": 1.8}, "objects")");
  const auto scenario = ParseScenario("s.json", text);
  data.reset();
  ASSERT_TRUE(scenario.ok()) << scenario.status();
  ASSERT_EQ(scenario->objects.size(), 3u);
  const GivenObject& dut = scenario->objects[2];
  EXPECT_EQ(std::get<Cylinder>(dut.shape), (Cylinder{0.3, 1.8}));
  EXPECT_EQ(dut.pose.stamp, Time());
  EXPECT_EQ(dut.pose.T_W_O.translation, Eigen::Vector3d(-1, 5, 0.9));
  ASSERT_EQ(dut.future.size(), 3u);
  EXPECT_EQ(dut.future[0].stamp, Time() + std::chrono::seconds(2));
  EXPECT_EQ(dut.future[0].T_W_O.translation, Eigen::Vector3d(1, 5, 0.9));
  EXPECT_EQ(dut.future[1].T_W_O.translation, Eigen::Vector3d(5, 5, 0.9));
  EXPECT_EQ(dut.future[2].stamp, Time() + std::chrono::seconds(10));
  EXPECT_EQ(dut.future[2].T_W_O.translation, Eigen::Vector3d(13, 5, 0.9));
  EXPECT_THAT(MessageOf(text), HasSubstr("tracks.file: no people.txt in the folder"));
}

// Where the recording is over there is nobody left.
TEST(ScenarioFile, RecordingsThatAreOverAreRefused) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "people.txt")
      << "200 7 1 0 5 1 0 0\n300 7 5 0 5 2 0 0\n\n10 8 0 0 0 0 0 0\n";
  const DataVariable data(folder.path());
  const auto parse = [](const std::string& from_s) {
    return ParseScenario("s.json", Spoilt("\"objects\"",
                                          R"("tracks": {"format": "ucy", "file": "people.txt",
                                             "for_s": 1, "radius_m": 0.3, "height_m": 1.8,
                                             "from_s": )" +
                                              from_s + R"(}, "objects")"));
  };
  for (const char* from_s : {"12", "500"}) {
    EXPECT_EQ(parse(from_s).status().message(), std::string("s.json: tracks.from_s: is ") + from_s +
                                                    "; the recording lasts from 0.4 to 12 s");
  }
  const auto inside = parse("10"), beyond = parse("11.5");
  ASSERT_TRUE(inside.ok() && beyond.ok());
  EXPECT_EQ(inside->note, "");
  EXPECT_THAT(beyond->note, HasSubstr("the recording lasts from 0.4 to 12 s"));
  EXPECT_THAT(beyond->note, HasSubstr("until 12.5 s of it"));
  EXPECT_EQ(inside->names.at(1'000'000), "person 7 of people.txt");
}

// What the file says about an object names it.
TEST(ScenarioFile, ObjectsHaveTheNamesThatTheFileGivesThem) {
  const auto dut =
      ParseScenario("s.json", Spoilt("{\"id\": 3,", R"({"id": 3, "about": "a door",)"));
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->names, (std::map<ObjectId, std::string>{{3, "a door"}}));
}

TEST(ScenarioFile, JointsWhoseLimitsDescendAreNamed) {
  EXPECT_EQ(MessageOf(Spoilt(R"({"type": "plane", "turns": false})",
                             R"({"type": "arm", "joints": [
                                {"min_rad": 1, "max_rad": 0.5, "max_radps": 1}]})")),
            "s.json: space.joints[0]: min_rad is 1; it must be at most max_rad, which is 0.5");
}

TEST(ScenarioFile, AFileThatIsNotThere) {
  const auto dut = LoadScenario("/nowhere/s.json");
  EXPECT_EQ(dut.status().code(), absl::StatusCode::kNotFound);
  EXPECT_THAT(std::string(dut.status().message()), HasSubstr("/nowhere/s.json: no such scenario"));
}

TEST(ScenarioFile, AStartBeforeTheScenesIsNamedInSeconds) {
  EXPECT_EQ(
      MessageOf(Spoilt("\"start_s\": 2", "\"start_s\": -1")),
      "s.json: start_s: is -1 s; it must not be below 0: times count from the newest stamp of "
      "the scene");
}

std::string WithPeople(const std::string& more = "") {
  return Spoilt("\"objects\"", R"("tracks": {"format": "ucy", "file": "people.txt", "for_s": 10,
                                "radius_m": 0.3, "height_m": 1.8)" +
                                   more + R"(}, "objects")");
}

TEST(ScenarioFile, BadRowsOfRecordedPeopleAreLeftOutAndNamed) {
  const TemporaryFolder folder;
  const DataVariable data(folder.path());
  folder.Write("people.txt",
               "0 7 1 0 5 1 0 0\n25 7 nan 0 5 1 0 0\n50,7,3,0,5,1,0,0\n75 7 1e7 0 5 1 0 0\n"
               "80 8 -1e7 0 0 0 0 0\n100 7 5 0\n");
  const auto dut = ParseScenario("s.json", WithPeople());
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->left_out.rows, 4u);
  EXPECT_THAT(dut->left_out.reasons,
              ElementsAre(HasSubstr("people.txt, line 2, word 3: 'nan' is not a finite number"),
                          HasSubstr("people.txt, line 6: 4 words, expected eight"),
                          "people.txt, line 4: person 7 is at 10000000,5,0.9, beyond the limit of "
                          "100000 m from the origin",
                          HasSubstr("people.txt, line 5: person 8 is at -10000000,")));
  ASSERT_EQ(dut->objects.size(), 3u);
  const GivenObject& person = dut->objects[2];
  EXPECT_EQ(person.pose.T_W_O.translation, Eigen::Vector3d(1, 5, 0.9));
  ASSERT_EQ(person.future.size(), 2u);
  EXPECT_EQ(person.future[0].T_W_O.translation, Eigen::Vector3d(3, 5, 0.9));
}

TEST(ScenarioFile, PeopleMostOfWhomAreFarAreRefused) {
  const TemporaryFolder folder;
  const DataVariable data(folder.path());
  folder.Write("people.txt", "0 7 1 0 5 1 0 0\n25 7 1e7 0 5 1 0 0\n50 7 1e7 0 5 1 0 0\n");
  EXPECT_THAT(MessageOf(WithPeople()),
              HasSubstr("tracks.file: has something at 10000000,5,0.9, beyond the limit"));
  EXPECT_TRUE(ParseScenario("s.json", WithPeople(R"(, "origin_m": [1e7, 0, 0])")).ok());
}

}  // namespace
}  // namespace clearway::cli
