#include "io/number_rows.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "clearway/io/world_origin.h"
#include "io/file.h"
#include "io/no_column.h"

namespace clearway {
namespace {

template <class T>
bool ParseWhole(std::string_view text, T& value) {
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && rest == end;
}

// What of a bad field is worth showing.
std::string Excerpt(std::string_view text) {
  return std::string(text.substr(0, 40)) + (text.size() <= 40 ? "" : "...");
}

// Takes the text before the separator off, and the separator.
std::string_view TakeUpTo(char separator, std::string_view& rest) {
  const std::size_t end = std::min(rest.find(separator), rest.size());
  const std::string_view taken = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return taken;
}

void Split(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  const auto commas = std::ranges::count(line, ',');
  for (auto i = commas; i >= 0; --i) fields.push_back(TakeUpTo(',', line));
}

}  // namespace

double NumberRow::Number(std::size_t i) {
  double value = 0;
  if (!ParseWhole(fields_[i], value) || !std::isfinite(value)) Fail(i, "a finite number");
  return value;
}

std::int64_t NumberRow::Integer(std::size_t i, std::int64_t min, std::int64_t max) {
  std::int64_t value = 0;
  if (!ParseWhole(fields_[i], value) || value < min || value > max) {
    Fail(i, absl::StrCat("an integer from ", min, " to ", max));
  }
  return value;
}

Pose NumberRow::PoseFrom(std::size_t i) {
  constexpr double kFarthest_m = kMaxFileCoordinate_m, kUnitTolerance = 0.01;
  Pose pose{{Number(i + 6), Number(i + 3), Number(i + 4), Number(i + 5)},
            {Number(i), Number(i + 1), Number(i + 2)}};
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(pose.translation[axis]) > kFarthest_m)
      Fail(i + axis, absl::StrCat("within ", kFarthest_m, " m"));
  }
  const double length = pose.rotation.norm();
  if (status_.ok() && !(std::abs(length - 1) <= kUnitTolerance)) {
    status_ = Error(absl::StrCat("columns ", columns_[i + 3].name, " to ", columns_[i + 6].name,
                                 " are no unit quaternion, its length is ", length));
  }
  if (!status_.ok()) return Pose();
  pose.rotation.normalize();
  return pose;
}

absl::Status NumberRow::Error(const std::string& why) const {
  return absl::InvalidArgumentError(absl::StrCat(file_, ", line ", line_, ": ", why));
}

void NumberRow::Fail(std::size_t i, const std::string& expected) {
  if (!status_.ok()) return;
  status_ = absl::InvalidArgumentError(absl::StrCat(file_, ", line ", line_, ", column ",
                                                    columns_[i].name, ": '", Excerpt(fields_[i]),
                                                    "' is not ", expected));
}

// One table while it is read.
class NumberTable {
 public:
  NumberTable(const std::string& file, std::string_view text, std::span<const NumberColumn> columns)
      : rest_(text) {
    row_.file_ = file;
    row_.columns_ = columns;
    row_.fields_.resize(columns.size());
  }

  absl::Status ReadHeader() {
    const bool is_empty = rest_.empty();
    TakeLine();
    if (is_empty) return row_.Error("the file is empty; a header line is expected");
    width_ = fields_.size();
    for (const NumberColumn& column : row_.columns_) {
      const auto found = std::ranges::find(fields_, column.name);
      if (found == fields_.end() && !column.optional) {
        return row_.Error(NoColumn(column.name, fields_));
      }
      places_.push_back(static_cast<std::size_t>(found - fields_.begin()));
    }
    return absl::OkStatus();
  }

  absl::Status Visit(const RowVisitor& visit) {
    while (!rest_.empty()) {
      TakeLine();
      if (fields_.size() != width_) {
        return row_.Error(absl::StrCat(fields_.size(), " fields; the header has ", width_));
      }
      for (std::size_t i = 0; i < places_.size(); ++i) {
        if (places_[i] < width_) row_.fields_[i] = fields_[places_[i]];
      }
      absl::Status status = visit(row_);
      status.Update(row_.status());
      if (!status.ok()) return status;
    }
    return absl::OkStatus();
  }

 private:
  void TakeLine() {
    ++row_.line_;
    std::string_view line = TakeUpTo('\n', rest_);
    if (line.ends_with('\r')) line.remove_suffix(1);
    Split(line, fields_);
  }

  std::string_view rest_;
  std::vector<std::string_view> fields_;  // of the line
  std::size_t width_ = 0;
  std::vector<std::size_t> places_;  // of the wanted columns; width_ if there is none
  NumberRow row_;
};

absl::Status VisitRows(const std::filesystem::path& path, std::uint64_t max_bytes,
                       std::span<const NumberColumn> columns, const RowVisitor& visit) {
  const auto text = ReadWholeFile(path, max_bytes);
  if (!text.ok()) return text.status();
  NumberTable table(path.string(), *text, columns);
  if (auto status = table.ReadHeader(); !status.ok()) return status;
  return table.Visit(visit);
}

}  // namespace clearway
