// Recordings of scenarios in UTM coordinates, moved by "origin_m".
#include <gmock/gmock.h>

#include <fstream>
#include <utility>

#include "cli/scenario_tracks.h"
#include "clients/utm_folder.h"
#include "support/data_variable.h"
#include "support/temporary_folder.h"

namespace clearway::cli {
namespace {

using ::testing::HasSubstr;

// A car that goes along x from a place, and a road whose right bound goes through it.
std::string Road(const std::string& x0, const std::string& x1, const std::string& y) {
  const auto point = [&](const std::string& x) {
    return "<point><x>" + x + "</x><y>" + y + "</y></point>";
  };
  const auto state = [&](const std::string& x, const std::string& time) {
    return "<position>" + point(x) +
           "</position><orientation><exact>0</exact></orientation><time>" + "<exact>" + time +
           "</exact></time><velocity><exact>6</exact></velocity>";
  };
  return R"(<commonRoad commonRoadVersion="2020a" timeStepSize="0.5"><lanelet id="9"><leftBound>)" +
         point(x0) + point(x1) + "</leftBound><rightBound>" + point(x0) + point(x1) +
         R"(</rightBound><adjacentLeft ref="8"/></lanelet><dynamicObstacle id="12">)"
         "<shape><rectangle><length>4</length><width>2</width></rectangle></shape><initialState>" +
         state(x0, "0") + "</initialState><trajectory><state>" + state(x1, "1") +
         "</state></trajectory></dynamicObstacle></commonRoad>";
}

class TracksOrigin : public testing::Test {
 protected:
  absl::StatusOr<std::vector<GivenObject>> Parse(const std::string& fields) {
    auto tracks = ParseTracks(Json::parse("{\"for_s\": 1, " + fields + "}"), "tracks", 100);
    if (!tracks.ok()) return tracks.status();
    return std::move(tracks->objects);
  }
  absl::StatusOr<std::vector<GivenObject>> ParseRoad(const std::string& text,
                                                     const std::string& origin) {
    std::ofstream(folder_.path() / "road.xml") << text;
    return Parse(
        R"("format": "commonroad", "file": "road.xml", "height_m": 2, "road_edges": true)" +
        (origin.empty() ? "" : ", \"origin_m\": " + origin));
  }

  const TemporaryFolder folder_;
  const DataVariable data_{folder_.path()};
};

TEST_F(TracksOrigin, ARoadInUtmIsTheSameRoad) {
  const auto near = ParseRoad(Road("0.25", "3.25", "0.5"), "");
  ASSERT_TRUE(near.ok()) << near.status();
  const auto dut = ParseRoad(Road("500000.25", "500003.25", "4100000.5"), "[500000, 4100000, 0]");
  ASSERT_TRUE(dut.ok()) << dut.status();
  ASSERT_EQ(dut->size(), near->size());
  for (std::size_t i = 0; i < near->size(); ++i) {
    EXPECT_EQ((*dut)[i].pose.T_W_O.translation, (*near)[i].pose.T_W_O.translation);
    ASSERT_EQ((*dut)[i].future.size(), (*near)[i].future.size());
    for (std::size_t k = 0; k < (*near)[i].future.size(); ++k) {
      EXPECT_EQ((*dut)[i].future[k].T_W_O.translation, (*near)[i].future[k].T_W_O.translation);
    }
  }
}

TEST_F(TracksOrigin, FirstIsWhereTheFirstObstacleIsOnTheGround) {
  const auto dut = ParseRoad(Road("500000.25", "500003.25", "4100000.5"), "\"first\"");
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ((*dut)[0].pose.T_W_O.translation, Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ((*dut)[0].future[0].T_W_O.translation, Eigen::Vector3d(3, 0, 1));
}

TEST_F(TracksOrigin, WithoutOneTheErrorSaysSo) {
  const auto dut = ParseRoad(Road("500000.25", "500003.25", "4100000.5"), "");
  EXPECT_THAT(std::string(dut.status().message()),
              HasSubstr("tracks.file: has something at 500000.25,4100000.5,1, beyond the limit of "
                        "100000 m from the origin; \"origin_m\": \"first\" or [x, y, z] moves it"));
}

TEST_F(TracksOrigin, WhatIsNoOriginIsRefused) {
  for (const char* origin : {"\"last\"", "[1, 2]", "[1, 2, 1e9]", "7", "null"}) {
    const auto dut = ParseRoad(Road("0", "3", "0"), origin);
    EXPECT_THAT(std::string(dut.status().message()), HasSubstr("tracks.origin_m")) << origin;
  }
}

TEST_F(TracksOrigin, PeopleInUtm) {
  std::ofstream(folder_.path() / "people.txt") << "0 1 500000.25 0 4100000.5 1 0 0\n"
                                                  "25 1 500001.25 0 4100000.5 1 0 0\n";
  const std::string fields =
      R"("format": "ucy", "file": "people.txt", "radius_m": 0.3, "height_m": 1.8)";
  EXPECT_THAT(std::string(Parse(fields).status().message()), HasSubstr("beyond the limit"));
  const auto dut = Parse(fields + ", \"origin_m\": \"first\"");
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ((*dut)[0].pose.T_W_O.translation, Eigen::Vector3d(0, 0, 0.9));
}

TEST_F(TracksOrigin, BoxesAreMovedWithTheirSensor) {
  const TemporaryFolder drive;
  WriteUtmFolder(drive);
  const DataVariable data(drive.path().parent_path());
  const std::string fields =
      "\"format\": \"boxes\", \"file\": \"" + drive.path().filename().string() + "\"";
  const std::string far(Parse(fields).status().message());
  EXPECT_THAT(far, HasSubstr("tracks.file: "));
  EXPECT_THAT(far, HasSubstr("\"origin_m\": \"first\" moves the origin"));
  const std::string beside(Parse(fields + ", \"origin_m\": [1, 2, 3]").status().message());
  EXPECT_THAT(beside, HasSubstr("\"origin_m\": [x, y, z], near the poses, moves the origin"));
  const auto dut = Parse(fields + ", \"origin_m\": \"first\"");
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ((*dut)[0].pose.T_W_O.translation, Eigen::Vector3d(9, 3, -0.5));
}

}  // namespace
}  // namespace clearway::cli
