#include "cli/text.h"

#include <cmath>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_replace.h"

namespace clearway::cli {

std::string Fixed(double value, int decimals) { return absl::StrFormat("%.*f", decimals, value); }

std::string FixedOrDash(double value, int decimals) {
  return std::isnan(value) ? "-" : Fixed(value, decimals);
}

std::string Grouped(std::uint64_t count) {
  if (count < 1000) return absl::StrCat(count);
  return absl::StrCat(Grouped(count / 1000), ",", absl::Dec(count % 1000, absl::kZeroPad3));
}

std::string Scaled(double value) {
  if (value < 999.5) return absl::StrFormat("%.*f", value < 99.95 && value > 0 ? 1 : 0, value);
  if (value < 999.5e3) return absl::StrFormat("%.3g k", value / 1e3);
  if (value < 999.5e6) return absl::StrFormat("%.3g M", value / 1e6);
  return absl::StrFormat("%.3g G", value / 1e9);
}

std::string Bytes(std::uint64_t bytes) {
  if (bytes < 1000) return absl::StrCat(bytes, " B");
  if (bytes < 1'000'000) return absl::StrFormat("%.1f kB", static_cast<double>(bytes) / 1e3);
  return absl::StrFormat("%.1f MB", static_cast<double>(bytes) / 1e6);
}

std::string Seconds(Duration duration) {
  const std::int64_t ns = duration.count();
  const std::uint64_t magnitude = ns < 0 ? 0 - static_cast<std::uint64_t>(ns) : ns;
  std::string decimals = absl::StrFormat("%09d", magnitude % 1'000'000'000);
  while (decimals.size() > 1 && decimals.back() == '0') decimals.pop_back();
  return absl::StrCat(ns < 0 ? "-" : "", magnitude / 1'000'000'000, ".", decimals, " s");
}

std::string Seconds(Time time) { return Seconds(time.time_since_epoch()); }

std::string Clock(double seconds) {
  const auto total = static_cast<std::int64_t>(std::ceil(std::max(seconds, 0.0)));
  const std::int64_t hours = total / 3600, minutes = total / 60 % 60, rest = total % 60;
  if (hours > 0) return absl::StrFormat("%d:%02d:%02d", hours, minutes, rest);
  return absl::StrFormat("%d:%02d", minutes, rest);
}

std::string Point(const Eigen::Vector3d& p, int decimals) {
  return absl::StrFormat("(%.*f, %.*f, %.*f)", decimals, p.x(), decimals, p.y(), decimals, p.z());
}

std::string Size(const Eigen::Vector3d& size) {
  if (size.isZero()) return "-";
  return absl::StrFormat("%.2f x %.2f x %.2f m", size.x(), size.y(), size.z());
}

std::string Plural(std::uint64_t count, const std::string& noun) {
  return absl::StrCat(Grouped(count), " ", noun, count == 1 ? "" : "s");
}

std::string ShellQuoted(const std::string& word) {
  constexpr char kPlain[] =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+./:,=@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  return absl::StrCat("'", absl::StrReplaceAll(word, {{"'", R"('\'')"}}), "'");
}

}  // namespace clearway::cli
