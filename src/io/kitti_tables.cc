#include "io/kitti_tables.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "io/rigid_matrix.h"
#include "io/utf8.h"
#include "io/word_lines.h"

namespace clearway {
namespace {

using Path = std::filesystem::path;

// The numbers behind a key, of which the object and the tracking benchmark spell some otherwise.
absl::StatusOr<std::vector<double>> Matrix(std::vector<Words>& lines, const Path& path,
                                           std::initializer_list<std::string> keys,
                                           std::size_t count) {
  for (Words& line : lines) {
    std::string key = line.Text(0);
    if (key.ends_with(':')) key.pop_back();
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) continue;
    if (line.size() != count + 1) return WrongCount(line, absl::StrCat("a key and ", count));
    std::vector<double> numbers;
    for (std::size_t i = 1; i <= count; ++i) numbers.push_back(line.Number(i));
    if (!line.status().ok()) return line.status();
    return numbers;
  }
  return absl::InvalidArgumentError(absl::StrCat(path.string(), ": no ", *keys.begin()));
}

using Matrix34 = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;

// What P2 takes is the camera's frame, rectified.
absl::StatusOr<Pose> CameraFromSensor(std::vector<Words>& lines, const Path& path) {
  const auto rectify = Matrix(lines, path, {"R_rect", "R0_rect"}, 9);
  if (!rectify.ok()) return rectify.status();
  const auto mounted = Matrix(lines, path, {"Tr_velo_cam", "Tr_velo_to_cam"}, 12);
  if (!mounted.ok()) return mounted.status();
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> R(rectify->data());
  return PoseOfMatrix(R * Eigen::Map<const Matrix34>(mounted->data()),
                      absl::StrCat(path.string(), ", R_rect times Tr_velo_cam"));
}

// P2, of which the left three columns turn directions to pixels and back.
absl::StatusOr<Matrix34> Projection(std::vector<Words>& lines, const Path& path) {
  constexpr double kFlat = 1e-9;  // over a cube of the same norm
  const auto numbers = Matrix(lines, path, {"P2"}, 12);
  if (!numbers.ok()) return numbers.status();
  const Matrix34 P = Eigen::Map<const Matrix34>(numbers->data());
  const Eigen::Matrix3d turning = P.leftCols<3>();
  if (turning.determinant() > kFlat * std::pow(turning.norm(), 3)) return P;
  return absl::InvalidArgumentError(
      absl::StrCat(path.string(), ", P2: is not the projection of a camera"));
}

// x along the length, z up: a camera's y goes down, and at no turn the length is along its x. KITTI
// gives the middle of the bottom.
Pose BoxInCamera(const Eigen::Vector3d& bottom_C, double height_m, double turn_rad) {
  Eigen::Matrix3d R_box;
  R_box << 1, 0, 0,  //
      0, 0, -1,      //
      0, 1, 0;
  const Eigen::AngleAxisd turn(turn_rad, Eigen::Vector3d::UnitY());
  return {Eigen::Quaterniond(turn * R_box), bottom_C - Eigen::Vector3d(0, height_m / 2, 0)};
}

}  // namespace

absl::StatusOr<KittiCalibration> ReadKittiCalibration(const Path& path) {
  auto lines = ReadWordLines(path, LastLine::kMayBeOpen);
  if (!lines.ok()) return lines.status();
  const auto projection = Projection(*lines, path);
  if (!projection.ok()) return projection.status();
  const auto T_C_S = CameraFromSensor(*lines, path);
  if (!T_C_S.ok()) return T_C_S.status();
  const auto imu = Matrix(*lines, path, {"Tr_imu_velo", "Tr_imu_to_velo"}, 12);
  if (!imu.ok()) return imu.status();
  const auto T_S_I = PoseOfMatrix(Eigen::Map<const Matrix34>(imu->data()),
                                  absl::StrCat(path.string(), ", Tr_imu_velo"));
  if (!T_S_I.ok()) return T_S_I.status();
  return KittiCalibration{*T_C_S, *T_S_I, *projection};
}

