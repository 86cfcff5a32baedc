#include "io/word_table.h"

#include <cstdint>
#include <utility>

#include "clearway/base/file.h"

namespace clearway {
namespace {

constexpr std::uint64_t kMaxBytes = 1 << 28;

void AddWords(std::string_view line, const WordFormat& format, Row& row) {
  const bool commas = format.separators == Separators::kCommasToo;
  if (format.comments == Comments::kHash) line = line.substr(0, line.find('#'));
  while (true) {
    const std::string_view word = TakeWord(line, commas ? " \t\r\v\f," : " \t\r\v\f");
    if (word.empty()) return;
    row.Add(word);
  }
}

absl::StatusOr<std::string> ReadText(const std::filesystem::path& path, const WordFormat& format) {
  absl::StatusOr<std::string> text = ReadTextFile(path, kMaxBytes);
  if (!text.ok()) return text;
  if (auto status = CheckLastLine(path.string(), *text, format.last); !status.ok()) return status;
  return text;
}

}  // namespace

absl::Status VisitWords(const std::filesystem::path& path, const WordFormat& format,
                        LeftOut& left_out, const RowVisitor& visit) {
  const absl::StatusOr<std::string> text = ReadText(path, format);
  if (!text.ok()) return text.status();
  const std::string name = path.string();
  RowPolicy policy(left_out);
  Row row(name);
  TextLines lines(*text);
  for (std::string_view line; lines.Next(line);) {
    row.Restart(lines.number());
    AddWords(line, format, row);
    if (row.size() == 0) continue;
    if (auto status = policy.Visit(row, visit); !status.ok()) return status;
  }
  return policy.Finish();
}

absl::StatusOr<WordRows> ReadWordRows(const std::filesystem::path& path, const WordFormat& format) {
  absl::StatusOr<std::string> text = ReadText(path, format);
  if (!text.ok()) return text.status();
  WordRows result;
  result.name_and_text =
      std::make_shared<const std::pair<std::string, std::string>>(path.string(), *std::move(text));
  TextLines lines(result.name_and_text->second);
  for (std::string_view line; lines.Next(line);) {
    Row row(result.name_and_text->first);
    row.Restart(lines.number());
    AddWords(line, format, row);
    const bool is_blank = Trimmed(line).empty();  // a comment is not
    if (row.size() == 0 && !(is_blank && format.blanks == BlankLines::kRows)) continue;
    result.rows.push_back(std::move(row));
  }
  while (!result.rows.empty() && result.rows.back().size() == 0) result.rows.pop_back();
  return result;
}

}  // namespace clearway
