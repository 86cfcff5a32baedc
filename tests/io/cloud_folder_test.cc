// Folders of PCD and PLY files with a table of poses.
#include "clearway/io/cloud_folder.h"

#include <gmock/gmock.h>

#include <vector>

#include "absl/strings/str_cat.h"
#include "io/cloud_names.h"
#include "io/pcd_example.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr char kTum[] =
    "# timestamp tx ty tz qx qy qz qw\n"
    "1700000000.10 1 0 0 0 0 0 1\n1700000000.20 2 0 0 0 0 0 1\n1700000000.30 3 0 0 0 0 0 1\n";
constexpr char kKitti[] =
    "1 0 0 1 0 1 0 0 0 0 1 0\n1 0 0 2 0 1 0 0 0 0 1 0\n1 0 0 3 0 1 0 0 0 0 1 0\n";

class CloudFolder : public testing::Test {
 protected:
  // A cloud whose one point's x is its place in the list.
  void WriteClouds(const std::vector<std::string>& names) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const PcdPoint point = {static_cast<float>(i), 2, 3, 0, 7};
      folder_.Write(names[i], BinaryPcd({point}));
    }
  }
  absl::StatusOr<LidarFolder> Open(const CloudFolderOptions& options = {}) {
    return OpenCloudFolder(folder_.path(), options);
  }
  std::string ErrorOf(const CloudFolderOptions& options = {}) {
    const auto opened = Open(options);
    EXPECT_FALSE(opened.ok());
    return std::string(opened.status().message());
  }
  // x of the sensor and of the point, frame by frame.
  std::vector<std::pair<double, float>> Places(const CloudFolderOptions& options = {}) {
    const auto opened = Open(options);
    EXPECT_TRUE(opened.ok()) << opened.status();
    std::vector<std::pair<double, float>> places;
    for (std::size_t k = 0; opened.ok() && k < opened->frames.frame_count; ++k) {
      const auto frame = opened->frames.read(k);
      EXPECT_TRUE(frame.ok()) << frame.status();
      places.emplace_back(frame->T_W_S.translation.x(), frame->points_S[0].x());
    }
    return places;
  }

  TemporaryFolder folder_;
};

using Place = std::pair<double, float>;

TEST_F(CloudFolder, Empty) {
  EXPECT_FALSE(IsCloudFolder(folder_.path()));
  folder_.Write("poses.txt", kTum);
  EXPECT_FALSE(IsCloudFolder(folder_.path()));
  EXPECT_THAT(ErrorOf(), HasSubstr("0 folders of point clouds"));
}

TEST_F(CloudFolder, NumbersAreRowsOfTheTable) {
  folder_.Write("poses.txt", kTum);
  WriteClouds({"000000.pcd", "000001.pcd", "000002.pcd"});
  EXPECT_TRUE(IsCloudFolder(folder_.path()));
  EXPECT_THAT(Places(), ElementsAre(Place(1, 0), Place(2, 1), Place(3, 2)));
  const auto dut = Open();
  EXPECT_EQ(dut->frames.read(1)->stamp, TimeFromNanoseconds(1'700'000'000'200'000'000));
  EXPECT_EQ(dut->frames.read(1)->sequence, 1u);
  EXPECT_THAT(dut->frames.description,
              AllOf(HasSubstr("poses of poses.txt of the rows that number the clouds"),
                    HasSubstr("no --label-field: all points are static (fields: intensity x y")));
  EXPECT_THAT(dut->frames.read(1)->labels, ElementsAre(0));
}

TEST_F(CloudFolder, HiddenFilesAreNoClouds) {
  folder_.Write("poses.txt", kTum);
  folder_.Write("._000000.pcd", "of another system");
  EXPECT_FALSE(IsCloudFolder(folder_.path()));
  WriteClouds({"000000.pcd", "000001.pcd", "000002.pcd"});
  EXPECT_THAT(Places(), ElementsAre(Place(1, 0), Place(2, 1), Place(3, 2)));
}

