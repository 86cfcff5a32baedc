// Scenarios of CommonRoad files: on small files in the published format, and on a real one.
#include <gmock/gmock.h>

#include <fstream>

#include "cli/scenario_tracks.h"
#include "support/data_folder.h"
#include "support/data_variable.h"
#include "support/temporary_folder.h"

namespace clearway::cli {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;

// Of 2020a: a car that drives along y, a pillar that stands; a lanelet with a neighbour on its
// left.
constexpr char kRoad[] = R"(<?xml version="1.0"?>
<commonRoad commonRoadVersion="2020a" timeStepSize="0.5">
  <lanelet id="9">
    <leftBound><point><x>0</x><y>2</y></point><point><x>9</x><y>2</y></point></leftBound>
    <rightBound><point><x>0</x><y>0</y></point><point><x>4</x><y>0.01</y></point>
      <point><x>120</x><y>0</y></point><point><x>120</x><y>30</y></point></rightBound>
    <adjacentLeft ref="8" drivingDir="same"/>
  </lanelet>
  <dynamicObstacle id="12"><type>car</type>
    <shape><rectangle><length>4</length><width>2</width></rectangle></shape>
    <initialState><position><point><x>1</x><y>2</y></point></position>
      <orientation><exact>1.5707963267948966</exact></orientation><time><exact>2</exact></time>
      <velocity><exact>6</exact></velocity></initialState>
    <trajectory><state><position><point><x>1</x><y>5</y></point></position>
      <orientation><exact>1.5707963267948966</exact></orientation><time><exact>3</exact></time>
      <velocity><exact>8</exact></velocity></state></trajectory>
  </dynamicObstacle>
  <staticObstacle id="13"><type>pillar</type>
    <shape><circle><radius>0.4</radius><center><x>0.5</x><y>0</y></center></circle></shape>
    <initialState><position><point><x>7</x><y>8</y></point></position>
      <orientation><exact>0</exact></orientation><time><exact>0</exact></time></initialState>
  </staticObstacle>
</commonRoad>)";

// A folder of recordings with one file of that text.
class CommonRoadTracks : public testing::Test {
 protected:
  absl::StatusOr<TrackObjects> ParseAll(const std::string& text, double from_s,
                                        const std::string& more = "") {
    std::ofstream(folder_.path() / "road.xml") << text;
    return ParseTracks(
        Json::parse(R"({"format": "commonroad", "file": "road.xml", "from_s": )" +
                    std::to_string(from_s) + R"(, "for_s": 2, "height_m": 1.6)" + more + "}"),
        "tracks", 100);
  }
  absl::StatusOr<std::vector<GivenObject>> Parse(const std::string& text,
                                                 const std::string& more = "") {
    auto all = ParseAll(text, 0.5, more);
    if (!all.ok()) return all.status();
    return std::move(all->objects);
  }
  std::string MessageOf(const std::string& text, const std::string& more = "") {
    return std::string(Parse(text, more).status().message());
  }

 private:
  const TemporaryFolder folder_;
  const DataVariable data_{folder_.path()};
};

// kRoad with one text in the place of another.
std::string Spoilt(const std::string& what, const std::string& by) {
  std::string text = kRoad;
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

TEST_F(CommonRoadTracks, Empty) {
  EXPECT_THAT(MessageOf(R"(<commonRoad commonRoadVersion="2018b" timeStepSize="0.1"/>)"),
              HasSubstr("file: road.xml holds nothing that could be in the way"));
}

// An element's name may be misspelt.
TEST_F(CommonRoadTracks, ARoadOnWhichNothingMovesIsNoted) {
  std::string text = kRoad;
  for (const std::string tag : {"<dynamicObstacle", "</dynamicObstacle"}) {
    text.replace(text.find(tag), tag.size(), tag.substr(0, tag.size() - 1));
  }
  const auto dut = ParseAll(text, 0.5);
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->objects.size(), 1u);
  EXPECT_THAT(dut->note, HasSubstr("nothing moves in road.xml"));
}

