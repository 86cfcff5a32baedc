#include "cli/state_list.h"

#include <gmock/gmock.h>

namespace clearway::cli {
namespace {

using ::testing::HasSubstr;

std::string ErrorOf(const std::string& text) {
  return std::string(ReadStates("path.csv", text).status().message());
}

TEST(ReadStates, Empty) { EXPECT_EQ(ErrorOf(""), "path.csv: holds no states"); }

TEST(ReadStates, ReadsColumnsInAnyOrder) {
  const auto dut = ReadStates(
      "path.csv", "t, yaw, z, y, x\n# start\n+1.5, 0, 3, 2, 1\r\n\n7, 1.5707963267948966,0,0,0\n");
  ASSERT_TRUE(dut.ok()) << dut.status();
  ASSERT_EQ(dut->size(), 2u);
  EXPECT_EQ((*dut)[0].T_W_R.translation, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ((*dut)[0].time, (TimeArgument{true, FromSeconds(1.5)}));
  EXPECT_EQ((*dut)[1].time, (TimeArgument{false, FromSeconds(7)}));
  EXPECT_LT(((*dut)[1].T_W_R * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(), 1e-12);
}

TEST(ReadStates, ReadsQuaternions) {
  const auto dut = ReadStates("path.csv", "x,y,z,qx,qy,qz,qw\n0,0,0,1,0,0,0\n");
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_LT(((*dut)[0].T_W_R * Eigen::Vector3d::UnitZ() + Eigen::Vector3d::UnitZ()).norm(), 1e-12);
}

TEST(ReadStates, NamesLineAndColumn) {
  EXPECT_THAT(ErrorOf("x,y,z\n"), HasSubstr("path.csv, line 1: expected the columns"));
  EXPECT_THAT(ErrorOf("x,y,z,yaw,speed\n"), HasSubstr("column 'speed' is not known"));
  EXPECT_THAT(ErrorOf("x,y,z,yaw,x\n"), HasSubstr("column 'x' is named twice"));
  EXPECT_THAT(ErrorOf("x,y,z,yaw,qw\n"), HasSubstr("expected the columns"));
  EXPECT_EQ(ErrorOf("x,y,z,yaw\n1,2,3\n"), "path.csv, line 2: has 3 fields, the header has 4");
  EXPECT_THAT(ErrorOf("x,y,z,yaw\n1,2,3,4\n1,nan,3,4\n"),
              HasSubstr("path.csv, line 3, column y: "));
  EXPECT_THAT(ErrorOf("x,y,z,yaw,t\n1,2,3,4,later\n"), HasSubstr("line 2, column t: "));
  EXPECT_THAT(
      ErrorOf("x,y,z,qx,qy,qz,qw\n0,0,0,0,0,0,2\n"),
      HasSubstr("the quaternion has length 2; a unit quaternion is needed, to within 0.01"));
}

TEST(ParseState, TimeIsOptional) {
  const auto now = ParseState("1,2,3,0.5");
  ASSERT_TRUE(now.ok()) << now.status();
  EXPECT_EQ(now->time, TimeArgument{});
  const auto later = ParseState("1,2,3,0.5,+2");
  ASSERT_TRUE(later.ok()) << later.status();
  EXPECT_EQ(later->time, (TimeArgument{true, FromSeconds(2)}));
}

TEST(ParseState, RefusesWhatIsNoState) {
  for (const char* text : {"", "1,2,3", "1,2,3,4,5,6", "1,2,3,x", "1,2,3,4,x"}) {
    EXPECT_FALSE(ParseState(text).ok()) << text;
  }
}

TEST(BatchOf, PlacesEveryLinkOnTheBase) {
  const auto state = ParseState("1,2,3,1.5707963267948966,+1");
  ASSERT_TRUE(state.ok()) << state.status();
  const StateBatch batch =
      BatchOf({*state}, {Pose{}, Pose::Translation(1, 0, 0)}, TimeFromNanoseconds(5'000'000'000));
  ASSERT_EQ(batch.T_W_L.size(), 2u);
  EXPECT_EQ(batch.times, std::vector{TimeFromNanoseconds(6'000'000'000)});
  EXPECT_LT((batch.T_W_L[1].translation - Eigen::Vector3d(1, 3, 3)).norm(), 1e-12);
}

}  // namespace
}  // namespace clearway::cli
