#include "io/header_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace clearway {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

using Rows = std::vector<std::vector<std::string>>;

// What one table gives.
struct Read {
  absl::Status status;
  Rows rows;
  std::vector<int> lines;
  LeftOut left_out;
};

std::vector<WantedColumn> Columns(const std::vector<std::string>& names) {
  std::vector<WantedColumn> columns;
  for (const std::string& name : names) columns.push_back({name});
  return columns;
}

Read ReadTable(const std::string& text, const std::vector<WantedColumn>& columns) {
  Read read;
  const auto visit = [&](Row& row) {
    std::vector<std::string>& fields = read.rows.emplace_back();
    for (std::size_t i = 0; i < row.size(); ++i) fields.emplace_back(row.Text(i));
    read.lines.push_back(row.line());
    return absl::OkStatus();
  };
  read.status = VisitTable("t.csv", text, {}, columns, read.left_out, visit);
  return read;
}

Read ReadAB(const std::string& text) { return ReadTable(text, Columns({"a", "b"})); }

// Visits the one row under the header a,b,c with `use`.
absl::Status UseRow(const std::string& text, const std::function<void(Row&)>& use) {
  LeftOut left_out;
  return VisitTable("t.csv", "a,b,c\n" + text + "\n", {}, Columns({"a", "b", "c"}), left_out,
                    [&](Row& row) {
                      use(row);
                      return row.status();
                    });
}

void ExpectRefused(const std::string& text, const std::string& why) {
  const Read dut = ReadAB(text);
  EXPECT_EQ(dut.status.code(), absl::StatusCode::kInvalidArgument) << text;
  EXPECT_THAT(dut.status.message(), HasSubstr(why)) << text;
}

TEST(HeaderTable, GivesTheWantedColumnsInTheirOrder) {
  const Read dut = ReadTable("x,b,a\n0,2,1\n0,4,3\n", Columns({"a", "b"}));
  ASSERT_TRUE(dut.status.ok()) << dut.status;
  EXPECT_EQ(dut.rows, (Rows{{"1", "2"}, {"3", "4"}}));
  EXPECT_TRUE(dut.left_out.Empty());
}

TEST(HeaderTable, QuotedFieldsHoldCommasQuotesAndLineEnds) {
  const Read dut = ReadAB("a,b\n\"1,\"\"x\"\"\n\",2\nnext,5\n");
  ASSERT_TRUE(dut.status.ok()) << dut.status;
  EXPECT_EQ(dut.rows, (Rows{{"1,\"x\"\n", "2"}, {"next", "5"}}));
  EXPECT_THAT(dut.lines, ElementsAre(2, 4));
}

TEST(HeaderTable, TakesCarriageReturnsBlanksEmptyLinesAndComments) {
  const Read dut = ReadAB("a,b\r\n1 , 2\r\n\r\n# note, of three, words\r\n\"3\",\"4\"\r\n");
  ASSERT_TRUE(dut.status.ok()) << dut.status;
  EXPECT_EQ(dut.rows, (Rows{{"1", "2"}, {"3", "4"}}));
  EXPECT_THAT(dut.lines, ElementsAre(2, 5));
}

TEST(HeaderTable, OptionalColumnsAreAllThereOrNone) {
  const std::vector<WantedColumn> columns = {{"a"}, {"b", true}, {"c", true}};
  bool has = true;
  LeftOut left_out;
  const auto visit = [&](Row& row) {
    has = row.Has(1);
    return absl::OkStatus();
  };
  ASSERT_TRUE(VisitTable("t.csv", "a\n1\n", {}, columns, left_out, visit).ok());
  EXPECT_FALSE(has);
  ASSERT_TRUE(VisitTable("t.csv", "a,c,b\n1,,\n", {}, columns, left_out, visit).ok());
  EXPECT_TRUE(has);  // though empty
  EXPECT_THAT(ReadTable("a,b\n1,2\n", columns).status.message(), HasSubstr("no column c"));
}

TEST(HeaderTable, RefusesWhatIsNotOfItsFormat) {
  ExpectRefused("", "t.csv, line 1: the file is empty");
  ExpectRefused("a,b\n1,2", "line 2: the last line does not end");
  ExpectRefused("a,a\n1,2\n", "column a occurs twice");
  ExpectRefused("a,c\n1,2\n", "t.csv, line 1: no column b; there are a, c");
  ExpectRefused("1,2\n3,4\n", "line 1: the header line seems missing: '1'");
  // The first row tells whether the file is of the format.
  ExpectRefused("a,b\n1\n", "line 2: 1 fields; the header has 2");
  ExpectRefused("a,b\n1,2,3\n1,2\n", "line 2: 3 fields; the header has 2");
  ExpectRefused("a,b\n\"1,2\n", "line 2: a quote is left open");
  ExpectRefused("a,b\n\"1\"x,2\n", "line 2: text follows a closing quote");
  ExpectRefused("a,b\n1\",2\n", "line 2: a quote inside an unquoted field");
}

