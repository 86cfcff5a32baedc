// Rows that are left out, over the readers of tables.
#include <gmock/gmock.h>

#include "absl/strings/str_replace.h"
#include "io/tum_rgbd_example.h"

namespace clearway {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

using LeftOutOfTum = TumRgbd;

TEST_F(LeftOutOfTum, ByteOrderMarksAndCommasAreTaken) {
  const auto plain = Open();
  ASSERT_TRUE(plain.ok()) << plain.status();
  folder_.Write("groundtruth.txt", "\xEF\xBB\xBF" + absl::StrReplaceAll(kTumTrack, {{" ", ","}}));
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  ASSERT_EQ(dut->poses.size(), plain->poses.size());
  for (std::size_t i = 0; i < dut->poses.size(); ++i) {
    EXPECT_EQ(dut->poses[i].T_W_S, plain->poses[i].T_W_S);
  }
  EXPECT_TRUE(dut->frames.left_out->rows == 0);
}

TEST_F(LeftOutOfTum, ARowOfNanIsCountedAndNamed) {
  folder_.Write("groundtruth.txt",
                kTumTrack + std::string("1305031103 nan nan nan nan nan nan nan\n"));
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->frames.left_out->rows, 1u);
  EXPECT_THAT(dut->frames.left_out->reasons.front(),
              AllOf(HasSubstr("groundtruth.txt, line 8"), HasSubstr("'nan'")));
}

}  // namespace
}  // namespace clearway