TEST_F(CommonRoadTracks, ACarGoesStraightBeforeAndAfterItIsSeen) {
  const auto objects = Parse(kRoad);
  ASSERT_TRUE(objects.ok()) << objects.status();
  ASSERT_EQ(objects->size(), 2u);
  const GivenObject& dut = (*objects)[0];
  EXPECT_EQ(dut.id, 100);
  EXPECT_EQ(std::get<Box>(dut.shape), (Box{{4, 2, 1.6}}));
  EXPECT_EQ(dut.pose.stamp, Time());
  EXPECT_TRUE(dut.pose.T_W_O.translation.isApprox(Eigen::Vector3d(1, -1, 0.8)));
  EXPECT_TRUE((dut.pose.T_W_O * Eigen::Vector3d(2, 0, 0)).isApprox(Eigen::Vector3d(1, 1, 0.8)));
  ASSERT_EQ(dut.future.size(), 3u);
  EXPECT_EQ(dut.future[0].stamp, Time() + milliseconds(500));
  EXPECT_TRUE(dut.future[0].T_W_O.translation.isApprox(Eigen::Vector3d(1, 2, 0.8)));
  EXPECT_EQ(dut.future[1].stamp, Time() + milliseconds(1000));
  EXPECT_EQ(dut.future[2].stamp, Time() + milliseconds(2000));
  EXPECT_TRUE(dut.future[2].T_W_O.translation.isApprox(Eigen::Vector3d(1, 13, 0.8)));
}

TEST_F(CommonRoadTracks, WithoutVelocitiesItGoesOnAsItWent) {
  std::string text = Spoilt("<velocity><exact>8</exact></velocity>", "");
  const auto objects = Parse(text);
  ASSERT_TRUE(objects.ok()) << objects.status();
  EXPECT_TRUE((*objects)[0].future[2].T_W_O.translation.isApprox(Eigen::Vector3d(1, 11, 0.8)));
}

TEST_F(CommonRoadTracks, APillarStands) {
  const auto objects = Parse(kRoad);
  ASSERT_TRUE(objects.ok());
  const GivenObject& dut = (*objects)[1];
  EXPECT_EQ(std::get<Cylinder>(dut.shape), (Cylinder{0.4, 1.6}));
  EXPECT_TRUE(dut.pose.T_W_O.translation.isApprox(Eigen::Vector3d(7.5, 8, 0.8)));
  EXPECT_TRUE(dut.future.empty());
}

TEST_F(CommonRoadTracks, ObstaclesOf2018bHaveRoles) {
  std::string text = Spoilt("2020a", "2018b");
  for (const auto& [name, role] :
       {std::pair{"dynamicObstacle", "dynamic"}, {"staticObstacle", "static"}}) {
    const std::string begin = std::string("<") + name, end = std::string("</") + name + ">";
    text.replace(text.find(end), end.size(), "</obstacle>");
    text.replace(text.find(begin), begin.size(), "<obstacle");
    const std::size_t at =
        text.find("<type>", text.find(role == std::string("static") ? "id=\"13\"" : "id=\"12\""));
    text.insert(at, std::string("<role>") + role + "</role>");
  }
  const auto dut = Parse(text);
  ASSERT_TRUE(dut.ok()) << dut.status();
  ASSERT_EQ(dut->size(), 2u);
  EXPECT_EQ((*dut)[0].future.size(), 3u);
  EXPECT_TRUE((*dut)[1].future.empty());
}

// 120 m of the bound are straight, in boxes of at most 50 m, then one stands across.
TEST_F(CommonRoadTracks, EdgesStandWhereALaneHasNoNeighbour) {
  const auto objects = Parse(kRoad, R"(, "road_edges": true)");
  ASSERT_TRUE(objects.ok()) << objects.status();
  double length_m = 0;
  for (std::size_t i = 2; i < objects->size(); ++i) {
    const GivenObject& dut = (*objects)[i];
    EXPECT_TRUE(dut.future.empty());
    const Eigen::Vector3d size_m = std::get<Box>(dut.shape).size_m;
    EXPECT_EQ(size_m.tail<2>(), Eigen::Vector2d(0.1, 1.6));
    EXPECT_LE(size_m.x(), 50.1 + 1e-9);
    length_m += size_m.x() - 0.1;
    const Eigen::Vector3d end = dut.pose.T_W_O * Eigen::Vector3d(size_m.x() / 2 - 0.05, 0, 0);
    EXPECT_TRUE(end.y() < 0.02 || std::abs(end.x() - 120) < 1e-9) << end.transpose();
  }
  EXPECT_NEAR(length_m, 150, 0.001);
}

