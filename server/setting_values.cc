#include "server/setting_values.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "absl/strings/ascii.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_replace.h"
#include "absl/strings/str_split.h"
#include "clearway/base/parse_number.h"

namespace clearway {
namespace {

absl::Status Bad(const std::string& text, const char* wanted) {
  return absl::InvalidArgumentError(absl::StrCat("\"", text, "\" is not ", wanted));
}

}  // namespace

bool ParseBlankedNumber(const std::string& text, double& value) {
  const auto number = absl::StripAsciiWhitespace(text);
  return ParseNumber({number.data(), number.size()}, value);
}

absl::Status ParseValue(const std::string& text, std::string& value) {
  value = text;
  return absl::OkStatus();
}
absl::Status ParseValue(const std::string& text, bool& value) {
  return absl::SimpleAtob(text, &value) ? absl::OkStatus() : Bad(text, "true or false");
}
absl::Status ParseValue(const std::string& text, double& value) {
  return ParseBlankedNumber(text, value) && std::isfinite(value) ? absl::OkStatus()
                                                                 : Bad(text, "a number");
}
absl::Status ParseValue(const std::string& text, int& value) {
  return absl::SimpleAtoi(text, &value) ? absl::OkStatus() : Bad(text, "a whole number");
}
absl::Status ParseValue(const std::string& text, std::uint64_t& value) {
  return absl::SimpleAtoi(text, &value) ? absl::OkStatus()
                                        : Bad(text, "a whole number that is not negative");
}
absl::Status ParseValue(const std::string& text, Duration& value) {
  double seconds = 0;
  constexpr double kLimit_s = 1e9;  // FromSeconds takes less than 9.2e9
  if (!ParseBlankedNumber(text, seconds) || !(std::abs(seconds) <= kLimit_s)) {
    return Bad(text, "a time in seconds of at most 1e9 either way");
  }
  value = FromSeconds(seconds);
  return absl::OkStatus();
}
absl::Status ParseValue(const std::string& text, SolidMode& value) {
  const auto name = std::ranges::find(kSolidModeNames, text);
  if (name == kSolidModeNames.end()) return Bad(text, "convex_hull, completed_hull or voxels");
  value = static_cast<SolidMode>(name - kSolidModeNames.begin());
  return absl::OkStatus();
}
absl::Status ParseValue(const std::string& text, MotionModel& value) {
  if (text != "last" && text != "track") return Bad(text, "last or track");
  value = text == "track" ? MotionModel::kTrack : MotionModel::kLastMotion;
  return absl::OkStatus();
}
absl::Status ParseValue(const std::string& text, MotionFromPoints& value) {
  const auto name = std::ranges::find(kMotionFromPointsNames, text);
  if (name == kMotionFromPointsNames.end()) return Bad(text, "auto, on or off");
  value = static_cast<MotionFromPoints>(name - kMotionFromPointsNames.begin());
  return absl::OkStatus();
}
absl::Status ParseValue(const std::string& text, std::vector<Aabb>& boxes) {
  std::vector<double> numbers;
  for (const auto& part : absl::StrSplit(text, absl::ByAnyChar(" ,;[]"), absl::SkipEmpty())) {
    if (!ParseNumber({part.data(), part.size()}, numbers.emplace_back()))
      return Bad(text, "a list of numbers");
  }
  if (numbers.size() % 6 != 0) return Bad(text, "a list of six numbers a box: minimum, maximum");
  boxes.clear();
  for (std::size_t i = 0; i < numbers.size(); i += 6) {
    const double* n = &numbers[i];
    boxes.push_back({{n[0], n[1], n[2]}, {n[3], n[4], n[5]}});
    const Aabb& box = boxes.back();
    if (!box.min.allFinite() || !box.max.allFinite() ||
        (box.min.array() >= box.max.array()).any()) {
      return Bad(text, "finite, with each minimum below its maximum");
    }
  }
  return absl::OkStatus();
}
absl::Status ParseValue(const std::string& text, Aabb& box) {
  std::vector<Aabb> boxes;
  if (auto status = ParseValue(text, boxes); !status.ok()) return status;
  if (boxes.size() != 1) return Bad(text, "six numbers: minimum, maximum");
  box = boxes.front();
  return absl::OkStatus();
}

std::string ValueText(const std::string& value) {
  return absl::StrCat("\"", absl::StrReplaceAll(value, {{"\\", "\\\\"}, {"\"", "\\\""}}), "\"");
}
std::string ValueText(bool value) { return value ? "true" : "false"; }
std::string ValueText(double value) {
  char text[32];  // the shortest text that reads as the same number
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return std::string(text, end);
}
std::string ValueText(int value) { return std::to_string(value); }
std::string ValueText(std::uint64_t value) { return std::to_string(value); }
std::string ValueText(Duration value) { return ValueText(ToSeconds(value)); }
std::string ValueText(SolidMode value) {
  return ValueText(std::string(kSolidModeNames[static_cast<std::size_t>(value)]));
}
std::string ValueText(MotionModel value) {
  return ValueText(std::string(value == MotionModel::kTrack ? "track" : "last"));
}
std::string ValueText(MotionFromPoints value) {
  return ValueText(std::string(kMotionFromPointsNames[static_cast<std::size_t>(value)]));
}
std::string ValueText(const Aabb& box) {
  std::vector<std::string> numbers;
  for (double number :
       {box.min.x(), box.min.y(), box.min.z(), box.max.x(), box.max.y(), box.max.z()}) {
    numbers.push_back(ValueText(number));
  }
  return absl::StrCat("[", absl::StrJoin(numbers, ", "), "]");
}
std::string ValueText(const std::vector<Aabb>& boxes) {
  std::vector<std::string> texts;
  for (const Aabb& box : boxes) texts.push_back(ValueText(box));
  return absl::StrCat("[", absl::StrJoin(texts, ", "), "]");
}

}  // namespace clearway
