// Tables of comma-separated values (RFC 4180).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "absl/status/statusor.h"

namespace clearway {

// A table with a header line. Fields may be quoted; lines end in LF or CRLF, the last one too (its
// absence is how a file cut off in the middle of a number is told from a whole one). A value.
class CsvTable {
 public:
  // `name` names the table in messages. INVALID_ARGUMENT names the line: no header, a column named
  // twice, a line with more or fewer fields than the header, a quote left open, no last line end.
  static absl::StatusOr<CsvTable> Parse(const std::string& name, const std::string& text);
  static absl::StatusOr<CsvTable> Read(const std::filesystem::path& path);

  std::size_t rows() const { return lines_.size(); }
  bool HasColumn(const std::string& column) const;
  // INVALID_ARGUMENT naming the table and the column.
  absl::StatusOr<std::size_t> Column(const std::string& column) const;
  const std::string& Text(std::size_t row, std::size_t column) const {
    return cells_[row * header_.size() + column];
  }
  // "poses.csv, line 12, column T00", for messages. Lines count from 1.
  std::string Where(std::size_t row, std::size_t column) const;
  std::string Where(std::size_t row) const;

 private:
  std::string name_;
  std::vector<std::string> header_;
  std::vector<std::string> cells_;  // row-major
  std::vector<int> lines_;          // where each row starts
};

// Reads the numbers of one row and keeps the first error, so that a row is read like a struct.
class CsvRow {
 public:
  CsvRow(const CsvTable& table, std::size_t row) : table_(table), row_(row) {}

  // A finite number.
  double Number(std::size_t column);
  // Within a limit either way.
  double NumberWithin(std::size_t column, double limit);
  // In [min, max].
  double NumberBetween(std::size_t column, double min, double max);
  // An integer in [min, max].
  std::int64_t Integer(std::size_t column, std::int64_t min, std::int64_t max);
  // At most 200 bytes of UTF-8 without control characters.
  const std::string& Text(std::size_t column);

  const absl::Status& status() const { return status_; }

 private:
  const std::string& Cell(std::size_t column) const { return table_.Text(row_, column); }
  void Fail(std::size_t column, const std::string& expected);

  const CsvTable& table_;
  std::size_t row_;
  absl::Status status_;
};

}  // namespace clearway