// The raw data's development kit: Mercator's projection, scaled to be true where the drive begins.
absl::StatusOr<std::vector<Pose>> ReadKittiOxts(const Path& path) {
  constexpr double kEarthRadius_m = 6378137, kRadPerDeg = std::numbers::pi / 180;
  constexpr std::size_t kFewest = 6;  // latitude, longitude, altitude, roll, pitch, yaw
  auto lines = ReadWordLines(path, LastLine::kEnds);
  if (!lines.ok()) return lines.status();
  std::vector<Pose> T_W_I;
  std::optional<std::pair<double, Eigen::Vector3d>> origin;  // scale, and the first place
  for (Words& line : *lines) {
    if (line.size() < kFewest) return WrongCount(line, "30");
    double value[kFewest];
    for (std::size_t i = 0; i < kFewest; ++i) value[i] = line.Number(i);
    if (std::abs(value[0]) >= 90) line.Fail(0, "a latitude");
    if (!line.status().ok()) return line.status();
    const double north_rad = value[0] * kRadPerDeg;
    const double scale_m = kEarthRadius_m * (origin ? origin->first : std::cos(north_rad));
    const Eigen::Vector3d place(scale_m * value[1] * kRadPerDeg,
                                scale_m * std::log(std::tan(std::numbers::pi / 4 + north_rad / 2)),
                                value[2]);
    if (!origin) origin = {std::cos(north_rad), place};
    const Eigen::Quaterniond turn = Eigen::AngleAxisd(value[5], Eigen::Vector3d::UnitZ()) *
                                    Eigen::AngleAxisd(value[4], Eigen::Vector3d::UnitY()) *
                                    Eigen::AngleAxisd(value[3], Eigen::Vector3d::UnitX());
    T_W_I.push_back({turn, place - origin->second});
  }
  if (T_W_I.empty()) {
    return absl::InvalidArgumentError(absl::StrCat(path.string(), ": no frame"));
  }
  return T_W_I;
}

// Columns: frame, track, type, truncated, occluded, alpha, four of the box in the image, height,
// width, length, x, y, z, rotation_y, and of results a score.
absl::StatusOr<KittiLabels> ReadKittiLabels(const Path& path) {
  auto lines = ReadWordLines(path, LastLine::kEnds);
  if (!lines.ok()) return lines.status();
  KittiLabels labels;
  std::map<std::pair<int, int>, std::string> seen;  // where, by frame and track
  for (Words& line : *lines) {
    if (line.size() != 17 && line.size() != 18) return WrongCount(line, "17, or 18 with a score");
    const int frame = line.Integer(0, 0);
    if (line.Text(2) == "DontCare") {
      labels.unlabelled.insert(
          {frame, {line.Number(6), line.Number(7), line.Number(8), line.Number(9)}});
    } else {
      KittiBox box;
      box.frame = frame;
      box.track = line.Integer(1, 0);
      if (!IsPlainText(line.Text(2))) line.Fail(2, "text in UTF-8 without control characters");
      box.type = line.Text(2);
      box.size_m = {line.Number(12), line.Number(11), line.Number(10)};
      for (std::size_t i = 10; i <= 12; ++i) {
        if (line.Number(i) <= 0) line.Fail(i, "a length above 0");
      }
      const Eigen::Vector3d bottom_C(line.Number(13), line.Number(14), line.Number(15));
      box.T_C_B = BoxInCamera(bottom_C, box.size_m.z(), line.Number(16));
      const auto [first, is_new] = seen.try_emplace({frame, box.track}, line.where());
      if (!is_new && line.status().ok()) {
        return absl::InvalidArgumentError(absl::StrCat(line.where(), ": a second box of track ",
                                                       box.track, " in frame ", frame,
                                                       "; the first: ", first->second));
      }
      labels.boxes.push_back(std::move(box));
    }
    if (!line.status().ok()) return line.status();
  }
  return labels;
}

}  // namespace clearway
