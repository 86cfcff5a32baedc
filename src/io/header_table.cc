#include "io/header_table.h"

#include <algorithm>
#include <deque>
#include <utility>

#include "absl/strings/str_cat.h"
#include "clearway/base/file.h"
#include "clearway/base/parse_number.h"

namespace clearway {
namespace {

// Cuts a table into records of fields.
class Records {
 public:
  explicit Records(std::string_view text) : lines_(text) {}

  // The next record that is neither empty nor a comment; false at the end. A malformed one gives
  // error(), and reading goes on at the next line.
  bool Next() {
    for (std::string_view line; lines_.Next(line);) {
      line_ = lines_.number();
      error_.clear();
      if (Trimmed(line).empty() || Trimmed(line).front() == '#') continue;
      fields_.clear();
      if (line.find('"') == std::string_view::npos) {
        SplitPlain(line);
      } else {
        SplitQuoted(line);
      }
      if (!error_.empty()) return true;
      if (std::ranges::all_of(fields_, [](auto field) { return field.empty(); })) continue;
      return true;
    }
    return false;
  }

  int line() const { return line_; }  // where the record begins
  const std::vector<std::string_view>& fields() const { return fields_; }
  const std::string& error() const { return error_; }

 private:
  void SplitPlain(std::string_view line) {
    while (true) {
      const std::size_t comma = line.find(',');
      fields_.push_back(Trimmed(line.substr(0, comma)));
      if (comma == std::string_view::npos) return;
      line.remove_prefix(comma + 1);
    }
  }

  // A quoted field may hold line ends, so a record may be longer than its first line.
  void SplitQuoted(std::string_view line) {
    unquoted_.clear();
    const std::string_view from(line.data(),
                                lines_.rest().data() + lines_.rest().size() - line.data());
    std::size_t at = 0;
    do {
      at = TakeField(from, at);
      if (!error_.empty()) return;
    } while (at++ < from.size() && from[at - 1] == ',');
    // `at` stands behind the line end of the record, or one behind the text.
    at = std::min(at, from.size());
    const std::size_t first_line = from.size() - lines_.rest().size();
    if (at <= first_line) return;
    const std::string_view more = from.substr(first_line, at - first_line);
    lines_.Skip(more.size(), static_cast<int>(std::count(more.begin(), more.end(), '\n')));
  }

  // Takes the field that begins at `at`; where it ends: at a comma, a line end, or the text's end.
  std::size_t TakeField(std::string_view text, std::size_t at) {
    if (text.substr(at, 1) != "\"") {
      const std::size_t end = std::min(text.find_first_of(",\n\"", at), text.size());
      if (text.substr(end, 1) == "\"") error_ = "a quote inside an unquoted field";
      fields_.push_back(Trimmed(text.substr(at, end - at)));
      return end;
    }
    std::string& field = unquoted_.emplace_back();
    for (++at;; ++at) {
      const std::size_t quote = text.find('"', at);
      if (quote == std::string_view::npos) {
        error_ = "a quote is left open";
        return text.size();
      }
      field.append(text.substr(at, quote - at));
      at = quote + 1;
      if (text.substr(at, 1) != "\"") break;
      field.push_back('"');
    }
    fields_.push_back(field);
    if (text.substr(at, 2) == "\r\n") ++at;
    if (at < text.size() && text[at] != ',' && text[at] != '\n') {
      error_ = "text follows a closing quote";
    }
    return at;
  }

  TextLines lines_;
  int line_ = 0;
  std::vector<std::string_view> fields_;
  std::deque<std::string> unquoted_;  // of the record
  std::string error_;
};

// One table while it is read.
class Table {
 public:
  Table(const std::string& name, std::string_view text, std::span<const WantedColumn> columns)
      : name_(name), records_(text), columns_(columns) {
    for (const WantedColumn& column : columns) names_.push_back(column.name);
  }

