#include "disc_worlds.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

namespace clearway::bench {
namespace {

double Folded(double coordinate) {
  constexpr double kSide_m = DiscWorld::kSide_m;
  const double wave = std::fmod(coordinate, 2 * kSide_m);
  const double up = wave < 0 ? wave + 2 * kSide_m : wave;
  return up > kSide_m ? 2 * kSide_m - up : up;
}

// The cells of the square whose centres lie in a disc, row by row: those from `first` up to `last`.
template <class Visit>
void ForEachRow(int cells, const Eigen::Vector2d& center, double radius, Visit&& visit) {
  if (radius <= 0) return;
  const int top = std::min(cells - 1, static_cast<int>(std::floor(center.y() + radius)));
  for (int y = std::max(0, static_cast<int>(std::ceil(center.y() - radius))); y <= top; ++y) {
    const double half =
        std::sqrt(std::max(0.0, radius * radius - (y - center.y()) * (y - center.y())));
    const int first = std::max(0, static_cast<int>(std::ceil(center.x() - half)));
    const int last = std::min(cells - 1, static_cast<int>(std::floor(center.x() + half)));
    if (first <= last) visit(y, first, last);
  }
}

// The cells that can be reached by a time, and perhaps some others. Lengths are in cells.
class Reachable {
 public:
  Reachable(const DiscWorld& world, double cell_m, double step_s)
      : world_(world),
        cell_m_(cell_m),
        step_s_(step_s),
        cells_(static_cast<int>(std::round(DiscWorld::kSide_m / cell_m)) + 1),
        reached_(static_cast<std::size_t>(cells_) * cells_, 0) {
    const int start = static_cast<int>(std::round(DiscWorld::kStart_m / cell_m));
    reached_[static_cast<std::size_t>(start) * cells_ + start] = 1;
  }

  bool any() const { return std::ranges::find(reached_, 1) != reached_.end(); }

  void Step(double until_s) {
    Spread();
    for (const DiscWorld::Disc& disc : world_.objects) {
      // All of a cell is taken if its centre lies this deep in a disc.
      const double deep = (disc.radius_m + DiscWorld::kRobotRadius_m) / cell_m_ - M_SQRT1_2;
      ForEachRow(cells_, disc.At(until_s) / cell_m_, deep, [&](int y, int first, int last) {
        std::fill_n(Row(reached_, y) + first, last - first + 1, 0);
      });
    }
  }

 private:
  char* Row(std::vector<char>& cells, int y) const {
    return cells.data() + static_cast<std::size_t>(y) * cells_;
  }

  // To all cells of which some point can be reached in a step from some point of one.
  void Spread() {
    std::vector<char> wider(reached_.size(), 0);
    const double reach = DiscWorld::kRobotSpeed_mps * step_s_ / cell_m_ + M_SQRT2;
    for (int y = 0; y < cells_; ++y) {
      const char* const row = Row(reached_, y);
      for (int x = 0; x < cells_;) {
        const int begin = static_cast<int>(std::find(row + x, row + cells_, 1) - row);
        const int end = static_cast<int>(std::find(row + begin, row + cells_, 0) - row);
        x = end;
        if (begin == end) continue;
        ForEachRow(cells_, {0, y}, reach, [&](int other, int, int half) {
          const int first = std::max(0, begin - half), last = std::min(cells_ - 1, end - 1 + half);
          std::fill_n(Row(wider, other) + first, last - first + 1, 1);
        });
      }
    }
    reached_ = std::move(wider);
  }

  const DiscWorld& world_;
  double cell_m_, step_s_;
  int cells_;
  std::vector<char> reached_;
};

}  // namespace

Eigen::Vector2d DiscWorld::Disc::At(double seconds) const {
  const Eigen::Vector2d straight = p_m + seconds * v_mps;
  return {Folded(straight.x()), Folded(straight.y())};
}

std::vector<double> DiscWorld::Disc::Turns() const {
  std::vector<double> turns_s{kLatest_s};
  for (int axis = 0; axis < 2; ++axis) {
    const double speed_mps = std::abs(v_mps[axis]);
    if (speed_mps == 0) continue;
    const double first_m = v_mps[axis] > 0 ? kSide_m - p_m[axis] : p_m[axis];
    for (double way_m = first_m; way_m < speed_mps * kLatest_s; way_m += kSide_m) {
      if (way_m > 0) turns_s.push_back(way_m / speed_mps);
    }
  }
  std::ranges::sort(turns_s);
  return turns_s;
}

std::vector<DiscWorld> ReadDiscWorlds(const std::filesystem::path& file) {
  std::vector<DiscWorld> worlds;
  std::ifstream stream(file);
  for (const auto& world : nlohmann::json::parse(stream)) {
    worlds.push_back({world.at("discs"), {}});
    for (const auto& o : world.at("objects")) {
      const std::vector<double> v = o;
      worlds.back().objects.push_back(
          {Eigen::Vector2d(v.at(0), v.at(1)), Eigen::Vector2d(v.at(2), v.at(3)), v.at(4)});
    }
  }
  return worlds;
}

std::optional<double> NobodyIsLeftAfter(const DiscWorld& world) {
  constexpr double kCell_m = 0.005, kStep_s = 0.1;
  Reachable reachable(world, kCell_m, kStep_s);
  for (double until_s = kStep_s; until_s < DiscWorld::kLatest_s; until_s += kStep_s) {
    reachable.Step(until_s);
    if (!reachable.any()) return until_s;
  }
  return std::nullopt;
}

}  // namespace clearway::bench
