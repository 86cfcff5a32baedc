#include "io/pfm.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "io/pcd_example.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string Floats(std::initializer_list<float> values) {
  std::string bytes;
  for (const float value : values) PutBytes(bytes, value);
  return bytes;
}

class Pfm : public testing::Test {
 protected:
  absl::StatusOr<FloatImage> Read(const std::string& bytes) {
    return ReadPfm(folder_.Write("depth.pfm", bytes));
  }
  std::string ErrorOf(const std::string& bytes) {
    const auto read = Read(bytes);
    EXPECT_TRUE(absl::IsInvalidArgument(read.status())) << read.status();
    return std::string(read.status().message());
  }

  TemporaryFolder folder_;
};

TEST_F(Pfm, Empty) {
  EXPECT_TRUE(absl::IsNotFound(ReadPfm(folder_ / "none.pfm").status()));
  EXPECT_THAT(ErrorOf(""), HasSubstr("not a PFM file"));
}

TEST_F(Pfm, RowsGoFromTheBottomUp) {
  const auto dut = Read("Pf\n2 3\n-1.0\n" + Floats({5, 6, 3, 4, 1, 2}));
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->width, 2u);
  EXPECT_EQ(dut->height, 3u);
  EXPECT_THAT(dut->pixels, ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST_F(Pfm, BigEndianOnes) {
  const auto dut = Read(std::string("Pf\n1 1\n1\n") + '\x3f' + std::string("\xc0\x00\x00", 3));
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_THAT(dut->pixels, ElementsAre(1.5f));
}

TEST_F(Pfm, Refusals) {
  EXPECT_THAT(ErrorOf("PF\n1 1\n-1\n"), HasSubstr("a colour image"));
  EXPECT_THAT(ErrorOf("P5\n1 1\n255\n"), HasSubstr("does not begin with Pf"));
  EXPECT_THAT(ErrorOf("Pf\n1\n"), HasSubstr("no width, height and scale"));
  EXPECT_THAT(ErrorOf("Pf\n1 -1\n-1\n"), HasSubstr("no width, height and scale"));
  EXPECT_THAT(ErrorOf("Pf\n1 1\n-0.001\n" + Floats({1})), HasSubstr("a scale of -0.001"));
  EXPECT_THAT(ErrorOf("Pf\n2 1\n-1\n" + Floats({1})),
              HasSubstr("4 bytes of pixels; 2 x 1 pixels need 8"));
  EXPECT_THAT(ErrorOf("Pf\n1 1\n-1\n" + Floats({1, 2})), HasSubstr("8 bytes of pixels"));
  EXPECT_THAT(ErrorOf("Pf\n4294967295 4294967295\n-1\n"), HasSubstr("too many pixels"));
}

}  // namespace
}  // namespace clearway
