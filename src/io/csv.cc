#include "io/csv.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "absl/strings/str_cat.h"
#include "io/file.h"
#include "io/no_column.h"
#include "io/utf8.h"

namespace clearway {
namespace {

constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 30;

// Splits text into records of fields, one after another.
class Scanner {
 public:
  explicit Scanner(const std::string& text) : text_(text) {
    if (text_.compare(0, 3, "\xEF\xBB\xBF") == 0) at_ = 3;  // byte order mark
  }

  bool AtEnd() const { return at_ >= text_.size(); }
  int line() const { return line_; }
  const std::string& error() const { return error_; }

  // Appends the next record's fields; false with error() set if it is malformed.
  bool Next(std::vector<std::string>& fields) {
    do {
      fields.emplace_back();
      if (!Field(fields.back())) return false;
    } while (Take(','));
    Take('\r');
    if (!Take('\n')) {
      return Fail(AtEnd() ? "the last line does not end: the file seems cut off"
                          : "text follows a closing quote");
    }
    ++line_;
    return true;
  }

 private:
  bool Field(std::string& out) {
    if (Take('"')) return Quoted(out);
    const std::size_t end = std::min(text_.find_first_of(",\r\n\"", at_), text_.size());
    out.assign(text_, at_, end - at_);
    at_ = end;
    if (at_ < text_.size() && text_[at_] == '"') return Fail("a quote inside an unquoted field");
    return true;
  }

  bool Quoted(std::string& out) {
    while (!AtEnd()) {
      const char c = text_[at_++];
      if (c == '"' && !Take('"')) return true;
      if (c == '\n') ++line_;
      out.push_back(c);
    }
    return Fail("a quote is left open");
  }

  bool Take(char c) {
    if (AtEnd() || text_[at_] != c) return false;
    ++at_;
    return true;
  }

  bool Fail(const char* why) {
    error_ = why;
    return false;
  }

  const std::string& text_;
  std::size_t at_ = 0;
  int line_ = 1;
  std::string error_;
};

std::string_view Trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return {};
  return std::string_view(text).substr(first, text.find_last_not_of(" \t") - first + 1);
}

template <class T>
bool ParseWhole(const std::string& text, T& value) {
  const std::string_view digits = Trimmed(text);
  const char* const end = digits.data() + digits.size();
  const auto [rest, error] = std::from_chars(digits.data(), end, value);
  return error == std::errc() && rest == end;
}

// What of a bad field is worth showing.
std::string Excerpt(const std::string& text) {
  return text.size() <= 40 ? text : text.substr(0, 40) + "...";
}

}  // namespace

absl::StatusOr<CsvTable> CsvTable::Parse(const std::string& name, const std::string& text) {
  CsvTable table;
  table.name_ = name;
  Scanner scanner(text);
  const auto fail = [&](int line, const std::string& why) {
    return absl::InvalidArgumentError(absl::StrCat(name, ", line ", line, ": ", why));
  };
  if (scanner.AtEnd()) return fail(1, "the file is empty; a header line is expected");
  if (!scanner.Next(table.header_)) return fail(1, scanner.error());
  std::set<std::string> names;
  for (const std::string& column : table.header_) {
    if (double number; ParseWhole(column, number)) {
      return fail(1, absl::StrCat("the header line seems missing: '", Excerpt(column),
                                  "' is a number, not the name of a column"));
    }
    if (!names.insert(column).second) {
      return fail(1, absl::StrCat("column ", Excerpt(column), " occurs twice"));
    }
  }
  while (!scanner.AtEnd()) {
    const int line = scanner.line();
    const std::size_t before = table.cells_.size();
    if (!scanner.Next(table.cells_)) return fail(line, scanner.error());
    const std::size_t fields = table.cells_.size() - before;
    if (fields != table.header_.size()) {
      return fail(line, absl::StrCat(fields, " fields; the header has ", table.header_.size()));
    }
    table.lines_.push_back(line);
  }
  return table;
}

absl::StatusOr<CsvTable> CsvTable::Read(const std::filesystem::path& path) {
  const absl::StatusOr<std::string> text = ReadWholeFile(path, kMaxBytes);
  if (!text.ok()) return text.status();
  return Parse(path.string(), *text);
}

bool CsvTable::HasColumn(const std::string& column) const {
  return std::find(header_.begin(), header_.end(), column) != header_.end();
}

absl::StatusOr<std::size_t> CsvTable::Column(const std::string& column) const {
  const auto it = std::find(header_.begin(), header_.end(), column);
  if (it == header_.end()) {
    return absl::InvalidArgumentError(absl::StrCat(name_, ", line 1: ", NoColumn(column, header_)));
  }
  return static_cast<std::size_t>(it - header_.begin());
}

std::string CsvTable::Where(std::size_t row) const {
  return absl::StrCat(name_, ", line ", lines_[row]);
}

std::string CsvTable::Where(std::size_t row, std::size_t column) const {
  return absl::StrCat(Where(row), ", column ", header_[column]);
}

double CsvRow::Number(std::size_t column) {
  double value = 0;
  if (!ParseWhole(Cell(column), value) || !std::isfinite(value)) Fail(column, "a finite number");
  return value;
}

double CsvRow::NumberWithin(std::size_t column, double limit) {
  return NumberBetween(column, -limit, limit);
}

double CsvRow::NumberBetween(std::size_t column, double min, double max) {
  const double value = Number(column);
  if (!(min <= value && value <= max)) {
    Fail(column, absl::StrCat("a number from ", min, " to ", max));
  }
  return value;
}

std::int64_t CsvRow::Integer(std::size_t column, std::int64_t min, std::int64_t max) {
  std::int64_t value = 0;
  if (!ParseWhole(Cell(column), value) || value < min || value > max) {
    Fail(column, absl::StrCat("an integer from ", min, " to ", max));
  }
  return value;
}

const std::string& CsvRow::Text(std::size_t column) {
  constexpr std::size_t kMostBytes = 200;
  if (!IsPlainText(Cell(column))) Fail(column, "text in UTF-8 without control characters");
  if (Cell(column).size() > kMostBytes) {
    Fail(column, absl::StrCat("text of at most ", kMostBytes, " bytes"));
  }
  return Cell(column);
}

void CsvRow::Fail(std::size_t column, const std::string& expected) {
  if (!status_.ok()) return;
  status_ = absl::InvalidArgumentError(absl::StrCat(table_.Where(row_, column), ": '",
                                                    Excerpt(Cell(column)), "' is not ", expected));
}

}  // namespace clearway
