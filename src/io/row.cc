#include "io/row.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"
#include "clearway/base/parse_number.h"
#include "clearway/geometry/unit_quaternion.h"
#include "clearway/io/world_origin.h"
#include "io/utf8.h"

namespace clearway {
namespace {

constexpr double kMaxSeconds = 4e9;  // in 2096; below kFarthest_ns

bool AllDigits(std::string_view text) {
  return text.find_first_not_of("0123456789") == std::string_view::npos;
}

// "1305031102.160407": a double would be off by 120 ns.
std::optional<std::int64_t> DecimalNanoseconds(std::string_view text) {
  constexpr std::size_t kDecimals = 9, kMaxDigits = 10;
  const std::size_t point = std::min(text.find('.'), text.size());
  std::string digits(text.substr(0, point));
  std::string decimals(point < text.size() ? text.substr(point + 1) : "");
  if (digits.empty() || digits.size() > kMaxDigits || !AllDigits(digits + decimals)) return {};
  decimals.resize(kDecimals, '0');
  digits += decimals;
  std::int64_t value = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), value);
  return value;
}

std::optional<std::int64_t> ParseInteger(std::string_view text) {
  constexpr double kMaxExact = 9e15;  // below 2^53
  std::int64_t integer = 0;
  if (ParseWhole(text, integer)) return integer;
  double number = 0;
  if (!ParseNumber(text, number) || !(std::abs(number) <= kMaxExact) ||
      number != std::floor(number)) {
    return std::nullopt;
  }
  return static_cast<std::int64_t>(number);
}

// What of a bad field is worth showing.
std::string Excerpt(std::string_view text) {
  constexpr std::size_t kMaxShown = 40;
  return std::string(text.substr(0, kMaxShown)) + (text.size() <= kMaxShown ? "" : "...");
}

}  // namespace

std::string Row::where() const { return absl::StrCat(*file_, ", line ", line_); }

std::string Row::NameOf(std::size_t i) const {
  return names_.empty() ? absl::StrCat("word ", i + 1) : absl::StrCat("column ", names_[i]);
}

std::string Row::Named(std::size_t first, std::size_t last) const {
  return names_.empty() ? absl::StrCat("words ", first + 1, " to ", last + 1)
                        : absl::StrCat("columns ", names_[first], " to ", names_[last]);
}

std::string Row::PlainText(std::size_t i) {
  constexpr std::size_t kMaxBytes = 200;
  if (!IsPlainText(fields_[i])) Fail(i, "text in UTF-8 without control characters");
  if (fields_[i].size() > kMaxBytes) Fail(i, absl::StrCat("text of at most ", kMaxBytes, " bytes"));
  return std::string(fields_[i]);
}

double Row::Number(std::size_t i) {
  double value = 0;
  const bool is_number = ParseNumber(fields_[i], value);
  if (!is_number && !fields_[i].empty()) malformed_ = true;
  if (!is_number || !std::isfinite(value)) Fail(i, "a finite number");
  return value;
}

double Row::NumberBetween(std::size_t i, double min, double max) {
  const double value = Number(i);
  if (!(min <= value && value <= max)) {
    Fail(i, absl::StrCat("a number from ", NumberText(min), " to ", NumberText(max)));
  }
  return value;
}

double Row::NumberWithin(std::size_t i, double limit) { return NumberBetween(i, -limit, limit); }

double Row::Coordinate(std::size_t i) { return NumberWithin(i, kMaxFileCoordinate_m); }

double Row::Positive(std::size_t i) {
  const double value = Number(i);
  if (!(value > 0)) Fail(i, "a number above 0");
  return value;
}

std::int64_t Row::Integer(std::size_t i, std::int64_t min, std::int64_t max) {
  double number = 0;
  if (!ParseNumber(fields_[i], number) && !fields_[i].empty()) malformed_ = true;
  const auto value = ParseInteger(fields_[i]);
  if (value && *value >= min && *value <= max) return *value;
  Fail(i, absl::StrCat("an integer from ", min, " to ", max));
  return min;
}

Time Row::Stamp(std::size_t i) {
  double seconds = 0;
  const bool is_number = ParseNumber(fields_[i], seconds);
  if (!is_number && !fields_[i].empty()) malformed_ = true;
  if (!is_number || !(seconds >= 0 && seconds <= kMaxSeconds)) {
    Fail(i, absl::StrCat("a time from 0 to ", NumberText(kMaxSeconds), " s"));
    return Time();
  }
  const auto exactly = DecimalNanoseconds(fields_[i]);
  return exactly ? TimeFromNanoseconds(*exactly) : Time(FromSeconds(seconds));
}

Pose Row::PoseFrom(std::size_t i) {
  const Eigen::Vector3d translation(Coordinate(i), Coordinate(i + 1), Coordinate(i + 2));
  const double x = Number(i + 3), y = Number(i + 4), z = Number(i + 5);
  const Eigen::Quaterniond rotation(Number(i + 6), x, y, z);
  if (status_.ok() && !IsNearlyUnit(rotation)) {
    status_ = Error(absl::StrCat(Named(i + 3, i + 6), ": the quaternion ", NotUnitText(rotation)));
  }
  if (!status_.ok()) return Pose();
  return {rotation.normalized(), translation};
}

void Row::CheckNumbers(std::size_t first, std::size_t end) {
  for (std::size_t i = first; i < end; ++i) {
    double ignored = 0;
    if (ParseNumber(fields_[i], ignored)) continue;
    malformed_ = true;
    Fail(i, "a number");
  }
}

void Row::Fail(std::size_t i, const std::string& expected) {
  if (!status_.ok()) return;
  status_ = absl::InvalidArgumentError(
      absl::StrCat(where(), ", ", NameOf(i), ": '", Excerpt(fields_[i]), "' is not ", expected));
}

absl::Status Row::Error(const std::string& why) const {
  return absl::InvalidArgumentError(absl::StrCat(where(), ": ", why));
}

absl::Status Row::WrongCount(const std::string& expected) {
  SetMalformed(absl::StrCat(size(), " words, expected ", expected));
  return status_;
}

void Row::Restart(int line) {
  line_ = line;
  fields_.clear();
  status_ = absl::OkStatus();
  malformed_ = false;
}

void Row::SetMalformed(const std::string& why) {
  malformed_ = true;
  if (status_.ok()) status_ = Error(why);
}

}  // namespace clearway
