// Tables of comma-separated values under a header (RFC 4180).
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "absl/status/status.h"
#include "io/row_policy.h"
#include "io/text_lines.h"

namespace clearway {

struct WantedColumn {
  std::string name;
  bool optional = false;  // the optional columns are all there, or none of them is
};

struct HeaderFormat {
  std::uint64_t max_bytes = std::uint64_t{1} << 30;
  LastLine last = LastLine::kEnds;
};

// Visits the rows under the header, under the policy of RowPolicy; a row's fields are the wanted
// columns, which may stand in any order and with others among them. Fields may be quoted; blanks
// around the others do not matter, nor do empty lines and those that begin with #. Rows are kept
// nowhere, so a table may be large. Errors of ReadTextFile; INVALID_ARGUMENT names the line: no
// header, a column that is missing or named twice, a last line that does not end.
absl::Status VisitTable(const std::filesystem::path& path, const HeaderFormat& format,
                        std::span<const WantedColumn> columns, LeftOut& left_out,
                        const RowVisitor& visit);

// The same of a text, which `name` names in messages.
absl::Status VisitTable(const std::string& name, std::string_view text, const HeaderFormat& format,
                        std::span<const WantedColumn> columns, LeftOut& left_out,
                        const RowVisitor& visit);

}  // namespace clearway