TEST_F(CloudFolder, ANumberWithoutARowIsLeftOut) {
  folder_.Write("poses.txt", kTum);
  WriteClouds({"scan_0.pcd", "scan_2.pcd", "scan_3.pcd"});
  EXPECT_THAT(Places(), ElementsAre(Place(1, 0), Place(3, 1)));
  EXPECT_THAT(Open()->frames.description, HasSubstr("1 clouds without a pose are left out"));
}

TEST_F(CloudFolder, OtherNumbersAreTakenInTheirOrder) {
  folder_.Write("poses.txt", kTum);
  WriteClouds({"8.pcd", "9.pcd", "10.pcd"});
  EXPECT_THAT(Places(), ElementsAre(Place(1, 0), Place(2, 1), Place(3, 2)));
  EXPECT_THAT(Open()->frames.description, HasSubstr("poses of poses.txt in the clouds' order"));
  folder_.Write("11.pcd", BinaryPcd({}));
  EXPECT_THAT(ErrorOf(), HasSubstr("4 clouds, but 3 poses, and the clouds' names do not tell"));
}

TEST_F(CloudFolder, OtherNamesAreTakenInTheirNaturalOrder) {
  folder_.Write("poses.txt", kTum);
  WriteClouds({"a9_front.pcd", "a10_front.pcd", "b1_front.pcd"});
  EXPECT_THAT(Places(), ElementsAre(Place(1, 0), Place(2, 1), Place(3, 2)));
  EXPECT_THAT(Open()->frames.description, HasSubstr("in the clouds' order"));
}

TEST_F(CloudFolder, NamesThatAreStampsGetThePoseAtTheirTime) {
  folder_.Write("poses.txt", kTum);
  for (const std::vector<std::string>& names : std::vector<std::vector<std::string>>{
           {"1700000000.1.pcd", "1700000000.29.pcd"},
           {"1700000000100000000.pcd", "1700000000290000000.pcd"},
           {"1700000000100000.pcd", "1700000000290000.pcd"},
           {"lidar_1700000000100.pcd", "lidar_1700000000290.pcd"}}) {
    WriteClouds(names);
    const auto dut = Open();
    ASSERT_TRUE(dut.ok()) << dut.status();
    ASSERT_EQ(dut->frames.frame_count, 2u) << names[0];
    EXPECT_EQ(dut->frames.read(1)->stamp, TimeFromNanoseconds(1'700'000'000'290'000'000));
    EXPECT_NEAR(dut->frames.read(1)->T_W_S.translation.x(), 2.9, 1e-9);
    EXPECT_EQ(dut->frames.read(1)->points_S[0].x(), 1);
    for (const std::string& name : names) std::filesystem::remove(folder_ / name);
  }
}

// As KITTI's raw recordings have them, here without the second scan.
TEST_F(CloudFolder, TenDigitsThatCountAreNumbers) {
  folder_.Write("poses.txt", kTum);
  WriteClouds({"0000000000.pcd", "0000000002.pcd"});
  EXPECT_THAT(Places(), ElementsAre(Place(1, 0), Place(3, 1)));
  EXPECT_THAT(Open()->frames.description, HasSubstr("of the rows that number the clouds"));
}

TEST_F(CloudFolder, StampsFarFromEveryPoseAreLeftOut) {
  folder_.Write("poses.txt", kTum);
  WriteClouds({"1700000000.25.pcd", "1700000000.30.pcd", "1700000009.00.pcd"});
  // 0.25 s is 0.05 s from both neighbours, beyond the reach of 0.02 s.
  EXPECT_THAT(Places(), ElementsAre(Place(3, 1)));
  EXPECT_THAT(Open()->frames.description, HasSubstr("2 clouds without a pose are left out"));
  std::filesystem::remove(folder_ / "1700000000.30.pcd");
  EXPECT_THAT(ErrorOf(), AllOf(HasSubstr("none of 2 clouds has a pose"),
                               HasSubstr("their names were read as stamps from 1700000000.25 to "
                                         "1700000009.00 s, the table's stamps are from "
                                         "1700000000.10 to 1700000000.30 s")));
}

