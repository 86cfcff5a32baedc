#include "cli/values.h"

#include <cmath>

#include "absl/strings/ascii.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "clearway/base/parse_number.h"

namespace clearway::cli {
namespace {

constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
constexpr std::int64_t kMaxSeconds = 9'000'000'000;  // below 2^63 ns

bool AllDigits(const std::string& text) {
  for (const char c : text) {
    if (!absl::ascii_isdigit(static_cast<unsigned char>(c))) return false;
  }
  return true;
}

absl::Status Expected(const std::string& what, const std::string& text) {
  return absl::InvalidArgumentError(absl::StrCat("expected ", what, ", not '", text, "'"));
}

absl::StatusOr<Aabb> BoxOfCorners(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return Aabb{a.cwiseMin(b), a.cwiseMax(b)};
}

}  // namespace

absl::StatusOr<Duration> ParseSeconds(const std::string& text) {
  std::string digits = text;
  const bool negative = !digits.empty() && digits.front() == '-';
  if (!digits.empty() && (digits.front() == '-' || digits.front() == '+')) digits.erase(0, 1);
  // Read as decimal digits: a double cannot hold the nanoseconds of today's stamps.
  const std::size_t point = digits.find('.');
  const std::string whole = digits.substr(0, point);
  std::string decimals = point == std::string::npos ? "" : digits.substr(point + 1);
  std::int64_t seconds = 0, nanoseconds = 0;
  const bool well_formed = !(whole.empty() && decimals.empty()) && AllDigits(whole) &&
                           AllDigits(decimals) && decimals.size() <= 9;
  decimals.resize(9, '0');
  if (!well_formed || (!whole.empty() && !absl::SimpleAtoi(whole, &seconds)) ||
      !absl::SimpleAtoi(decimals, &nanoseconds) || seconds > kMaxSeconds) {
    return Expected("seconds such as 1.5 (no exponent, at most nine decimals and 9000000000)",
                    text);
  }
  const Duration magnitude(seconds * kNanosecondsPerSecond + nanoseconds);
  return negative ? -magnitude : magnitude;
}

absl::StatusOr<TimeArgument> ParseTime(const std::string& text) {
  if (text == "now") return TimeArgument{};
  const bool from_now = text.starts_with("now+") || text.starts_with("now-");
  const bool relative = from_now || text.starts_with("+");
  const auto offset = ParseSeconds(from_now ? text.substr(3) : text);
  if (!offset.ok()) {
    return Expected(
        "seconds of sensor time (12.5), or after the newest stamp (+1.5, now-2), without an "
        "exponent, at most nine decimals and 9000000000 either way",
        text);
  }
  return TimeArgument{relative, *offset};
}

absl::StatusOr<double> ParseFinite(const std::string& text) {
  const auto number = absl::StripAsciiWhitespace(text);
  double value = 0;
  if (!ParseNumber({number.data(), number.size()}, value) || !std::isfinite(value)) {
    return Expected("a finite number", text);
  }
  return value;
}

absl::StatusOr<std::vector<double>> ParseNumbers(const std::string& text) {
  std::vector<double> numbers;
  for (const auto field : absl::StrSplit(text, ',')) {
    const auto number = ParseFinite(std::string(field));
    if (!number.ok()) return Expected("numbers with commas between them", text);
    numbers.push_back(*number);
  }
  return numbers;
}

absl::StatusOr<Eigen::Vector3d> ParsePoint(const std::string& text) {
  const auto n = ParseNumbers(text);
  if (!n.ok() || n->size() != 3) return Expected("x,y,z in metres", text);
  return Eigen::Vector3d((*n)[0], (*n)[1], (*n)[2]);
}

absl::StatusOr<Aabb> ParseBox(const std::string& text) {
  const auto n = ParseNumbers(text);
  if (!n.ok() || n->size() != 6) return Expected("x0,y0,z0,x1,y1,z1 in metres", text);
  return BoxOfCorners({(*n)[0], (*n)[1], (*n)[2]}, {(*n)[3], (*n)[4], (*n)[5]});
}

absl::StatusOr<Aabb> ParseOrderedBox(const std::string& text) {
  const auto n = ParseNumbers(text);
  if (!n.ok() || n->size() != 6) return Expected("x0,y0,z0,x1,y1,z1 in metres", text);
  for (std::size_t i = 0; i < 3; ++i) {
    if ((*n)[i] <= (*n)[i + 3]) continue;
    const char axis = "xyz"[i];
    return absl::InvalidArgumentError(absl::StrCat("'", text, "': ", std::string(1, axis),
                                                   "0 must not exceed ", std::string(1, axis),
                                                   "1; give the lowest corner first"));
  }
  return Aabb{{(*n)[0], (*n)[1], (*n)[2]}, {(*n)[3], (*n)[4], (*n)[5]}};
}

absl::StatusOr<Aabb> ParseSolidBox(const std::string& text) {
  auto box = ParseOrderedBox(text);
  for (int axis = 0; box.ok() && axis < 3; ++axis) {
    if (box->min[axis] < box->max[axis]) continue;
    return absl::InvalidArgumentError(absl::StrCat("'", text, "': the box has no extent along ",
                                                   std::string(1, "xyz"[axis]),
                                                   "; it would keep nothing out"));
  }
  return box;
}

absl::StatusOr<Aabb> ParseArea(const std::string& text) {
  const auto n = ParseNumbers(text);
  if (!n.ok() || n->size() != 4) return Expected("x0,y0,x1,y1 in metres", text);
  return BoxOfCorners({(*n)[0], (*n)[1], 0}, {(*n)[2], (*n)[3], 0});
}

}  // namespace clearway::cli
