#include "io/row_policy.h"

#include <string>

#include "absl/strings/str_cat.h"

namespace clearway {

absl::Status RowPolicy::Visit(Row& row, const RowVisitor& visit) {
  if (row.size() == 0 && row.status().ok()) {
    // Nothing that could be of another format, even in the first line.
    left_out_.AddRow(absl::StrCat(row.where(), ": the line is empty, so its frame is left out"));
    return absl::OkStatus();
  }
  absl::Status status = row.status();
  if (status.ok()) status = visit(row);
  const bool is_usable = status.ok() || absl::IsInvalidArgument(status);
  if (is_usable && !row.status().ok()) status = row.status();
  if (status.ok()) {
    ++good_;
    return status;
  }
  if (!absl::IsInvalidArgument(status)) return status;
  const bool is_first = good_ == 0 && first_bad_.ok();
  if (is_first && row.malformed()) return status;
  if (first_bad_.ok()) first_bad_ = status;
  left_out_.AddRow(std::string(status.message()));
  return absl::OkStatus();
}

absl::Status RowPolicy::Finish() const {
  if (good_ > 0 || first_bad_.ok()) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat(first_bad_.message(), "; no row of the table can be used"));
}

}  // namespace clearway
