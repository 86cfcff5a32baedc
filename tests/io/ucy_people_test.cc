#include "clearway/io/ucy_people.h"

#include <gmock/gmock.h>

#include "support/temporary_folder.h"

namespace clearway {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr char kGood[] = "  7.800000e+02  1.0e+00  -1.5  0  8.25  -0.5  0  2\r\n";

class UcyPeople : public testing::Test {
 protected:
  absl::StatusOr<std::vector<UcyPerson>> Read(const std::string& text) {
    folder_.Write("obsmat.txt", text);
    return ReadUcyPeople(folder_.path() / "obsmat.txt", left_out_);
  }
  // What is left out of a table with this line between two good ones.
  std::string ReasonFor(const std::string& line) {
    left_out_ = {};
    const auto dut = Read(kGood + line + "\n790 1 -1.5 0 8.25 -0.5 0 2\n");
    EXPECT_TRUE(dut.ok()) << dut.status();
    if (!dut.ok() || left_out_.rows != 1) return "";
    EXPECT_EQ(dut->size(), 2u);
    return left_out_.reasons[0];
  }

  const TemporaryFolder folder_;
  LeftOut left_out_;
};

TEST_F(UcyPeople, Empty) {
  const auto dut = Read("");
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_TRUE(dut->empty());
  EXPECT_TRUE(absl::IsNotFound(ReadUcyPeople(folder_.path() / "none", left_out_).status()));
}

TEST_F(UcyPeople, RowsAreOfTheGround) {
  const auto dut = Read(kGood);
  ASSERT_TRUE(dut.ok()) << dut.status();
  ASSERT_EQ(dut->size(), 1u);
  EXPECT_EQ((*dut)[0].id, 1);
  EXPECT_EQ((*dut)[0].frame, 780);
  EXPECT_EQ((*dut)[0].p_W_m, Eigen::Vector2d(-1.5, 8.25));
  EXPECT_EQ((*dut)[0].v_W_mps, Eigen::Vector2d(-0.5, 2));
  EXPECT_EQ((*dut)[0].line, 1);
}

TEST_F(UcyPeople, CommasMaySeparateWords) {
  EXPECT_EQ(Read("780,1,-1.5,0,8.25,-0.5,0,2\n790, 1, 0, 0, 0, 0, 0, 0\n")->size(), 2u);
  EXPECT_EQ(Read(std::string(kGood) + "790,1,-1.5,0,8.25,-0.5,0,2\n")->size(), 2u);
  EXPECT_TRUE(left_out_.Empty());
}

TEST_F(UcyPeople, BadRowsAreLeftOutAndNamed) {
  EXPECT_THAT(ReasonFor("nan 1 0 0 0 0 0 0"), HasSubstr("line 2, word 1: 'nan' is not a finite"));
  EXPECT_THAT(ReasonFor("780 1 3"), HasSubstr("line 2: 3 words, expected eight: frame, id, x"));
  EXPECT_THAT(ReasonFor("785 1 2e8 0 0 0 0 0"), HasSubstr("line 2, word 3: '2e8' is not"));
  EXPECT_THAT(ReasonFor("785 1.5 0 0 0 0 0 0"), HasSubstr("word 2: '1.5' is not a person's"));
  EXPECT_THAT(ReasonFor("785 1 0 z 0 0 0 0"), HasSubstr("word 4: 'z' is not a number"));
  EXPECT_THAT(ReasonFor("785 1 0 0 0 inf 0 0"), HasSubstr("word 6: 'inf' is not a finite"));
  EXPECT_THAT(ReasonFor("780 1 5 0 5 0 0 0"),
              HasSubstr("line 2: a second row of person 1 in frame 780; the first: line 1"));
  EXPECT_EQ(ReasonFor(""), "");  // as in any table of words
  EXPECT_TRUE(left_out_.Empty());
}

TEST_F(UcyPeople, WhatIsNoSuchTableIsRefused) {
  EXPECT_THAT(std::string(Read("frame id x z y vx vz vy\n").status().message()),
              HasSubstr("obsmat.txt, line 1, word 1: 'frame' is not"));
  EXPECT_THAT(std::string(Read("1 2 3\n").status().message()), HasSubstr("line 1: 3 words"));
  EXPECT_THAT(std::string(Read("780 1 -1.5 0 8.25 -0.5 0 2").status().message()),
              HasSubstr("cut off"));
}

}  // namespace
}  // namespace clearway
