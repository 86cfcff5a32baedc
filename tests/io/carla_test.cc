#include "clearway/io/carla.h"

#include <gmock/gmock.h>

#include "absl/strings/str_replace.h"
#include "io/carla_example.h"

namespace clearway {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST_F(Carla, IsToldByItsTable) {
  EXPECT_TRUE(IsCarla(folder_.path()));
  EXPECT_FALSE(IsCarla(folder_ / "000120.ply"));
  EXPECT_FALSE(IsCarla("/nowhere"));
}

TEST_F(Carla, PointsAreMirroredAndLabelled) {
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  ASSERT_EQ(dut->frames.frame_count, 2u);
  EXPECT_THAT(dut->frames.description, HasSubstr("CARLA scans " + folder_.path().string()));
  const auto frame = dut->frames.read(0);
  ASSERT_TRUE(frame.ok()) << frame.status();
  EXPECT_EQ(frame->sequence, 120u);
  EXPECT_EQ(ToNanoseconds(frame->stamp), 12'000'000'001);
  ASSERT_EQ(frame->points_S.size(), 3u);
  EXPECT_EQ(frame->points_S[0], Eigen::Vector3f(9, -3, -1.5F));
  EXPECT_EQ(frame->points_S[1], Eigen::Vector3f(8, 2, 1));
  EXPECT_THAT(frame->labels, ElementsAre(31, 0, 0));
  EXPECT_TRUE(frame->motions.empty());
  EXPECT_TRUE(Validate(*frame, {}).ok());
}

TEST_F(Carla, ActorsMove) {
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  const auto frame = dut->frames.read(1);
  ASSERT_TRUE(frame.ok()) << frame.status();
  EXPECT_EQ(ToNanoseconds(frame->stamp), 12'100'000'001);
  ASSERT_EQ(frame->motions.size(), 1u);
  EXPECT_EQ(frame->motions[0].id, 31);
  EXPECT_EQ(ToNanoseconds(frame->motions[0].from), 12'000'000'001);
  EXPECT_TRUE(frame->motions[0].H_W.translation.isApprox(Eigen::Vector3d(1, 0, 0)));
  ASSERT_EQ(dut->boxes.size(), 2u);
  EXPECT_EQ(dut->boxes[0].type, "vehicle.audi.tt");
  EXPECT_TRUE(dut->boxes[0].size_m.isZero());
  EXPECT_LT(dut->boxes[0].n_points, 0);
  EXPECT_EQ(Open({.objects = LidarObjects::kPoses})->frames.read(1)->poses.size(), 1u);
}

TEST_F(Carla, WhatHasARowInSomeFrameIsAnObjectInAll) {
  folder_.Write("carla_actors.csv",
                absl::StrCat(kCarlaActors, "121,31,vehicle.audi.tt,11,3,0,0,0,0\n"));
  const auto frame = Open()->frames.read(0);
  ASSERT_TRUE(frame.ok()) << frame.status();
  EXPECT_THAT(frame->labels, ElementsAre(31, 0, 0));
}

TEST_F(Carla, TheSensorsOwnCarIsLeftOut) {
  folder_.Write("carla_actors.csv", absl::StrCat(kCarlaActors, "120,31,ego,10,3,0,0,0,0\n",
                                                 "120,17,traffic.traffic_light,8,-2,3,0,0,0\n"));
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_THAT(dut->frames.read(0)->labels, ElementsAre(-1, 17, 0));
  EXPECT_EQ(dut->boxes.size(), 1u);
}

TEST_F(Carla, WithoutActorsAllIsStatic) {
  std::filesystem::remove(folder_ / "carla_actors.csv");
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_THAT(dut->frames.read(0)->labels, ElementsAre(0, 0, 0));
  EXPECT_THAT(dut->frames.description, HasSubstr("no carla_actors.csv: all points are static"));
}

TEST_F(Carla, LostReturnsMayBeNan) {
  std::string ply = BytesOf(folder_ / "000120.ply");
  folder_.Write("000120.ply", absl::StrReplaceAll(ply, {{"9.0000 3.0000 -1.5000", "nan nan nan"}}));
  const auto frame = Open()->frames.read(0);
  ASSERT_TRUE(frame.ok()) << frame.status();
  EXPECT_EQ(frame->points_S.size(), 3u);
  EXPECT_FALSE(frame->points_S[0].allFinite());
}

TEST_F(Carla, IdsThatAreNoLabelsAreStatic) {
  folder_.Write("000120.ply", CarlaPly({{{1, 0, 0}, 4'294'967'295U, 20},
                                        {{1, 0, 0}, 2'147'483'648U, 20},
                                        {{1, 0, 0}, 2'147'483'647U, 14}}));
  folder_.Write("carla_actors.csv",
                absl::StrCat(kCarlaActors, "120,2147483647,walker,0,0,0,0,0,0\n"));
  EXPECT_THAT(Open()->frames.read(0)->labels, ElementsAre(0, 0, 2'147'483'647));
}

TEST_F(Carla, FilesMayBeWrittenElsewhere) {
  // By Windows, with other columns; names with other numbers of digits.
  const std::string ply = BytesOf(folder_ / "000120.ply");
  std::filesystem::remove(folder_ / "000120.ply");
  folder_.Write("120.ply", absl::StrReplaceAll(
                               ply, {{"\n", "\r\n"}, {"float32", "float"}, {"uint32", "uint"}}));
  folder_.Write("map.ply", "not a scan");
  folder_.Write("000999.ply", ply);
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_THAT(dut->frames.read(0)->labels, ElementsAre(31, 0, 0));
  EXPECT_THAT(dut->frames.description,
              HasSubstr("1 scans without a row in carla_sensor.csv are left out"));
}

TEST_F(Carla, ScansMayBeEmptyOrMissing) {
  folder_.Write("000120.ply", CarlaPly({}));
  EXPECT_TRUE(Open()->frames.read(0)->points_S.empty());
  std::filesystem::remove(folder_ / "000121.ply");
  EXPECT_TRUE(absl::IsNotFound(Open().status()));
  EXPECT_THAT(std::string(Open().status().message()), HasSubstr("000121.ply: no such file"));
  const auto dut = Open({.allow_missing_points = true});
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_TRUE(dut->frames.read(1)->points_S.empty());
  EXPECT_EQ(dut->frames.read(1)->motions.size(), 1u);
}

TEST_F(Carla, RowsOfFramesWithoutAScanAreLeftOut) {
  folder_.Write("carla_actors.csv",
                absl::StrCat(kCarlaActors, "119,31,car,9,3,0,0,0,0\n120,31,car,10,3,0,0,0,0\n"));
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->boxes.size(), 1u);
  EXPECT_THAT(dut->frames.description, HasSubstr("1 rows of actors at frames without"));
}

TEST_F(Carla, BoxesAreInTheMiddle) {
  // A truck that has turned right, so that its nose points along CARLA's y; its box is 2 m before
  // and 1 m to the right of its origin.
  folder_.Write("carla_actors.csv",
                absl::StrCat(kCarlaBoxes, "120,31,truck,10,3,0.5,0,0,90,2,1,1.5,4,1.25,1.75\n",
                             "121,31,truck,10,3,0.5,0,0,90,2,1,1.5,0,1.25,1.75\n"));
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->boxes[0].size_m, Eigen::Vector3d(8, 2.5, 3.5));
  EXPECT_TRUE(dut->boxes[0].T_W_B.translation.isApprox(Eigen::Vector3d(9, -5, 2), 1e-12));
  EXPECT_TRUE(dut->boxes[1].size_m.isZero());  // CARLA does not know
}

}  // namespace
}  // namespace clearway
