#include "io/csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace clearway {
namespace {

using ::testing::HasSubstr;

std::string ErrorOf(const std::string& text) {
  const auto table = CsvTable::Parse("t.csv", text);
  EXPECT_EQ(table.status().code(), absl::StatusCode::kInvalidArgument);
  return std::string(table.status().message());
}

TEST(CsvTable, Empty) { EXPECT_THAT(ErrorOf(""), HasSubstr("t.csv, line 1: the file is empty")); }

TEST(CsvTable, HoldsFieldsByColumnName) {
  const auto dut = CsvTable::Parse("t.csv", "a,b\n1,2\n3,4\n");
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->rows(), 2u);
  EXPECT_EQ(dut->Text(1, *dut->Column("b")), "4");
  EXPECT_TRUE(dut->HasColumn("a"));
  EXPECT_FALSE(dut->HasColumn("c"));
}

TEST(CsvTable, QuotedFieldsHoldCommasQuotesAndLineEnds) {
  const auto dut = CsvTable::Parse("t.csv", "a,b\n\"1,\"\"x\"\"\n\",2\nnext,5\n");
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->Text(0, 0), "1,\"x\"\n");
  EXPECT_EQ(dut->Where(1, 1), "t.csv, line 4, column b");
}

TEST(CsvTable, TakesCarriageReturnsAndAByteOrderMark) {
  const auto dut = CsvTable::Parse("t.csv",
                                   "\xEF\xBB\xBF"
                                   "a,b\r\n1,2\r\n");
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_TRUE(dut->HasColumn("a"));
  EXPECT_EQ(dut->Text(0, 1), "2");
}

TEST(CsvTable, RefusesMalformedText) {
  EXPECT_THAT(ErrorOf("a,b\n1,2"), HasSubstr("line 2: the last line does not end"));
  EXPECT_THAT(ErrorOf("a,b\n1\n"), HasSubstr("line 2: 1 fields; the header has 2"));
  EXPECT_THAT(ErrorOf("a,b\n1,2,3\n"), HasSubstr("line 2: 3 fields; the header has 2"));
  EXPECT_THAT(ErrorOf("a,b\n\"1,2\n"), HasSubstr("line 2: a quote is left open"));
  EXPECT_THAT(ErrorOf("a,b\n\"1\"x,2\n"), HasSubstr("line 2: text follows a closing quote"));
  EXPECT_THAT(ErrorOf("a,b\n1\",2\n"), HasSubstr("line 2: a quote inside an unquoted field"));
  EXPECT_THAT(ErrorOf("a,a\n1,2\n"), HasSubstr("column a occurs twice"));
  EXPECT_THAT(ErrorOf("1,2\n3,4\n"), HasSubstr("line 1: the header line seems missing: '1'"));
}

TEST(CsvTable, NamesAMissingColumn) {
  const auto dut = CsvTable::Parse("t.csv", "a,c\n1,2\n");
  ASSERT_TRUE(dut.ok());
  EXPECT_THAT(std::string(dut->Column("b").status().message()),
              HasSubstr("t.csv, line 1: no column b; there are a, c"));
}

TEST(CsvRow, ReadsNumbers) {
  const auto table = CsvTable::Parse("t.csv", "a,b\n-1.5e3, 42 \n");
  ASSERT_TRUE(table.ok());
  CsvRow dut(*table, 0);
  EXPECT_EQ(dut.Number(0), -1500.0);
  EXPECT_EQ(dut.Integer(1, 0, 100), 42);
  EXPECT_TRUE(dut.status().ok());
}

TEST(CsvRow, ReadsPlainTextInUtf8Alone) {
  for (const char* text : {"Car", "", "Fußgänger", "歩行者", "\xF4\x8F\xBF\xBF"}) {
    const auto table = CsvTable::Parse("t.csv", std::string("a\n") + text + "\n");
    CsvRow dut(*table, 0);
    EXPECT_EQ(dut.Text(0), text);
    EXPECT_TRUE(dut.status().ok()) << text;
  }
  const char* const bad[] = {"Fu\xDFg\xE4nger",  "\x80",         "\xC3",
                             "\xC0\xAF",         "\xED\xA0\x80", "\xE0\x9F\xBF",
                             "\xF4\x90\x80\x80", "\xFF"};
  for (const char* text : bad) {
    const auto table = CsvTable::Parse("t.csv", std::string("a\n") + text + "\n");
    CsvRow dut(*table, 0);
    dut.Text(0);
    EXPECT_THAT(dut.status().message(), HasSubstr("is not text in UTF-8 without control")) << text;
  }
}

TEST(CsvRow, ReadsTextOfSomeLengthAlone) {
  for (const std::size_t size : {200u, 201u}) {
    const auto table = CsvTable::Parse("t.csv", "a\n" + std::string(size, 'x') + "\n");
    CsvRow dut(*table, 0);
    dut.Text(0);
    EXPECT_EQ(dut.status().ok(), size == 200);
  }
  const auto table = CsvTable::Parse("t.csv", std::string("a\nC\0r\n", 6));
  CsvRow dut(*table, 0);
  dut.Text(0);
  EXPECT_THAT(dut.status().message(), HasSubstr("without control characters"));
}

TEST(CsvRow, KeepsTheFirstErrorWithItsPlace) {
  const auto table = CsvTable::Parse("t.csv", "a,b,c\n1.5x,7,nan\n");
  ASSERT_TRUE(table.ok());
  CsvRow dut(*table, 0);
  dut.Number(0);
  dut.Integer(1, 0, 5);
  EXPECT_EQ(dut.status().message(), "t.csv, line 2, column a: '1.5x' is not a finite number");
  CsvRow integer(*table, 0);
  integer.Integer(1, 0, 5);
  EXPECT_EQ(integer.status().message(),
            "t.csv, line 2, column b: '7' is not an integer from 0 to 5");
  CsvRow nan(*table, 0);
  nan.Number(2);
  EXPECT_FALSE(nan.status().ok());
}

}  // namespace
}  // namespace clearway