TEST_F(CommonRoadTracks, WhatIsWrongIsNamed) {
  const auto expect = [&](const char* what, const char* by, const char* message) {
    EXPECT_THAT(MessageOf(Spoilt(what, by)), HasSubstr(message)) << what << " -> " << by;
  };
  expect("2020a", "2017a", "road.xml: line 2: commonRoad: commonRoadVersion: expected 2018b or");
  expect("\"0.5\"", "\"fast\"", "timeStepSize: expected a number, not \"fast\"");
  expect("\"0.5\"", "\"0\"", "timeStepSize: expected a number above 0");
  expect("<length>4</length>", "", "line 10: dynamicObstacle 12: shape/rectangle: length: missing");
  expect("<length>4", "<length>4m", "12: shape/rectangle/length: expected a number, not \"4m\"");
  expect("<length>4", "<length>-4", "12: shape/rectangle: expected lengths above 0");
  expect("<circle><radius>0.4</radius>", "<polygon/><circle>", "13: shape: expected one rect");
  expect("<exact>3<", "<exact>2<", "12: trajectory/state: time: not after the state before it");
  expect("<exact>3<", "<exact>2.5<", "12: trajectory/state: time: expected a whole number");
  expect("<time><exact>3</exact>", "<time><intervalStart>3</intervalStart>",
         "trajectory/state/time: expected an exact value, no interval");
  expect("<point><x>1</x><y>2</y></point>", "<circle/>", "initialState/position: expected a point");
  expect("<x>1</x>", "<x>nan</x>", "initialState/position/point/x: expected a number");
  expect("<x>1</x>", "<x>1e300</x>", "initialState/position/point: is beyond the limit of 1e+08 m");
  expect("<exact>3<", "<exact>1e300<", "tracks.file: its times are too long");
  expect("staticObstacle", "phantomObstacle", "mismatch");
  expect("</commonRoad>", "", "road.xml: line 22: Start-end tags mismatch");
  EXPECT_THAT(MessageOf("<osm/>"), HasSubstr("line 1: expected the element commonRoad, not osm"));
  EXPECT_THAT(MessageOf(""), HasSubstr("road.xml: line 1: "));
  EXPECT_THAT(MessageOf(kRoad, R"(, "radius_m": 1)"), HasSubstr("tracks.radius_m: unknown field"));
  EXPECT_THAT(MessageOf(kRoad, R"(, "road_edges": 1)"), HasSubstr("tracks.road_edges: expected"));
}

// By their kind and id in the recording.
TEST_F(CommonRoadTracks, ObjectsHaveNames) {
  const auto dut = ParseAll(kRoad, 0.5, R"(, "road_edges": true)");
  ASSERT_TRUE(dut.ok()) << dut.status();
  ASSERT_EQ(dut->names.size(), dut->objects.size());
  EXPECT_EQ(dut->names.at(101), "static obstacle 13 of road.xml");
  EXPECT_THAT(dut->names.at(100), HasSubstr("dynamic obstacle "));
  EXPECT_THAT(dut->names.rbegin()->second, HasSubstr("road edge ("));
  EXPECT_THAT(dut->names.rbegin()->second, HasSubstr(" of lanelet "));
}

TEST_F(CommonRoadTracks, AWindowAfterTheRecordingIsRefused) {
  const auto all = ParseAll(kRoad, 0);
  ASSERT_TRUE(all.ok()) << all.status();
  EXPECT_THAT(all->note, HasSubstr("everything goes straight on"));
  for (const double from_s : {3 * 0.5, 100.0}) {
    EXPECT_THAT(std::string(ParseAll(kRoad, from_s).status().message()),
                HasSubstr("the recording lasts from"));
  }
}

TEST_F(CommonRoadTracks, FilesCutOffOrDeepAreErrors) {
  const std::string text = kRoad;
  for (std::size_t size = 0; size < text.size(); ++size) {
    EXPECT_FALSE(Parse(text.substr(0, size)).ok()) << size;
  }
  std::string deep;
  for (int i = 0; i < 300'000; ++i) deep += "<a>";
  EXPECT_FALSE(Parse(deep).ok());
}

TEST(RealCommonRoadTracks, ReadsAHighway) {
  const auto folder = DataPath("commonroad");
  if (!folder) GTEST_SKIP() << "no recorded data";
  const DataVariable data(folder->parent_path());
  const auto dut = ParseTracks(
      Json::parse(R"({"format": "commonroad", "file": "commonroad/USA_US101-4_1_T-1.xml",
                      "for_s": 10, "height_m": 1.5, "road_edges": true})"),
      "tracks", 1);
  ASSERT_TRUE(dut.ok()) << dut.status();
  int cars = 0;
  for (const GivenObject& object : dut->objects) {
    if (object.future.empty()) continue;
    ++cars;
    // Highway traffic at 10 m/s and more or in a jam, never faster than 20 m/s.
    const StampedPose& last = object.future.back();
    const double seconds = ToSeconds(last.stamp - object.pose.stamp);
    EXPECT_GE(seconds, 10 - 1e-9);
    EXPECT_LT((last.T_W_O.translation - object.pose.T_W_O.translation).norm(), 20 * seconds);
  }
  EXPECT_EQ(cars, 22);
  EXPECT_GT(dut->objects.size(), 30u);
}

}  // namespace
}  // namespace clearway::cli
