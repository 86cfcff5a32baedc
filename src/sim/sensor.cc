#include "clearway/sim/sensor.h"

#include <cmath>
#include <numbers>

namespace clearway {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180;

std::vector<Eigen::Vector3d> Rays(const SpinningLidar& lidar) {
  std::vector<Eigen::Vector3d> directions;
  directions.reserve(static_cast<std::size_t>(lidar.azimuth_steps) * lidar.beams);
  const double step_rad =
      lidar.beams > 1 ? (lidar.highest_rad - lidar.lowest_rad) / (lidar.beams - 1) : 0;
  for (int column = 0; column < lidar.azimuth_steps; ++column) {
    const double azimuth =
        lidar.first_azimuth_rad + lidar.azimuth_span_rad * column / lidar.azimuth_steps;
    for (int beam = 0; beam < lidar.beams; ++beam) {
      const double elevation = lidar.lowest_rad + beam * step_rad;
      directions.emplace_back(std::cos(elevation) * std::cos(azimuth),
                              std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
    }
  }
  return directions;
}

std::vector<Eigen::Vector3d> Rays(const DepthCamera& camera) {
  std::vector<Eigen::Vector3d> directions;
  directions.reserve(static_cast<std::size_t>(camera.width_px) * camera.height_px);
  const double focal_px = 0.5 * camera.width_px / std::tan(0.5 * camera.horizontal_view_rad);
  for (int row = 0; row < camera.height_px; ++row) {
    for (int column = 0; column < camera.width_px; ++column) {
      directions.push_back(Eigen::Vector3d(column + 0.5 - 0.5 * camera.width_px,
                                           row + 0.5 - 0.5 * camera.height_px, focal_px)
                               .normalized());
    }
  }
  return directions;
}

SpinningLidar WithBeams(int beams, double lowest_deg, double highest_deg) {
  SpinningLidar lidar;
  lidar.beams = beams;
  lidar.lowest_rad = lowest_deg * kRadPerDeg;
  lidar.highest_rad = highest_deg * kRadPerDeg;
  return lidar;
}

}  // namespace

SpinningLidar SpinningLidar::With16Beams() { return WithBeams(16, -15, 15); }
SpinningLidar SpinningLidar::With32Beams() { return WithBeams(32, -30.67, 10.67); }
SpinningLidar SpinningLidar::With64Beams() { return WithBeams(64, -24.8, 2); }

std::vector<Eigen::Vector3d> RayDirections(const RangeSensor& sensor) {
  return std::visit([](const auto& kind) { return Rays(kind); }, sensor);
}

double MinRangeM(const RangeSensor& sensor) {
  return std::visit([](const auto& kind) { return kind.min_range_m; }, sensor);
}

double MaxRangeM(const RangeSensor& sensor) {
  return std::visit([](const auto& kind) { return kind.max_range_m; }, sensor);
}

}  // namespace clearway
