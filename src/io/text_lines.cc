#include "io/text_lines.h"

#include <algorithm>

#include "absl/strings/str_cat.h"

namespace clearway {
namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";

}  // namespace

bool TextLines::Next(std::string_view& line) {
  if (rest_.empty()) return false;
  const std::size_t end = std::min(rest_.find('\n'), rest_.size());
  line = rest_.substr(0, end);
  if (line.ends_with('\r')) line.remove_suffix(1);
  rest_.remove_prefix(std::min(end + 1, rest_.size()));
  ++number_;
  return true;
}

void TextLines::Skip(std::size_t count, int line_ends) {
  rest_.remove_prefix(count);
  number_ += line_ends;
}

absl::Status CheckLastLine(const std::string& name, std::string_view text, LastLine last) {
  if (last == LastLine::kMayBeOpen || text.empty() || text.back() == '\n') {
    return absl::OkStatus();
  }
  return absl::InvalidArgumentError(
      absl::StrCat(name, ", line ", 1 + std::count(text.begin(), text.end(), '\n'),
                   ": the last line does not end: the file seems cut off"));
}

std::string_view Trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string_view TakeWord(std::string_view& line, std::string_view separators) {
  line.remove_prefix(std::min(line.find_first_not_of(separators), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(separators));
  line.remove_prefix(word.size());
  return word;
}

}  // namespace clearway