TEST_F(CloudFolder, MatricesHaveTheTimesBesideThem) {
  folder_.Write("poses.txt", kKitti);
  WriteClouds({"0.pcd", "1.pcd", "2.pcd"});
  EXPECT_THAT(Places(), ElementsAre(Place(1, 0), Place(2, 1), Place(3, 2)));
  EXPECT_EQ(Open()->frames.read(2)->stamp, TimeFromNanoseconds(200'000'000));
  folder_.Write("times.txt", "0.5\n6.0e-01\n0.75\n");
  EXPECT_EQ(Open()->frames.read(1)->stamp, TimeFromNanoseconds(600'000'000));
  folder_.Write("times.txt", "0.5\n0.6\n");
  EXPECT_THAT(ErrorOf(), HasSubstr("times.txt: 2 times for the 3 poses of"));
}

TEST_F(CloudFolder, ABadRowKeepsTheNumbersOfTheOthers) {
  const std::string nan = "nan nan nan nan nan nan nan nan";
  WriteClouds({"0.pcd", "1.pcd", "2.pcd"});
  folder_.Write("poses.txt", "1 1 0 0 0 0 0 1\n" + nan + "\n3 3 0 0 0 0 0 1\n");
  EXPECT_THAT(Places(), ElementsAre(Place(1, 0), Place(3, 2)));
  EXPECT_EQ(Open()->frames.left_out->rows, 1u);
  EXPECT_EQ(Open()->frames.left_out->frames, 1u);
  EXPECT_THAT(Open()->frames.description, HasSubstr("1 clouds without a pose are left out"));
  folder_.Write("poses.txt",
                "1 0 0 1 0 1 0 0 0 0 1 0\n" + nan + " nan nan nan nan\n1 0 0 3 0 1 0 0 0 0 1 0\n");
  EXPECT_THAT(Places(), ElementsAre(Place(1, 0), Place(3, 2)));
  EXPECT_THAT(Open()->frames.left_out->reasons,
              ElementsAre(HasSubstr("poses.txt, line 2, word 1: 'nan' is not a finite number"),
                          HasSubstr("1.pcd: no usable pose in poses.txt")));
}

TEST_F(CloudFolder, RowsOfBadTimesAreLeftOut) {
  folder_.Write("poses.txt", kKitti);
  WriteClouds({"0.pcd", "1.pcd", "2.pcd"});
  folder_.Write("times.txt", "0.5\nnan\n0.7\n");
  EXPECT_THAT(Places(), ElementsAre(Place(1, 0), Place(3, 2)));
  folder_.Write("times.txt", "0.5\n0.6\n0.6\n");
  EXPECT_EQ(Places().size(), 2u);
  EXPECT_THAT(
      Open()->frames.left_out->reasons,
      ElementsAre(
          HasSubstr(
              "times.txt, line 2: frame 1 at 600000000 ns: stamps must ascend with the frames"),
          HasSubstr("1.pcd: no usable pose in poses.txt")));
}

TEST_F(CloudFolder, TablesMayHaveAByteOrderMarkAndCommas) {
  WriteClouds({"0.pcd", "1.pcd"});
  folder_.Write("poses.txt",
                "\xEF\xBB\xBF"
                "1,1,0,0,0,0,0,1\n2,2,0,0,0,0,0,1\n");
  EXPECT_THAT(Places(), ElementsAre(Place(1, 0), Place(2, 1)));
}

TEST_F(CloudFolder, StampsNeedATableWithStampsUnlessThereAreAsManyPoses) {
  folder_.Write("poses.txt", kKitti);
  WriteClouds({"1700000000.1.pcd", "1700000000.2.pcd"});
  EXPECT_THAT(ErrorOf(), HasSubstr("2 clouds are named by their stamps, but the 3 poses of"));
  folder_.Write("1700000000.3.pcd", BinaryPcd({{2, 0, 0, 0, 0}}));
  EXPECT_THAT(Places(), ElementsAre(Place(1, 0), Place(2, 1), Place(3, 2)));
}

