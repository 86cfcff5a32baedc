#include "io/word_lines.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "clearway/io/world_origin.h"
#include "io/file.h"

namespace clearway {
namespace {

constexpr std::uint64_t kMaxBytes = 1 << 28;
constexpr double kMostSeconds = 4e9;  // in 2096; below kFarthest_ns

bool AllDigits(std::string_view text) {
  return text.find_first_not_of("0123456789") == std::string_view::npos;
}

// "1305031102.160407": a double would be off by 120 ns.
std::optional<std::int64_t> DecimalNanoseconds(const std::string& text) {
  constexpr std::size_t kDecimals = 9, kMostDigits = 10;
  const std::size_t point = std::min(text.find('.'), text.size());
  std::string digits = text.substr(0, point);
  std::string decimals = point < text.size() ? text.substr(point + 1) : "";
  if (digits.empty() || digits.size() > kMostDigits || !AllDigits(digits + decimals)) return {};
  decimals.resize(kDecimals, '0');
  digits += decimals;
  std::int64_t value = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), value);
  return value;
}

}  // namespace

double Words::Number(std::size_t i) {
  constexpr double kMostOfAny = kMaxFileCoordinate_m;
  double value = 0;
  if (!absl::SimpleAtod(words_[i], &value) || !(std::abs(value) <= kMostOfAny)) {
    Fail(i, absl::StrCat("a number within ", kMostOfAny));
  }
  return value;
}

double Words::Positive(std::size_t i) {
  const double value = Number(i);
  if (!(value > 0)) Fail(i, "a number above 0");
  return value;
}

int Words::Integer(std::size_t i, int min, int max) {
  int value = 0;
  if (!absl::SimpleAtoi(words_[i], &value) || value < min || value > max) {
    Fail(i, absl::StrCat("an integer from ", min, " to ", max));
  }
  return value;
}

Time Words::Stamp(std::size_t i) {
  double seconds = 0;
  if (!absl::SimpleAtod(words_[i], &seconds) || !(seconds >= 0 && seconds <= kMostSeconds)) {
    Fail(i, absl::StrCat("seconds from 0 to ", kMostSeconds));
    return Time();
  }
  const auto exactly = DecimalNanoseconds(words_[i]);
  return exactly ? TimeFromNanoseconds(*exactly) : Time(FromSeconds(seconds));
}

Pose Words::PoseFrom(std::size_t i) {
  constexpr double kUnitTolerance = 0.01;
  Pose pose{{Number(i + 6), Number(i + 3), Number(i + 4), Number(i + 5)},
            {Number(i), Number(i + 1), Number(i + 2)}};
  const double length = pose.rotation.norm();
  if (!(std::abs(length - 1) <= kUnitTolerance) && status_.ok()) {
    status_ = absl::InvalidArgumentError(
        absl::StrCat(where_, ", words ", i + 4, " to ", i + 7,
                     ": no unit quaternion x y z w, its length is ", length));
  }
  if (!status_.ok()) return Pose();
  pose.rotation.normalize();
  return pose;
}

void Words::Fail(std::size_t i, const std::string& expected) {
  if (!status_.ok()) return;
  status_ = absl::InvalidArgumentError(
      absl::StrCat(where_, ", word ", i + 1, ": '", words_[i], "', expected ", expected));
}

absl::Status WrongCount(const Words& line, const std::string& expected) {
  return absl::InvalidArgumentError(
      absl::StrCat(line.where(), ": ", line.size(), " words, expected ", expected));
}

absl::StatusOr<std::vector<Words>> ReadWordLines(const std::filesystem::path& path, LastLine last,
                                                 Comments comments) {
  const auto text = ReadWholeFile(path, kMaxBytes);
  if (!text.ok()) return text.status();
  if (last == LastLine::kEnds && !text->empty() && text->back() != '\n') {
    return absl::InvalidArgumentError(
        absl::StrCat(path.string(), ": the last line does not end; the file seems cut off"));
  }
  std::vector<Words> lines;
  int number = 0;
  for (absl::string_view line : absl::StrSplit(*text, '\n')) {
    ++number;
    if (comments == Comments::kHash) line = line.substr(0, line.find('#'));
    std::vector<std::string> words =
        absl::StrSplit(line, absl::ByAnyChar(" \t\r"), absl::SkipEmpty());
    if (words.empty()) continue;
    lines.emplace_back(absl::StrCat(path.string(), ", line ", number), std::move(words));
  }
  return lines;
}

std::string_view TakeWord(std::string_view& line) {
  constexpr std::string_view kBlank = " \t\r";
  line.remove_prefix(std::min(line.find_first_not_of(kBlank), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(kBlank));
  line.remove_prefix(word.size());
  return word;
}

}  // namespace clearway