TEST(HeaderTable, LeavesLaterBadRowsOutAndNamesThem) {
  const Read dut = ReadAB("a,b\n1,2\n3\n\"4\"x,5\n6,7\n\"8,9\n");
  ASSERT_TRUE(dut.status.ok()) << dut.status;
  EXPECT_EQ(dut.rows, (Rows{{"1", "2"}, {"6", "7"}}));
  EXPECT_EQ(dut.left_out.rows, 3u);
  EXPECT_THAT(dut.left_out.reasons, ElementsAre("t.csv, line 3: 1 fields; the header has 2",
                                                "t.csv, line 4: text follows a closing quote",
                                                "t.csv, line 6: a quote is left open"));
}

TEST(HeaderTable, RefusesATableOfWhichNoRowCanBeUsed) {
  LeftOut left_out;
  const auto visit = [](Row& row) { return row.Error("is bad"); };
  const auto status = VisitTable("t.csv", "a\n1\n2\n", {}, Columns({"a"}), left_out, visit);
  EXPECT_EQ(status.message(), "t.csv, line 2: is bad; no row of the table can be used");
}

TEST(HeaderTable, AnotherErrorOfTheVisitorEndsTheReading) {
  LeftOut left_out;
  const auto visit = [](Row&) { return absl::ResourceExhaustedError("enough"); };
  EXPECT_EQ(VisitTable("t.csv", "a\n1\n", {}, Columns({"a"}), left_out, visit).message(), "enough");
}

TEST(Row, ReadsNumbers) {
  const auto status = UseRow("-1.5e3, 42 ,7.0", [](Row& row) {
    EXPECT_EQ(row.Number(0), -1500.0);
    EXPECT_EQ(row.Integer(1, 0, 100), 42);
    EXPECT_EQ(row.Integer(2, 0, 100), 7);
  });
  EXPECT_TRUE(status.ok()) << status;
}

TEST(Row, ReadsPlainTextInUtf8Alone) {
  for (const char* text : {"Car", "", "Fußgänger", "歩行者", "\xF4\x8F\xBF\xBF"}) {
    const auto status =
        UseRow(std::string(text) + ",1,1", [&](Row& row) { EXPECT_EQ(row.PlainText(0), text); });
    EXPECT_TRUE(status.ok()) << text;
  }
  const char* const bad[] = {"Fu\xDFg\xE4nger",  "\x80",         "\xC3",
                             "\xC0\xAF",         "\xED\xA0\x80", "\xE0\x9F\xBF",
                             "\xF4\x90\x80\x80", "\xFF"};
  for (const char* text : bad) {
    const auto status = UseRow(std::string(text) + ",1,1", [](Row& row) { row.PlainText(0); });
    EXPECT_THAT(status.message(), HasSubstr("is not text in UTF-8 without control")) << text;
  }
}

TEST(Row, ReadsTextOfSomeLengthAlone) {
  for (const std::size_t size : {200u, 201u}) {
    const auto status = UseRow(std::string(size, 'x') + ",1,1", [](Row& row) { row.PlainText(0); });
    EXPECT_EQ(status.ok(), size == 200) << status;
  }
  const auto status = UseRow(std::string("C\0r", 3) + ",1,1", [](Row& row) { row.PlainText(0); });
  EXPECT_THAT(status.message(), HasSubstr("without control characters"));
}

TEST(Row, KeepsTheFirstErrorWithItsPlace) {
  const auto use = [](Row& row) {
    row.Number(0);
    row.Integer(1, 0, 5);
  };
  EXPECT_EQ(UseRow("1.5x,7,1", use).message(),
            "t.csv, line 2, column a: '1.5x' is not a finite number");
  EXPECT_THAT(UseRow("1,7,1", use).message(),
              HasSubstr("t.csv, line 2, column b: '7' is not an integer from 0 to 5"));
  EXPECT_THAT(UseRow("1,5,nan", [](Row& row) { row.Number(2); }).message(),
              HasSubstr("column c: 'nan' is not a finite number"));
}

}  // namespace
}  // namespace clearway
