#include "collision/parallel_cylinders.h"

#include <algorithm>
#include <cmath>

#include "collision/advance.h"

namespace clearway {
namespace {

// The part of a way between two shares; none if its end lies before its begin.
struct Part {
  double begin, end;
};
constexpr Part kNone{kNever, -kNever};

// Where |along + share * way| <= reach.
Part Within(double along_m, double way_m, double reach_m) {
  if (way_m == 0) return std::abs(along_m) <= reach_m ? Part{-kNever, kNever} : kNone;
  const double one = (-reach_m - along_m) / way_m, other = (reach_m - along_m) / way_m;
  return {std::min(one, other), std::max(one, other)};
}

// The same in the plane; only where that begins at 0 or later.
Part Within(const Eigen::Vector2d& from_m, const Eigen::Vector2d& way_m, double reach_m) {
  const double beyond = from_m.squaredNorm() - reach_m * reach_m;
  if (beyond <= 0) return {0, kNever};  // its end does not matter: it has begun
  const double along = -from_m.dot(way_m), all = way_m.squaredNorm();
  const double root = along * along - all * beyond;
  if (!(along > 0) || root < 0) return kNone;
  return {beyond / (along + std::sqrt(root)), (along + std::sqrt(root)) / all};
}

}  // namespace

std::optional<ParallelCylinders> ParallelCylinders::Of(const Cylinder& first,
                                                       const Cylinder& second,
                                                       const Pose& T_second_first) {
  constexpr double kParallel_rad = 1e-12;
  const Eigen::Vector3d axis = T_second_first.rotation * Eigen::Vector3d::UnitZ();
  if (!(axis.head<2>().norm() <= kParallel_rad)) return std::nullopt;
  ParallelCylinders pair;
  pair.to_first_m_ = T_second_first.translation;
  pair.radii_m_ = first.radius_m + second.radius_m;
  pair.halves_m_ = 0.5 * (first.length_m + second.length_m);
  return pair;
}

double ParallelCylinders::Distance() const {
  return std::hypot(std::max(0.0, to_first_m_.head<2>().norm() - radii_m_),
                    std::max(0.0, std::abs(to_first_m_.z()) - halves_m_));
}

std::optional<double> ParallelCylinders::FirstTouch(const Eigen::Vector3d& way, double margin_m,
                                                    double until) const {
  const double beyond_m = margin_m + kKept_m;
  if (!to_first_m_.allFinite() || !way.allFinite() || !std::isfinite(beyond_m)) return std::nullopt;
  const Part beside = Within(to_first_m_.head<2>(), way.head<2>(), radii_m_ + beyond_m);
  const Part level = Within(to_first_m_.z(), way.z(), halves_m_ + beyond_m);
  const double share = std::max({0.0, beside.begin, level.begin});
  if (share > std::min({until, beside.end, level.end})) return kNever;
  const Eigen::Vector3d there_m = to_first_m_ + share * way;
  const bool at_rims = there_m.head<2>().norm() > radii_m_ && std::abs(there_m.z()) > halves_m_;
  return at_rims ? std::nullopt : std::optional(share);
}

}  // namespace clearway
