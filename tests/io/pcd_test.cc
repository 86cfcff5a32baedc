#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

#include "io/cloud_points.h"
#include "io/pcd_example.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const float kNan = std::numeric_limits<float>::quiet_NaN();
const std::vector<PcdPoint> kPoints = {{1, 2, 3, 0.5f, 0},
                                       {-4.25f, 5, 6e-3f, 1, 7},
                                       {kNan, kNan, kNan, 0, 9},
                                       {8, 9, 10, 0, 4294967295}};

class Pcd : public testing::Test {
 protected:
  absl::StatusOr<CloudPoints> Read(const std::string& bytes, const std::string& label = "label") {
    return ReadPcd(folder_.Write("cloud.pcd", bytes), label);
  }
  std::string ErrorOf(const std::string& bytes, const std::string& label = "label") {
    const auto read = Read(bytes, label);
    EXPECT_EQ(read.status().code(), absl::StatusCode::kInvalidArgument) << read.status();
    EXPECT_THAT(std::string(read.status().message()), HasSubstr("cloud.pcd"));
    return std::string(read.status().message());
  }
  // The ascii file with one text in the place of another.
  std::string Spoilt(const std::string& what, const std::string& by) {
    std::string text = AsciiPcd(kPoints);
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return text.replace(at, what.size(), by);
  }

  TemporaryFolder folder_;
};

