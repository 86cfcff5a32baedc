// Which rows of a table are left out, and which tables are refused.
#pragma once

#include <cstdint>
#include <functional>

#include "absl/status/status.h"
#include "clearway/io/left_out.h"
#include "io/row.h"

namespace clearway {

// Takes what can be used from one row. An INVALID_ARGUMENT, or an error that the row keeps, makes
// it a bad row, of which nothing may have been taken; any other error ends the reading.
using RowVisitor = std::function<absl::Status(Row&)>;

// The one policy of all tables that are recordings: a bad row is left out, counted and named. A
// table is refused, with the line, if its first row is not of the format, or if no row can be used.
// Tables whose rows are numbered by their lines keep empty lines, as rows without words: bad rows.
// Where the rest of a file depends on every row, as in a calibration, readers do not use this, and
// refuse the file.
class RowPolicy {
 public:
  explicit RowPolicy(LeftOut& left_out) : left_out_(left_out) {}

  // Not OK if the table is refused.
  absl::Status Visit(Row& row, const RowVisitor& visit);
  // After the last row.
  absl::Status Finish() const;

 private:
  LeftOut& left_out_;
  std::uint64_t good_ = 0;
  absl::Status first_bad_;
};

}  // namespace clearway
