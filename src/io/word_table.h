// Tables of words between blanks, a row a line, without a header.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "io/row_policy.h"
#include "io/text_lines.h"

namespace clearway {

// What follows a # up to the end of the line.
enum class Comments { kNone, kHash };
// What stands between words besides blanks and tabs.
enum class Separators { kBlanks, kCommasToo };
// Whether empty lines are rows without words, up to the last line with words: in tables whose rows
// are numbered by their lines.
enum class BlankLines { kSkipped, kRows };

struct WordFormat {
  LastLine last = LastLine::kEnds;
  Comments comments = Comments::kNone;
  Separators separators = Separators::kBlanks;
  BlankLines blanks = BlankLines::kSkipped;
};

// Visits the lines that hold words, under the policy of RowPolicy. Errors of ReadTextFile above
// 256 MB; INVALID_ARGUMENT for a file that seems cut off.
absl::Status VisitWords(const std::filesystem::path& path, const WordFormat& format,
                        LeftOut& left_out, const RowVisitor& visit);

// The rows of a file that is of use only as a whole. A value; copies share the text.
struct WordRows {
  std::shared_ptr<const std::pair<std::string, std::string>> name_and_text;
  std::vector<Row> rows;
};
absl::StatusOr<WordRows> ReadWordRows(const std::filesystem::path& path, const WordFormat& format);

}  // namespace clearway