void ExpectPoints(const absl::StatusOr<CloudPoints>& dut) {
  ASSERT_TRUE(dut.ok()) << dut.status();
  ASSERT_EQ(dut->points_S.size(), 4u);
  EXPECT_EQ(dut->points_S[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(dut->points_S[1], Eigen::Vector3f(-4.25f, 5, 6e-3f));
  EXPECT_FALSE(dut->points_S[2].allFinite());
  EXPECT_EQ(dut->points_S[3], Eigen::Vector3f(8, 9, 10));
  EXPECT_THAT(dut->labels, ElementsAre(0, 7, 9, kIgnoreLabel));
  EXPECT_THAT(dut->fields, ElementsAre("intensity", "x", "y", "normal", "z", "label"));
  EXPECT_FALSE(dut->has_viewpoint);
}

TEST_F(Pcd, Empty) {
  for (const std::string& bytes :
       {AsciiPcd({}), BinaryPcd({}), CompressedPcd({}), PcdHeaderOf(0, "binary_compressed")}) {
    const auto dut = Read(bytes);
    ASSERT_TRUE(dut.ok()) << dut.status();
    EXPECT_THAT(dut->points_S, IsEmpty());
  }
}

TEST_F(Pcd, TheSamePointsInEveryFormat) {
  ExpectPoints(Read(AsciiPcd(kPoints)));
  ExpectPoints(Read(BinaryPcd(kPoints)));
  ExpectPoints(Read(CompressedPcd(kPoints)));
}

TEST_F(Pcd, WithoutALabelFieldPointsAreStatic) {
  const auto dut = Read(BinaryPcd(kPoints), "");
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_THAT(dut->labels, ElementsAre(0, 0, 0, 0));
}

TEST_F(Pcd, WhatOtherWritersLeaveOutOrPutIn) {
  std::string text = AsciiPcd(kPoints);
  for (const char* line : {"# .PCD v0.7 - Point Cloud Data file format\n", "VERSION 0.7\n",
                           "POINTS 4\n", "VIEWPOINT 0 0 0 1 0 0 0\n"}) {
    text.erase(text.find(line), std::string(line).size());
  }
  ExpectPoints(Read(text));
  std::string dos;
  for (const char c : text) dos += c == '\n' ? "\r\n" : std::string(1, c);
  ExpectPoints(Read(dos));
  ExpectPoints(Read(BinaryPcd(kPoints) + std::string(100, '\0')));  // whole pages
}

TEST_F(Pcd, MayBeginWithAByteOrderMark) {
  ExpectPoints(Read("\xEF\xBB\xBF" + AsciiPcd(kPoints)));
  ExpectPoints(Read("\xEF\xBB\xBF" + BinaryPcd(kPoints)));
}

// Its last number might be cut off.
TEST_F(Pcd, RefusesALastLineThatDoesNotEnd) {
  const std::string text = AsciiPcd(kPoints);
  EXPECT_THAT(ErrorOf(text.substr(0, text.size() - 1)),
              HasSubstr("line 15: the line does not end; the file is cut off"));
}

TEST_F(Pcd, AnOrganizedCloudHasRows) {
  ExpectPoints(Read(Spoilt("WIDTH 4\nHEIGHT 1", "WIDTH 2\nHEIGHT 2")));
}

TEST_F(Pcd, AViewpointIsNoted) {
  std::string text = PcdHeaderOf(0, "ascii", "1 2 3 1 0 0 0");
  EXPECT_TRUE(Read(text)->has_viewpoint);
}

TEST_F(Pcd, SingleNumbersOfAnyType) {
  const auto dut = Read(
      "FIELDS x y z label\nSIZE 4 4 4 2\nTYPE F F F I\nWIDTH 2\nHEIGHT 1\n"
      "DATA ascii\n1 2 3 -1\n4 5 6 300\n");
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_THAT(dut->labels, ElementsAre(kIgnoreLabel, 300));
}

TEST_F(Pcd, RefusesHeadersThatDisagree) {
  EXPECT_THAT(ErrorOf(""), HasSubstr("line 1: the header ends without DATA"));
  EXPECT_THAT(ErrorOf("ply\nformat ascii 1.0\n"), HasSubstr("line 1: 'ply' is no entry of a PCD"));
  EXPECT_THAT(ErrorOf(std::string(1000, '\x80')), HasSubstr("line 1: the line does not end"));
  EXPECT_THAT(ErrorOf(Spoilt("SIZE 4 8 8 2 8 4", "SIZE 4 8 8 2 8")),
              HasSubstr("line 4: SIZE: 5 values, expected 6"));
  EXPECT_THAT(ErrorOf(Spoilt("SIZE 4 8", "SIZE 4 3")), HasSubstr("SIZE: 3 bytes of type F"));
  EXPECT_THAT(ErrorOf(Spoilt("SIZE 4 8", "SIZE 4 x")), HasSubstr("'x' is not a whole number"));
  EXPECT_THAT(ErrorOf(Spoilt("TYPE F F", "TYPE F D")),
              HasSubstr("line 5: TYPE: 'D' is not F, I or"));
  EXPECT_THAT(ErrorOf(Spoilt("TYPE F F F I F U", "TYPE F F I I F U")), HasSubstr("field y has 1"));
  EXPECT_THAT(ErrorOf(Spoilt("COUNT 1 1 1 3", "COUNT 1 1 1 0")), HasSubstr("line 6: COUNT"));
  EXPECT_THAT(ErrorOf(Spoilt("COUNT 1 1", "COUNT 1 2")),
              HasSubstr("field x has 2 numbers of type F8"));
  EXPECT_THAT(ErrorOf(Spoilt("POINTS 4", "POINTS 5")),
              HasSubstr("POINTS: 5, but WIDTH 4 times HEIGHT 1 is 4"));
  EXPECT_THAT(ErrorOf(Spoilt("FIELDS intensity", "FIELDS x")), HasSubstr("field x occurs twice"));
  EXPECT_THAT(ErrorOf(Spoilt("WIDTH 4\n", "")), HasSubstr("the header has no WIDTH"));
  EXPECT_THAT(ErrorOf(Spoilt("WIDTH 4\n", "WIDTH 4\nWIDTH 4\n")), HasSubstr("a second WIDTH"));
  EXPECT_THAT(ErrorOf(Spoilt("VIEWPOINT 0", "VIEWPOINT")), HasSubstr("VIEWPOINT: 6 values"));
  EXPECT_THAT(ErrorOf(Spoilt("VIEWPOINT 0", "VIEWPOINT x")),
              HasSubstr("VIEWPOINT: 'x' is not a number"));
  EXPECT_THAT(ErrorOf(Spoilt("DATA ascii", "DATA binary_lz4")),
              HasSubstr("'binary_lz4' is not ascii"));
  EXPECT_THAT(ErrorOf(Spoilt("FIELDS intensity x", "FIELDS intensity u")),
              HasSubstr("no field x; it has intensity u y normal z label"));
  EXPECT_THAT(ErrorOf(AsciiPcd(kPoints), "instance"), HasSubstr("no field instance; it has"));
  EXPECT_THAT(ErrorOf(AsciiPcd(kPoints), "normal"), HasSubstr("field normal has 3 numbers"));
  EXPECT_TRUE(absl::IsNotFound(ReadPcd(folder_ / "none.pcd", "").status()));
  EXPECT_TRUE(absl::IsResourceExhausted(
      Read(Spoilt("WIDTH 4\nHEIGHT 1", "WIDTH 20000001\nHEIGHT 1")).status()));
  EXPECT_TRUE(absl::IsResourceExhausted(
      Read(Spoilt("WIDTH 4\nHEIGHT 1", "WIDTH 9223372036854775807\nHEIGHT 4")).status()));
}

TEST_F(Pcd, RefusesPointsThatDisagree) {
  EXPECT_THAT(ErrorOf(AsciiPcd(kPoints) + "1 2 3 4 5 6 7 8\n"),
              HasSubstr("line 16: more than the 4 points of the header"));
  EXPECT_THAT(ErrorOf(Spoilt("0.5 1 2 1 2 3 3 0\n", "")),
              HasSubstr("3 points instead of 4; the file is cut"));
  EXPECT_THAT(ErrorOf(Spoilt("0.5 1 2 1 2 3 3 0\n", "0.5 1 2 1 2 3 3\n")),
              HasSubstr("line 12: 7 numbers; the header has 8"));
  EXPECT_THAT(ErrorOf(Spoilt("0.5 1 2 1", "0.5 1x 2 1")),
              HasSubstr("line 12: field x: '1x' is not a number"));
  EXPECT_THAT(ErrorOf(Spoilt("3 3 0\n", "3 3 0.5\n")),
              HasSubstr("point 0: label 0.5 is not a whole"));
  EXPECT_THAT(ErrorOf(Spoilt("3 3 0\n", "3 3 3000000000\n")), HasSubstr("at most 2147483647"));
  const std::string binary = BinaryPcd(kPoints), packed = CompressedPcd(kPoints);
  EXPECT_THAT(
      ErrorOf(binary.substr(0, binary.size() - 1)),
      AllOf(HasSubstr("151 bytes for 4 points of 38 bytes, which need 152"), HasSubstr("cut off")));
  EXPECT_THAT(ErrorOf(binary + "x"), HasSubstr("153 bytes for 4 points"));
  // More than a page of zeros are points that the header does not have.
  EXPECT_THAT(ErrorOf(binary + std::string(65'536, '\0')), HasSubstr("65688 bytes for 4 points"));
  EXPECT_THAT(ErrorOf(packed.substr(0, packed.size() - 1)), HasSubstr("cut off or damaged"));
  EXPECT_THAT(ErrorOf(packed + "x"), HasSubstr("cut off or damaged"));
  std::string damaged = packed;
  damaged[damaged.find("compressed\n") + 11 + 8] = '\xff';
  EXPECT_THAT(ErrorOf(damaged), HasSubstr("the compressed points are damaged"));
}

TEST_F(Pcd, GarbageIsAnErrorOrPoints) {
  std::mt19937 random(5);
  for (const std::string& whole : {AsciiPcd(kPoints), BinaryPcd(kPoints), CompressedPcd(kPoints)}) {
    for (std::size_t end = 0; end + 1 < whole.size(); ++end) {
      EXPECT_FALSE(Read(whole.substr(0, end)).ok()) << end;
    }
    for (int i = 0; i < 300; ++i) {
      std::string damaged = whole;
      for (int k = 0; k < 3; ++k) damaged[random() % damaged.size()] = static_cast<char>(random());
      const auto read = Read(damaged);
      EXPECT_TRUE(!read.ok() || read->points_S.size() == read->labels.size());
    }
  }
}

}  // namespace
}  // namespace clearway