// Every tenth cloud of a KITTI drive.
TEST_F(CloudFolder, OfATableWithoutStampsTheyAreRows) {
  std::string rows;
  for (int x = 0; x <= 10; ++x) absl::StrAppend(&rows, "1 0 0 ", x, " 0 1 0 0 0 0 1 0\n");
  folder_.Write("poses.txt", rows);
  WriteClouds({"0000000000.pcd", "0000000010.pcd"});
  EXPECT_THAT(Places(), ElementsAre(Place(0, 0), Place(10, 1)));
  EXPECT_THAT(Open()->frames.description, HasSubstr("of the rows that number the clouds"));
}

TEST_F(CloudFolder, LabelsComeFromTheFieldThatIsNamed) {
  folder_.Write("poses.txt", kTum);
  WriteClouds({"0.pcd", "1.pcd", "2.pcd"});
  EXPECT_THAT(Open({.label_field = "label"})->frames.read(0)->labels, ElementsAre(7));
  EXPECT_THAT(ErrorOf({.label_field = "instance"}),
              HasSubstr("0.pcd: no field instance; it has intensity x y normal z label"));
  folder_.Write("0.pcd", "");  // that it is damaged matters less
  EXPECT_THAT(ErrorOf({.label_field = "instance"}), HasSubstr("1.pcd: no field instance"));
}

