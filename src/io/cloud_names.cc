#include "io/cloud_names.h"

#include <algorithm>
#include <string_view>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "clearway/base/parse_number.h"

namespace clearway {
namespace {

using Path = std::filesystem::path;

bool IsDigit(char c) { return absl::ascii_isdigit(static_cast<unsigned char>(c)); }

// A name's end: digits, or digits, a point and digits.
struct Ending {
  std::string prefix, whole, decimals;
  bool has_point = false;
};

std::optional<Ending> EndingOf(const std::string& stem) {
  const auto digits_before = [&](std::size_t end) {
    std::size_t begin = end;
    while (begin > 0 && IsDigit(stem[begin - 1])) --begin;
    return begin;
  };
  Ending ending;
  std::size_t begin = digits_before(stem.size());
  ending.whole = stem.substr(begin);
  if (ending.whole.empty()) return std::nullopt;
  if (begin > 1 && stem[begin - 1] == '.' && IsDigit(stem[begin - 2])) {
    ending.has_point = true;
    ending.decimals = ending.whole;
    const std::size_t point = begin - 1;
    begin = digits_before(point);
    ending.whole = stem.substr(begin, point - begin);
  }
  ending.prefix = stem.substr(0, begin);
  return ending;
}

std::optional<std::int64_t> Number(const std::string& digits) {
  std::int64_t value = 0;
  return ParseWhole(digits, value) ? std::optional(value) : std::nullopt;
}

std::optional<Time> StampOf(const Ending& ending) {
  constexpr std::size_t kDecimals = 9, kSecondsDigits = 10;
  std::string digits = ending.whole + ending.decimals;
  if (!ending.has_point) {
    const std::size_t decimals = digits.size() - std::min(digits.size(), kSecondsDigits);
    if (digits.size() < kSecondsDigits || decimals % 3 != 0) return std::nullopt;
    digits.resize(kSecondsDigits + kDecimals, '0');
  } else {
    digits.resize(ending.whole.size() + kDecimals, '0');  // cuts off what is finer
  }
  const auto nanoseconds = Number(digits);
  if (!nanoseconds || *nanoseconds > kFarthest_ns) return std::nullopt;
  return TimeFromNanoseconds(*nanoseconds);
}

std::vector<std::int64_t> NumbersOf(const std::vector<NamedCloud>& clouds) {
  std::vector<std::int64_t> numbers;
  for (const NamedCloud& cloud : clouds) numbers.push_back(cloud.number);
  std::ranges::sort(numbers);
  return numbers;
}

// Whether these ascending whole numbers, all with zeros in front, count clouds: as times they would
// be 1970's, and a unit or two apart.
bool AreCounts(const std::vector<std::int64_t>& ascending) {
  if (ascending.empty()) return false;
  const auto steps = static_cast<std::int64_t>(ascending.size()) - 1;
  return ascending.back() - ascending.front() <= 2 * steps;
}

// Sets stamps or numbers if all names have them.
CloudNaming Read(std::vector<NamedCloud>& clouds) {
  bool stamps = true, numbers = true, padded = true;
  std::optional<std::string> prefix;
  for (NamedCloud& cloud : clouds) {
    const auto ending = EndingOf(cloud.path.stem().string());
    if (!ending || ending->prefix != prefix.value_or(ending->prefix)) return CloudNaming::kOther;
    prefix = ending->prefix;
    const auto stamp = StampOf(*ending);
    const auto number = ending->has_point ? std::nullopt : Number(ending->whole);
    stamps &= stamp.has_value();
    numbers &= number.has_value();
    padded &= ending->whole.starts_with('0');
    cloud.stamp = stamp.value_or(Time());
    cloud.number = number.value_or(-1);
  }
  if (stamps && numbers && padded && AreCounts(NumbersOf(clouds))) return CloudNaming::kNumbers;
  return stamps ? CloudNaming::kStamps : numbers ? CloudNaming::kNumbers : CloudNaming::kOther;
}

}  // namespace

bool NaturallyBefore(const std::string& a, const std::string& b) {
  std::size_t i = 0, j = 0;
  const auto run = [](const std::string& text, std::size_t& at) {
    while (at < text.size() && text[at] == '0') ++at;
    const std::size_t begin = at;
    while (at < text.size() && IsDigit(text[at])) ++at;
    return std::string_view(text).substr(begin, at - begin);
  };
  while (i < a.size() && j < b.size()) {
    if (IsDigit(a[i]) && IsDigit(b[j])) {
      const std::string_view x = run(a, i), y = run(b, j);
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
    } else {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
    }
  }
  if ((i < a.size()) != (j < b.size())) return j < b.size();
  return a < b;  // alike but for zeros in front
}

absl::StatusOr<NamedClouds> NameClouds(std::vector<Path> paths) {
  std::ranges::sort(paths, [](const Path& a, const Path& b) {
    return NaturallyBefore(a.filename().string(), b.filename().string());
  });
  NamedClouds named;
  for (Path& path : paths) named.clouds.push_back({.path = std::move(path)});
  named.naming = Read(named.clouds);
  if (named.naming == CloudNaming::kOther) return named;
  const auto key = [&](const NamedCloud& cloud) {
    return named.naming == CloudNaming::kStamps ? ToNanoseconds(cloud.stamp) : cloud.number;
  };
  std::ranges::stable_sort(named.clouds, {}, key);
  const auto twice = std::ranges::adjacent_find(named.clouds, {}, key);
  if (twice == named.clouds.end()) return named;
  return absl::InvalidArgumentError(absl::StrCat(twice->path.string(), " and ",
                                                 std::next(twice)->path.filename().string(),
                                                 ": two clouds of one number"));
}

absl::StatusOr<CloudRows> RowsOf(const NamedClouds& named, std::size_t rows,
                                 const std::string& folder) {
  const std::vector<NamedCloud>& clouds = named.clouds;
  const auto count = static_cast<std::int64_t>(rows);
  // Numbers are those of rows, counted from 0, if one of them is 0 or all are below their count.
  const bool numbered = named.naming == CloudNaming::kNumbers &&
                        (clouds.front().number == 0 || clouds.back().number < count);
  if (!numbered && clouds.size() != rows) {
    return absl::InvalidArgumentError(absl::StrCat(
        folder, ": ", clouds.size(), " clouds, but ", rows,
        " poses, and the clouds' names do not tell which is whose; name each by its pose's row, "
        "counted from 0, or by its stamp"));
  }
  CloudRows result;
  result.by_number = numbered;
  result.of_clouds.resize(clouds.size());
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    const std::size_t row = numbered ? static_cast<std::size_t>(clouds[i].number) : i;
    if (row < rows) result.of_clouds[i] = row;
  }
  return result;
}

}  // namespace clearway
