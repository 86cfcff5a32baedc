// Scenarios of LiDAR folders' boxes: of a small folder, and of a real drive.
#include <gmock/gmock.h>

#include "cli/scenario_tracks.h"
#include "io/lidar_example.h"
#include "support/data_folder.h"
#include "support/data_variable.h"

namespace clearway::cli {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;

absl::StatusOr<std::vector<GivenObject>> Parse(const std::string& fields) {
  auto all = ParseTracks(Json::parse(R"({"format": "boxes", )" + fields + "}"), "tracks", 100);
  if (!all.ok()) return all.status();
  return std::move(all->objects);
}

// Frames 4, 5 and 6 of a van, which turns a quarter in the last; a cyclist in the last alone.
TEST(BoxTracks, TheBoxesOfAFolderAreObjects) {
  const TemporaryFolder folder;
  WriteExample(folder);
  const DataVariable data(folder.path().parent_path());
  const std::string file = "\"file\": \"" + folder.path().filename().string() + "\"";
  const auto objects = Parse(file + R"(, "poses": "icp", "for_s": 1)");
  const std::string wrong(Parse(file + R"(, "poses": "gps", "for_s": 1)").status().message());
  const std::string missing(Parse(file + R"(, "poses": "oxts", "for_s": 1)").status().message());
  const std::string alien(Parse(file + R"(, "for_s": 1, "height_m": 2)").status().message());
  ASSERT_TRUE(objects.ok()) << objects.status();
  ASSERT_EQ(objects->size(), 2u);
  const GivenObject& dut = (*objects)[0];
  EXPECT_EQ(dut.id, 100);
  EXPECT_EQ(std::get<Box>(dut.shape), (Box{{4, 2, 2}}));
  EXPECT_EQ(dut.pose.T_W_O.translation, Eigen::Vector3d(9, 3, 1));
  ASSERT_EQ(dut.future.size(), 3u);
  EXPECT_EQ(dut.future[0].stamp, Time() + milliseconds(100));
  EXPECT_EQ(dut.future[0].T_W_O.translation, Eigen::Vector3d(10, 3, 1));
  EXPECT_TRUE((dut.future[1].T_W_O * Eigen::Vector3d(2, 0, 0)).isApprox(Eigen::Vector3d(10, 5, 1)));
  // On with 1 m in 0.2 s.
  EXPECT_EQ(dut.future[2].stamp, Time() + milliseconds(1000));
  EXPECT_TRUE(dut.future[2].T_W_O.translation.isApprox(Eigen::Vector3d(14, 3, 1)));
  EXPECT_THAT(wrong, HasSubstr("tracks.poses: expected icp, oxts or plain"));
  EXPECT_THAT(missing, HasSubstr("poses_oxts.csv"));
  EXPECT_THAT(alien, HasSubstr("tracks.height_m: unknown field"));
}

// The example's three frames are 0.1 s apart.
TEST(BoxTracks, AWindowAfterTheRecordingIsRefused) {
  const TemporaryFolder folder;
  WriteExample(folder);
  const DataVariable data(folder.path().parent_path());
  const std::string file = "\"file\": \"" + folder.path().filename().string() + "\"";
  EXPECT_TRUE(Parse(file + R"(, "poses": "icp", "from_s": 0.1, "for_s": 1)").ok());
  const auto dut = Parse(file + R"(, "poses": "icp", "from_s": 0.2, "for_s": 1)");
  EXPECT_EQ(dut.status().message(), "tracks.from_s: is 0.2; the recording lasts from 0 to 0.2 s");
}

TEST(BoxTracks, TheLargestOfSizesThatDiffer) {
  const TemporaryFolder folder;
  WriteExample(folder);
  std::string text = kObjects;
  folder.Write("objects_icp.csv", text.replace(text.find("0,4,2,2"), 7, "0,3,2,5"));
  const DataVariable data(folder.path().parent_path());
  const auto dut = Parse("\"for_s\": 1, \"file\": \"" + folder.path().filename().string() + "\"");
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(std::get<Box>((*dut)[0].shape), (Box{{4, 2, 5}}));
}

TEST(BoxTracks, ObjectsWithoutSizesAreNoBoxes) {
  const TemporaryFolder folder;
  folder.Write("depth.txt", "1 a.png\n");
  folder.Write("camera.txt", "1 1 0 0\n");
  folder.Write("groundtruth.txt", "1 0 0 0 0 0 0 1\n");
  folder.Write("object_poses.txt", "1 5 0 0 2 0 0 0 1\n");
  const DataVariable data(folder.path().parent_path());
  const auto dut = Parse("\"for_s\": 1, \"file\": \"" + folder.path().filename().string() + "\"");
  EXPECT_THAT(std::string(dut.status().message()), HasSubstr("come without sizes"));
}

TEST(BoxTracks, ReadsARealDrive) {
  const auto folder = DataPath("kitti0000_fov");
  if (!folder) GTEST_SKIP() << "no recorded data";
  const DataVariable data(folder->parent_path());
  const auto dut = Parse(R"("file": "kitti0000_fov", "poses": "icp", "from_s": 1, "for_s": 20)");
  ASSERT_TRUE(dut.ok()) << dut.status();
  ASSERT_EQ(dut->size(), 3u);  // the pedestrian is seen in the first half second alone
  const GivenObject &van = (*dut)[0], &parked = (*dut)[2];
  EXPECT_EQ(van.future.size(), 90u);
  EXPECT_GT((van.future.back().T_W_O.translation - van.pose.T_W_O.translation).norm(), 90);
  EXPECT_LT((parked.future.back().T_W_O.translation - parked.pose.T_W_O.translation).norm(), 5);
}

// A bad row of either table costs itself alone.
TEST(BoxTracks, WhatTheTablesLeaveOutIsTold) {
  const TemporaryFolder folder;
  WriteExample(folder);
  std::string boxes = kObjects, poses = kPoses;
  folder.Write("objects_icp.csv", boxes.replace(boxes.find("1,1,0,0,9"), 9, "1,1,0,0,nan"));
  folder.Write("poses_icp.csv", poses.replace(poses.find("6,1,0,0,2"), 9, "6,1,0,0,2e5"));
  const DataVariable data(folder.path().parent_path());
  const std::string file = "\"file\": \"" + folder.path().filename().string() + "\"";
  const auto dut =
      ParseTracks(Json::parse(R"({"format": "boxes", "for_s": 1, )" + file + "}"), "tracks", 100);
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->left_out.rows, 1u);
  EXPECT_EQ(dut->left_out.frames, 1u);
  EXPECT_THAT(dut->left_out.reasons[0], HasSubstr("objects_icp.csv, line 3, column T03: 'nan'"));
  ASSERT_EQ(dut->objects.size(), 1u);  // the cyclist was in that frame alone
}

}  // namespace
}  // namespace clearway::cli