TEST_F(CloudFolder, PlyFilesToo) {
  folder_.Write("poses.txt", kTum);
  for (const char* name : {"0.ply", "1.ply", "2.PLY"}) {
    folder_.Write(name,
                  "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
                  "property float z\nproperty int id\nend_header\n1 2 3 5\nnan 0 0 -1\n");
  }
  const auto dut = Open({.label_field = "id"});
  ASSERT_TRUE(dut.ok()) << dut.status();
  const auto frame = dut->frames.read(2);
  ASSERT_TRUE(frame.ok()) << frame.status();
  EXPECT_EQ(frame->points_S[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_FALSE(frame->points_S[1].allFinite());
  EXPECT_THAT(frame->labels, ElementsAre(5, kIgnoreLabel));
  EXPECT_THAT(ErrorOf({.label_field = "label"}),
              HasSubstr("without a property label; it has x y z id"));
}

TEST_F(CloudFolder, CloudsMayLieInAFolderOfTheirOwn) {
  folder_.Write("groundtruth.txt", kTum);
  WriteClouds({"clouds/0.pcd", "clouds/1.pcd", "clouds/2.pcd"});
  EXPECT_TRUE(IsCloudFolder(folder_.path()));
  EXPECT_EQ(Places().size(), 3u);
  EXPECT_EQ(OpenCloudFolder(folder_ / "clouds")->frames.frame_count, 3u);
  WriteClouds({"more/0.pcd"});
  EXPECT_THAT(ErrorOf(), HasSubstr("2 folders of point clouds; name one of them"));
}

TEST_F(CloudFolder, TheTableMayBeNamed) {
  WriteClouds({"0.pcd", "1.pcd", "2.pcd"});
  EXPECT_THAT(ErrorOf(), AllOf(HasSubstr("no table of the sensor's poses (poses.txt, "),
                               HasSubstr("--pose-table names one")));
  const auto table = folder_.Write("results/slam.txt", kTum);
  EXPECT_EQ(Places({.pose_table = table}).size(), 3u);
  folder_.Write("poses.txt", kTum);
  folder_.Write("trajectory.txt", kKitti);
  EXPECT_THAT(ErrorOf(), HasSubstr("several tables of poses"));
  EXPECT_THAT(ErrorOf({.pose_table = folder_ / "none.txt"}), HasSubstr("none.txt: no such file"));
}

TEST_F(CloudFolder, RefusesTablesThatAreNone) {
  WriteClouds({"0.pcd"});
  folder_.Write("poses.txt", "");
  EXPECT_THAT(ErrorOf(), HasSubstr("poses.txt: holds no pose"));
  folder_.Write("poses.txt", "1 2 3\n");
  EXPECT_THAT(ErrorOf(), HasSubstr("poses.txt, line 1: 3 words, expected 8 (timestamp"));
  folder_.Write("poses.txt", "2 0 0 0 0 1 0 0 0 0 1 0\n");
  EXPECT_THAT(ErrorOf(), HasSubstr("poses.txt, line 1"));
  folder_.Write("poses.txt", "nan nan nan nan nan nan nan nan\n");
  EXPECT_THAT(ErrorOf(), HasSubstr("poses.txt, line 1, word 1: 'nan'"));
  EXPECT_THAT(ErrorOf(), HasSubstr("no row of the table can be used"));
}

TEST_F(CloudFolder, RefusesCloudsOfTheWorld) {
  folder_.Write("poses.txt", kTum);
  WriteClouds({"0.pcd"});
  folder_.Write("0.pcd", BinaryPcd({{5e5f, 4.1e6f, 3, 0, 0}, {5e5f, 4.1e6f, 4, 0, 0}}));
  EXPECT_THAT(std::string(Open()->frames.read(0).status().message()),
              HasSubstr("expected in the sensor's frame, not in the world's"));
}

TEST_F(CloudFolder, RefusesTwoCloudsOfOneNumber) {
  folder_.Write("poses.txt", kTum);
  WriteClouds({"1.pcd", "01.pcd"});
  EXPECT_THAT(ErrorOf(), HasSubstr("two clouds of one number"));
}

TEST(CloudNames, NaturalOrder) {
  EXPECT_TRUE(NaturallyBefore("a9", "a10"));
  EXPECT_FALSE(NaturallyBefore("a10", "a9"));
  EXPECT_TRUE(NaturallyBefore("a2b9", "a2b10"));
  EXPECT_TRUE(NaturallyBefore("a", "a1"));
  EXPECT_TRUE(NaturallyBefore("a01", "a1"));
  EXPECT_FALSE(NaturallyBefore("a1", "a01"));
  EXPECT_FALSE(NaturallyBefore("a1", "a1"));
  EXPECT_TRUE(NaturallyBefore("a", "b"));
}

TEST(CloudNames, WhatIsAStamp) {
  const auto naming = [](const char* a, const char* b) { return NameClouds({a, b})->naming; };
  EXPECT_EQ(naming("0.1.pcd", "0.25.pcd"), CloudNaming::kStamps);
  EXPECT_EQ(naming("1700000000.pcd", "1700000001.pcd"), CloudNaming::kStamps);
  EXPECT_EQ(naming("0001.pcd", "2.pcd"), CloudNaming::kNumbers);
  EXPECT_EQ(naming("17000000001.pcd", "17000000002.pcd"), CloudNaming::kNumbers);  // 11 digits
  EXPECT_EQ(naming("0000000005.pcd", "0000000007.pcd"), CloudNaming::kNumbers);
  EXPECT_EQ(naming("0000000005.pcd", "0000000008.pcd"), CloudNaming::kStamps);
  EXPECT_EQ(naming("0000000000000000001.pcd", "0000000000000000002.pcd"), CloudNaming::kNumbers);
  EXPECT_EQ(naming("0000000000100000000.pcd", "0000000000200000000.pcd"), CloudNaming::kStamps);
  EXPECT_EQ(naming("a1.pcd", "b2.pcd"), CloudNaming::kOther);
  EXPECT_EQ(naming("1.pcd", "last.pcd"), CloudNaming::kOther);
  const auto dut = NameClouds({"x_0.3.pcd", "x_0.1234567891.pcd"});
  EXPECT_EQ(dut->clouds[0].stamp, TimeFromNanoseconds(123'456'789));
  EXPECT_EQ(dut->clouds[1].stamp, TimeFromNanoseconds(300'000'000));
}

}  // namespace
}  // namespace clearway
