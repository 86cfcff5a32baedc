// Range sensors as sets of rays.
#pragma once

#include <Eigen/Core>
#include <variant>
#include <vector>

namespace clearway {

// A LiDAR that turns about S's z axis (x forward, y left, z up). Beams are spread evenly in
// elevation, both ends included, azimuths evenly from first_azimuth_rad over azimuth_span_rad.
struct SpinningLidar {
  int beams = 64;            // at least 1
  int azimuth_steps = 1024;  // rays per beam and scan, at least 1
  double lowest_rad = -0.4328;
  double highest_rad = 0.0349;
  double first_azimuth_rad = -3.14159265358979323846;
  double azimuth_span_rad = 6.28318530717958647693;
  double min_range_m = 0.5;
  double max_range_m = 80;

  // With the fields of view of Velodyne's VLP-16 (+-15 deg), HDL-32E (+10.67 to -30.67 deg) and
  // HDL-64E (+2 to -24.8 deg), from their data sheets.
  static SpinningLidar With16Beams();
  static SpinningLidar With32Beams();
  static SpinningLidar With64Beams();
};

// A pinhole depth camera. S is the optical frame: x right, y down, z forward. Ranges are distances
// along the ray, as everywhere in Clearway, not depths along z.
struct DepthCamera {
  int width_px = 640;
  int height_px = 480;
  double horizontal_view_rad = 1.2043;  // 69 deg; square pixels, centre in the image's middle
  double min_range_m = 0.1;
  double max_range_m = 6;
};

using RangeSensor = std::variant<SpinningLidar, DepthCamera>;

// Unit vectors in S. LiDAR: azimuth by azimuth, lowest beam first; camera: row by row.
std::vector<Eigen::Vector3d> RayDirections(const RangeSensor& sensor);
double MinRangeM(const RangeSensor& sensor);
double MaxRangeM(const RangeSensor& sensor);

}  // namespace clearway
