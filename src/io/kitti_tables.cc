#include "io/kitti_tables.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <initializer_list>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "io/keyed_rows.h"
#include "io/rigid_matrix.h"

namespace clearway {
namespace {

using Path = std::filesystem::path;

constexpr std::int64_t kMaxNumber = 99'999'999;  // of frames and tracks

// The numbers behind a key, of which the object and the tracking benchmark spell some otherwise.
absl::StatusOr<std::vector<double>> Matrix(WordRows& lines, const Path& path,
                                           std::initializer_list<std::string_view> keys,
                                           std::size_t count) {
  const auto found = RowOfKey(lines, keys);
  if (!found.ok()) return found.status();
  if (*found == nullptr) {
    return absl::InvalidArgumentError(
        absl::StrCat(path.string(), ": no ", std::string(*keys.begin())));
  }
  Row& line = **found;
  if (line.size() != count + 1) return line.WrongCount(absl::StrCat("a key and ", count));
  std::vector<double> numbers;
  for (std::size_t i = 1; i <= count; ++i) numbers.push_back(line.Coordinate(i));
  if (!line.status().ok()) return line.status();
  return numbers;
}

using Matrix34 = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;

// What P2 takes is the camera's frame, rectified.
absl::StatusOr<Pose> CameraFromSensor(WordRows& lines, const Path& path) {
  const auto rectify = Matrix(lines, path, {"R_rect", "R0_rect"}, 9);
  if (!rectify.ok()) return rectify.status();
  const auto mounted = Matrix(lines, path, {"Tr_velo_cam", "Tr_velo_to_cam"}, 12);
  if (!mounted.ok()) return mounted.status();
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> R(rectify->data());
  return PoseOfMatrix(R * Eigen::Map<const Matrix34>(mounted->data()),
                      absl::StrCat(path.string(), ", R_rect times Tr_velo_cam"));
}

// P2, of which the left three columns turn directions to pixels and back.
absl::StatusOr<Matrix34> Projection(WordRows& lines, const Path& path) {
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
  auto lines = ReadWordRows(path, {.last = LastLine::kMayBeOpen});
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

namespace {

constexpr std::size_t kOxtsWords = 6;  // latitude, longitude, altitude, roll, pitch, yaw

// The raw data's development kit: Mercator's projection, scaled to be true where the drive begins.
class DrivePoses {
 public:
  Pose PoseOf(const std::array<double, kOxtsWords>& value) {
    constexpr double kEarthRadius_m = 6378137, kRadPerDeg = std::numbers::pi / 180;
    const double north_rad = value[0] * kRadPerDeg;
    const double scale_m = kEarthRadius_m * (origin_ ? origin_->first : std::cos(north_rad));
    const Eigen::Vector3d place(scale_m * value[1] * kRadPerDeg,
                                scale_m * std::log(std::tan(std::numbers::pi / 4 + north_rad / 2)),
                                value[2]);
    if (!origin_) origin_ = {std::cos(north_rad), place};
    const Eigen::Quaterniond turn = Eigen::AngleAxisd(value[5], Eigen::Vector3d::UnitZ()) *
                                    Eigen::AngleAxisd(value[4], Eigen::Vector3d::UnitY()) *
                                    Eigen::AngleAxisd(value[3], Eigen::Vector3d::UnitX());
    return Pose{turn, place - origin_->second};
  }

 private:
  std::optional<std::pair<double, Eigen::Vector3d>> origin_;  // scale, and the first place
};

}  // namespace

absl::StatusOr<std::vector<std::optional<Pose>>> ReadKittiOxts(const Path& path,
                                                               LeftOut& left_out) {
  auto lines = ReadWordRows(path, {.blanks = BlankLines::kRows});
  if (!lines.ok()) return lines.status();
  std::vector<std::optional<Pose>> T_W_I;
  DrivePoses drive;
  const auto visit = [&](Row& row) {
    if (row.size() < kOxtsWords) return row.WrongCount("30");
    std::array<double, kOxtsWords> value;
    for (std::size_t i = 0; i < kOxtsWords; ++i) value[i] = row.Coordinate(i);
    row.CheckNumbers(kOxtsWords, row.size());
    if (std::abs(value[0]) >= 90) row.Fail(0, "a latitude");
    if (row.status().ok()) T_W_I.back() = drive.PoseOf(value);
    return row.status();
  };
  RowPolicy policy(left_out);
  for (Row& row : lines->rows) {
    T_W_I.emplace_back();
    if (auto status = policy.Visit(row, visit); !status.ok()) return status;
  }
  if (T_W_I.empty()) {
    return absl::InvalidArgumentError(absl::StrCat(path.string(), ": no frame"));
  }
  if (auto status = policy.Finish(); !status.ok()) return status;
  return T_W_I;
}

namespace {

// Columns: frame, track, type, truncated, occluded, alpha, four of the box in the image, height,
// width, length, x, y, z, rotation_y, and of results a score. The raw data's type
// "Person (sitting)" is two words.
struct LabelColumns {
  explicit LabelColumns(const Row& row)
      : has_two_words(row.size() > 3 && row.Text(3).starts_with('(') && row.Text(3).ends_with(')')),
        numbers(has_two_words ? 4 : 3) {}

  bool HasAll(const Row& row) const {
    return row.size() == numbers + 14 || row.size() == numbers + 15;
  }
  std::string TypeOf(Row& row) const {
    const std::string type = row.PlainText(2);
    return has_two_words ? absl::StrCat(type, " ", row.PlainText(3)) : type;
  }

  bool has_two_words;
  std::size_t numbers;  // truncated
};

constexpr double kMaxLength_m = 100, kMaxTurn_rad = 6.3;

KittiBox TakeBox(Row& row, const LabelColumns& columns) {
  const std::size_t size = columns.numbers + 7, place = size + 3;
  KittiBox box;
  box.line = row.line();
  box.frame = static_cast<int>(row.Integer(0, 0, kMaxNumber));
  box.track = static_cast<int>(row.Integer(1, 0, kMaxNumber));
  box.type = columns.TypeOf(row);
  box.size_m = {row.Coordinate(size + 2), row.Coordinate(size + 1), row.Coordinate(size)};
  // Shifted columns are numbers, too: of pixels, most often.
  for (std::size_t i = size; i < place; ++i) {
    const double length_m = row.Coordinate(i);
    if (length_m <= 0 || length_m > kMaxLength_m) row.Fail(i, "a length above 0, at most 100 m");
  }
  for (const auto& [i, most] : {std::pair{columns.numbers, 2}, {columns.numbers + 1, 4}}) {
    const double grade = row.Coordinate(i);
    if (grade < -1 || grade > most) {
      row.Fail(i, absl::StrCat(most == 2 ? "a truncation" : "an occlusion", " of -1 to ", most));
    }
  }
  const double turn_rad = row.Coordinate(place + 3);
  if (std::abs(turn_rad) > kMaxTurn_rad) row.Fail(place + 3, "an angle of -2 pi to 2 pi, in rad");
  const Eigen::Vector3d bottom_C(row.Coordinate(place), row.Coordinate(place + 1),
                                 row.Coordinate(place + 2));
  box.T_C_B = BoxInCamera(bottom_C, box.size_m.z(), turn_rad);
  return box;
}

}  // namespace

absl::StatusOr<KittiLabels> ReadKittiLabels(const Path& path, LeftOut& left_out) {
  KittiLabels labels;
  std::map<std::pair<int, int>, int> seen;  // the line, by frame and track
  const auto visit = [&](Row& row) {
    const LabelColumns columns(row);
    if (!columns.HasAll(row)) return row.WrongCount("17, or 18 with a score");
    row.CheckNumbers(0, 2);
    row.CheckNumbers(columns.numbers, row.size());
    if (row.Text(2) == "DontCare") {
      const std::size_t image = columns.numbers + 3;
      const ImageRegion region{row.Coordinate(image), row.Coordinate(image + 1),
                               row.Coordinate(image + 2), row.Coordinate(image + 3)};
      const auto frame = static_cast<int>(row.Integer(0, 0, kMaxNumber));
      if (row.status().ok()) labels.unlabelled.insert({frame, region});
      return row.status();
    }
    KittiBox box = TakeBox(row, columns);
    if (!row.status().ok()) return row.status();
    const auto [first, is_new] = seen.try_emplace({box.frame, box.track}, row.line());
    if (!is_new) {
      return row.Error(absl::StrCat("a second box of track ", box.track, " in frame ", box.frame,
                                    "; the first: line ", first->second));
    }
    labels.boxes.push_back(std::move(box));
    return absl::OkStatus();
  };
  if (auto status = VisitWords(path, {}, left_out, visit); !status.ok()) return status;
  return labels;
}

}  // namespace clearway
