// The data folder's worlds of moving discs, in a square, among which a disc is to find its way.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <vector>

namespace clearway::bench {

struct DiscWorld {
  static constexpr double kSide_m = 10, kRobotRadius_m = 0.3, kLatest_s = 60;
  static constexpr double kRobotSpeed_mps = 1, kStart_m = 0.5, kGoal_m = 9.5;  // of x and of y

  // Goes straight and bounces within 0 and kSide_m.
  struct Disc {
    Eigen::Vector2d p_m, v_mps;
    double radius_m;

    Eigen::Vector2d At(double seconds) const;
    // When it bounces, and kLatest_s.
    std::vector<double> Turns() const;
  };

  int discs;
  std::vector<Disc> objects;
};

std::vector<DiscWorld> ReadDiscWorlds(const std::filesystem::path& file);

// By when, in seconds, every robot in this world has met a disc or left the square, wherever its
// speed lets it go: the world has no solution. None if that is not shown. What can be reached is
// followed in small cells and steps, in none of which it is said to be less than it is: a cell
// counts as taken only if all of it is. Takes a few seconds.
std::optional<double> NobodyIsLeftAfter(const DiscWorld& world);

}  // namespace clearway::bench
