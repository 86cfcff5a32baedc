// Tables of comma-separated numbers that may be large: read row by row, kept nowhere.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "clearway/geometry/pose.h"

namespace clearway {

struct NumberColumn {
  const char* name;
  bool optional = false;
};

// A row's wanted columns, by their index among these; the first error is kept, so that a row is
// read like a struct. Valid while it is visited.
class NumberRow {
 public:
  bool Has(std::size_t i) const { return fields_[i].data() != nullptr; }
  std::string_view Text(std::size_t i) const { return fields_[i]; }
  // A finite number.
  double Number(std::size_t i);
  // An integer in [min, max].
  std::int64_t Integer(std::size_t i, std::int64_t min, std::int64_t max);
  // x, y, z within kMaxFileCoordinate_m, then a quaternion's x, y, z, w, which is normalised: files
  // round it.
  Pose PoseFrom(std::size_t i);
  // INVALID_ARGUMENT: "log.csv, line 12: <why>".
  absl::Status Error(const std::string& why) const;
  const absl::Status& status() const { return status_; }

 private:
  friend class NumberTable;

  void Fail(std::size_t i, const std::string& expected);

  std::string file_;
  int line_ = 0;
  std::span<const NumberColumn> columns_;
  std::vector<std::string_view> fields_;  // of the wanted columns; null if there is none
  absl::Status status_;
};

using RowVisitor = std::function<absl::Status(NumberRow&)>;

// Visits the rows under the header, in which the columns may come in any order and with others
// among them, until one gives an error. Fields are not quoted; the last line need not end.
// NOT_FOUND, RESOURCE_EXHAUSTED above max_bytes; INVALID_ARGUMENT names the line: no such column, a
// row with more or fewer fields than the header.
absl::Status VisitRows(const std::filesystem::path& path, std::uint64_t max_bytes,
                       std::span<const NumberColumn> columns, const RowVisitor& visit);

}  // namespace clearway
