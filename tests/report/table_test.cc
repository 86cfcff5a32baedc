#include "clearway/report/table.h"

#include <gtest/gtest.h>

namespace clearway {
namespace {

TEST(Table, Empty) { EXPECT_EQ(Table({"id", "kind"}).ToString(), "id  kind\n--  ----\n"); }

TEST(Table, AlignsNumbersRightAndTextLeft) {
  Table dut({"id", "kind", "speed"});
  dut.AddRow({"1", "van", "6.9 m/s"});
  dut.AddRow({"12", "cyclist", "-"});
  EXPECT_EQ(dut.ToString(),
            "id  kind       speed\n"
            "--  -------  -------\n"
            " 1  van      6.9 m/s\n"
            "12  cyclist        -\n");
}

TEST(Table, CountsCodePoints) {
  Table dut({"a", "b"});
  dut.AddRow({"\u00b1x", "y"});
  EXPECT_EQ(dut.ToString(), "a   b\n--  -\n\u00b1x  y\n");
}

TEST(Table, FillsMissingCellsAndDropsSurplusOnes) {
  Table dut({"a", "b"});
  dut.AddRow({"x"});
  dut.AddRow({"x", "y", "z"});
  EXPECT_EQ(dut.ToString(), "a  b\n-  -\nx\nx  y\n");
}

}  // namespace
}  // namespace clearway