  absl::Status ReadHeader() {
    if (!records_.Next()) {
      return absl::InvalidArgumentError(
          absl::StrCat(name_, ", line 1: the file is empty; a header line is expected"));
    }
    if (!records_.error().empty()) return Error(records_.error());
    const auto& header = records_.fields();
    width_ = header.size();
    for (std::size_t i = 0; i < width_; ++i) {
      if (double number; ParseNumber(header[i], number)) {
        return Error(absl::StrCat("the header line seems missing: '", std::string(header[i]),
                                  "' is a number, not the name of a column"));
      }
      if (!header[i].empty() && std::ranges::count(header, header[i]) > 1) {
        return Error(absl::StrCat("column ", std::string(header[i]), " occurs twice"));
      }
    }
    return FindColumns();
  }

  absl::Status Visit(LeftOut& left_out, const RowVisitor& visit) {
    RowPolicy policy(left_out);
    Row row(name_);
    row.SetNames(names_);
    while (records_.Next()) {
      row.Restart(records_.line());
      if (!records_.error().empty()) {
        row.SetMalformed(records_.error());
      } else if (records_.fields().size() != width_) {
        row.SetMalformed(
            absl::StrCat(records_.fields().size(), " fields; the header has ", width_));
      } else {
        TakeFields(row);
      }
      if (auto status = policy.Visit(row, visit); !status.ok()) return status;
    }
    return policy.Finish();
  }

 private:
  absl::Status FindColumns() {
    const auto& header = records_.fields();
    const auto has = [&](const WantedColumn& column) {
      return std::ranges::find(header, column.name) != header.end();
    };
    const bool any_optional = std::ranges::any_of(
        columns_, [&](const WantedColumn& column) { return column.optional && has(column); });
    for (const WantedColumn& column : columns_) {
      if (!has(column) && (!column.optional || any_optional)) return NoColumn(column.name);
      places_.push_back(
          static_cast<std::size_t>(std::ranges::find(header, column.name) - header.begin()));
    }
    return absl::OkStatus();
  }

  absl::Status NoColumn(const std::string& column) const {
    constexpr std::size_t kMaxBytes = 200;
    std::string there;
    for (const std::string_view name : records_.fields()) {
      there.append(there.empty() ? "" : ", ").append(name);
    }
    if (there.size() > kMaxBytes) there.replace(kMaxBytes, std::string::npos, "...");
    return Error(absl::StrCat("no column ", column, "; there are ", there));
  }

  void TakeFields(Row& row) const {
    for (const std::size_t place : places_) {
      if (place == width_) {
        row.Add({});
        continue;
      }
      const std::string_view field = records_.fields()[place];
      row.Add(field.data() != nullptr ? field : std::string_view(""));  // empty is not missing
    }
  }

  absl::Status Error(const std::string& why) const {
    return absl::InvalidArgumentError(absl::StrCat(name_, ", line ", records_.line(), ": ", why));
  }

  const std::string& name_;
  Records records_;
  std::span<const WantedColumn> columns_;
  std::vector<std::string> names_;
  std::vector<std::size_t> places_;  // of the wanted columns; width_ if there is none
  std::size_t width_ = 0;
};

}  // namespace

absl::Status VisitTable(const std::string& name, std::string_view text, const HeaderFormat& format,
                        std::span<const WantedColumn> columns, LeftOut& left_out,
                        const RowVisitor& visit) {
  if (auto status = CheckLastLine(name, text, format.last); !status.ok()) return status;
  Table table(name, text, columns);
  if (auto status = table.ReadHeader(); !status.ok()) return status;
  return table.Visit(left_out, visit);
}

absl::Status VisitTable(const std::filesystem::path& path, const HeaderFormat& format,
                        std::span<const WantedColumn> columns, LeftOut& left_out,
                        const RowVisitor& visit) {
  const absl::StatusOr<std::string> text = ReadTextFile(path, format.max_bytes);
  if (!text.ok()) return text.status();
  return VisitTable(path.string(), *text, format, columns, left_out, visit);
}

}  // namespace clearway
