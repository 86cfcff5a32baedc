#include "io/stereo_pair.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"

namespace clearway {
namespace {

using Projection = StereoPair::Projection;

constexpr double kLeastDisparity_px = 1, kLeastBaseline_m = 1e-4;

bool IsPinhole(const Projection& projection) {
  constexpr double kTolerance = 1e-6;
  const auto is_focal_length = [](double f_px) { return f_px >= 1 && f_px <= 1e6; };
  return projection.allFinite() && is_focal_length(projection(0, 0)) &&
         is_focal_length(projection(1, 1)) &&
         projection.row(2).head<3>().isApprox(Eigen::RowVector3d::UnitZ(), kTolerance) &&
         std::abs(projection(1, 0)) <= kTolerance;
}

Eigen::Vector3d CenterOf(const Projection& projection) {
  return -projection.leftCols<3>().inverse() * projection.col(3);
}

}  // namespace

absl::StatusOr<StereoPair> StereoPair::Make(const Projection& left, const Projection& right,
                                            const std::string& where) {
  for (const auto& [name, projection] : {std::pair("first", &left), std::pair("second", &right)}) {
    if (IsPinhole(*projection)) continue;
    return absl::InvalidArgumentError(absl::StrCat(
        where, ": the ", name,
        " matrix is no pinhole's that looks along z: f x, 0, c x; 0, f y, c y; 0, 0, 1, "
        "with f x and f y from 1 to 1000000"));
  }
  const double baseline_m = (CenterOf(right) - CenterOf(left)).norm();
  if (!(baseline_m >= kLeastBaseline_m)) {
    return absl::InvalidArgumentError(absl::StrCat(where, ": the cameras are ",
                                                   NumberText(baseline_m), " m apart; at least ",
                                                   NumberText(kLeastBaseline_m), " m are needed"));
  }
  StereoPair pair;
  pair.left_ = left;
  pair.right_ = right;
  pair.farthest_m_ = left(0, 0) * baseline_m / kLeastDisparity_px;
  return pair;
}

std::optional<Eigen::Vector3d> StereoPair::Triangulate(const Eigen::Vector2d& left,
                                                       const Eigen::Vector2d& right) const {
  Eigen::Matrix4d rows;
  for (int i = 0; i < 2; ++i) {
    rows.row(i) = left_.row(i) - left[i] * left_.row(2);
    rows.row(2 + i) = right_.row(i) - right[i] * right_.row(2);
  }
  const Eigen::Matrix<double, 4, 3> directions = rows.leftCols<3>();
  const Eigen::Vector3d p_S = directions.colPivHouseholderQr().solve(-rows.col(3));
  if (!p_S.allFinite() || !(p_S.z() > 0) || p_S.z() > farthest_m_) return std::nullopt;
  return p_S;
}

std::optional<Eigen::Vector2d> StereoPair::ProjectLeft(const Eigen::Vector3d& p_S) const {
  const Eigen::Vector3d p = left_ * p_S.homogeneous();
  if (!(p.z() > 0)) return std::nullopt;
  return p.head<2>() / p.z();
}

}  // namespace clearway
