#include "clearway/geometry/unit_quaternion.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"

namespace clearway {

bool IsNearlyUnit(const Eigen::Quaterniond& q) { return std::abs(q.norm() - 1) <= kUnitTolerance; }

std::string NotUnitText(const Eigen::Quaterniond& q) {
  return absl::StrCat("has length ", NumberText(q.norm()),
                      "; a unit quaternion is needed, to within ", NumberText(kUnitTolerance));
}

Eigen::Quaterniond Normalized(const Eigen::Quaterniond& q) {
  constexpr double kRounding = 1e-14;
  return std::abs(q.squaredNorm() - 1) <= kRounding ? q : q.normalized();
}

Pose Normalized(const Pose& pose) { return {Normalized(pose.rotation), pose.translation}; }

std::optional<std::vector<Pose>> Renormalized(std::span<const Pose> poses) {
  const auto is_unit = [](const Pose& pose) { return Normalized(pose) == pose; };
  if (std::ranges::all_of(poses, is_unit)) return std::nullopt;
  std::vector<Pose> normalized;
  normalized.reserve(poses.size());
  for (const Pose& pose : poses) normalized.push_back(Normalized(pose));
  return normalized;
}

}  // namespace clearway
