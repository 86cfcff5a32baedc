#include "collision/extreme_points.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace clearway {
namespace {

constexpr int kMostLevels = 5;
constexpr std::size_t kMostLooksAtEach = 200;
constexpr std::size_t kMostLooks = 30'000'000;
constexpr std::size_t kMostCopies = 20;       // of a point, on average
constexpr std::size_t kMostLeft = 4'000'000;  // in all squares together
constexpr std::size_t kMostUnsorted = 20'000;

Eigen::Vector3d Direction(int axis, double sign, double u, double v) {
  Eigen::Vector3d direction;
  direction[axis] = sign;
  direction[(axis + 1) % 3] = u;
  direction[(axis + 2) % 3] = v;
  return direction;
}

std::vector<Eigen::Vector3d> Distinct(std::vector<Eigen::Vector3d> points) {
  std::sort(points.begin(), points.end(), [](const Eigen::Vector3d& l, const Eigen::Vector3d& r) {
    return std::lexicographical_compare(l.begin(), l.end(), r.begin(), r.end());
  });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

std::vector<Eigen::Vector3d> CornersOfBoxAround(const std::vector<Eigen::Vector3d>& points) {
  Aabb box;
  for (const Eigen::Vector3d& point : points) box.Extend(point);
  std::vector<Eigen::Vector3d> corners;
  for (int i = 0; i < 8; ++i) {
    corners.emplace_back((i & 1 ? box.max : box.min).x(), (i & 2 ? box.max : box.min).y(),
                         (i & 4 ? box.max : box.min).z());
  }
  return corners;
}

}  // namespace

ExtremePoints::ExtremePoints(std::vector<Eigen::Vector3d> points_G)
    : points_G_(Distinct(std::move(points_G))) {
  // About as many squares as points.
  const auto levels = static_cast<int>(std::bit_width(points_G_.size() / 6)) / 2;
  if (!Sort(std::min(kMostLevels, levels))) {
    if (points_G_.size() > kMostUnsorted) points_G_ = CornersOfBoxAround(points_G_);
    Sort(0);
  }
  for (const Indices& candidates : by_square_) {
    first_.push_back(static_cast<std::uint32_t>(candidates_G_.size()));
    for (const std::uint32_t i : candidates) candidates_G_.push_back(points_G_[i]);
  }
  first_.push_back(static_cast<std::uint32_t>(candidates_G_.size()));
  points_G_ = {};
  by_square_ = {};
}

// Whether few enough points are left in the squares, which is always so if they are not cut.
bool ExtremePoints::Sort(int levels) {
  levels_ = levels;
  left_to_look_at_ = std::min(kMostLooks, kMostLooksAtEach * points_G_.size());
  by_square_.assign(std::size_t{6} << 2 * levels_, {});
  Indices all(points_G_.size());
  std::iota(all.begin(), all.end(), 0u);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) Split({axis, sign, -1, -1, 2}, all, levels_);
  }
  if (levels == 0) return true;
  std::size_t left = 0;
  for (const Indices& candidates : by_square_) left += candidates.size();
  return left_to_look_at_ > 0 && left <= std::min(kMostLeft, kMostCopies * points_G_.size());
}

void ExtremePoints::Split(const Square& square, const Indices& candidates, int level) {
  if (left_to_look_at_ < candidates.size()) left_to_look_at_ = 0;
  if (left_to_look_at_ == 0) return;
  left_to_look_at_ -= candidates.size();
  Indices left = MayBeFarthest(square, candidates);
  const double half = 0.5 * square.edge;
  if (level == 0) {
    const auto middle = Direction(square.axis, square.sign, square.u + half, square.v + half);
    by_square_[SquareOf(middle)] = std::move(left);
    return;
  }
  for (const double u : {square.u, square.u + half}) {
    for (const double v : {square.v, square.v + half}) {
      Split({square.axis, square.sign, u, v, half}, left, level - 1);
    }
  }
}

// Which of two points is farther is linear in the direction: one that is at least as far at the
// square's four corners is so all over it. The rivals themselves stay.
ExtremePoints::Indices ExtremePoints::MayBeFarthest(const Square& square,
                                                    const Indices& candidates) const {
  std::array<Eigen::Vector3d, 5> looks;  // the corners, and the middle
  for (int i = 0; i < 4; ++i) {
    looks[i] = Direction(square.axis, square.sign, square.u + square.edge * (i & 1),
                         square.v + square.edge * (i >> 1));
  }
  looks[4] = 0.25 * (looks[0] + looks[1] + looks[2] + looks[3]);
  std::array<std::uint32_t, 5> rivals;
  for (int i = 0; i < 5; ++i) {
    rivals[i] = *std::max_element(candidates.begin(), candidates.end(),
                                  [&](std::uint32_t l, std::uint32_t r) {
                                    return looks[i].dot(points_G_[l]) < looks[i].dot(points_G_[r]);
                                  });
  }
  const auto beaten_by = [&](std::uint32_t point, std::uint32_t rival) {
    const Eigen::Vector3d ahead = points_G_[rival] - points_G_[point];
    return std::all_of(looks.begin(), looks.end(),
                       [&](const Eigen::Vector3d& look) { return look.dot(ahead) >= 0; });
  };
  Indices left;
  for (const std::uint32_t point : candidates) {
    const bool stays = std::find(rivals.begin(), rivals.end(), point) != rivals.end() ||
                       std::none_of(rivals.begin(), rivals.end(),
                                    [&](std::uint32_t rival) { return beaten_by(point, rival); });
    if (stays) left.push_back(point);
  }
  return left;
}

std::size_t ExtremePoints::SquareOf(const Eigen::Vector3d& direction) const {
  const double x = std::abs(direction.x()), y = std::abs(direction.y()),
               z = std::abs(direction.z());
  const int axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  const int cells = 1 << levels_;
  const double scale = 0.5 * cells / std::abs(direction[axis]);
  const auto cell = [&](int along) {
    const int index = static_cast<int>(direction[(axis + along) % 3] * scale + 0.5 * cells);
    return static_cast<std::size_t>(std::clamp(index, 0, cells - 1));
  };
  const std::size_t face = 2 * axis + (direction[axis] > 0 ? 1 : 0);
  return (face * cells + cell(1)) * cells + cell(2);
}

const Eigen::Vector3d& ExtremePoints::Farthest(const Eigen::Vector3d& direction_G) const {
  const std::size_t square = SquareOf(direction_G);
  double farthest = -std::numeric_limits<double>::infinity();
  std::size_t index = first_[square];
  for (std::uint32_t i = first_[square]; i < first_[square + 1]; ++i) {
    const double far = direction_G.dot(candidates_G_[i]);
    if (!(far > farthest)) continue;
    farthest = far;
    index = i;
  }
  return candidates_G_[index];
}

Aabb ExtremePoints::BoxTurned(const Eigen::Matrix3d& R_F_G) const {
  Aabb box;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d direction_G = R_F_G.row(axis).transpose();
    box.max[axis] = direction_G.dot(Farthest(direction_G));
    box.min[axis] = direction_G.dot(Farthest(-direction_G));
  }
  return box;
}

}  // namespace clearway
