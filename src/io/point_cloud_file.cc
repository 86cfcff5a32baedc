#include "clearway/io/point_cloud_file.h"

#include <bit>
#include <cmath>
#include <cstring>

#include "absl/strings/str_cat.h"
#include "clearway/base/file.h"
#include "clearway/base/parse_number.h"
#include "clearway/geometry/unit_quaternion.h"
#include "clearway/io/file_type.h"
#include "io/text_lines.h"

namespace clearway {
namespace {

static_assert(std::endian::native == std::endian::little, "scan graphs are little endian");

constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 30;
constexpr std::size_t kPointBytes = 28;  // the number of coordinates, and as many doubles

bool ParsePoint(std::string_view line, Eigen::Vector3f& point) {
  for (int i = 0; i < 3; ++i) {
    if (!ParseWhole(TakeWord(line), point[i])) return false;
  }
  return TakeWord(line).empty() && point.allFinite();
}

// Reads OctoMap's binary format from the front; the first error sticks and makes the rest zero.
class GraphReader {
 public:
  GraphReader(const std::string& name, std::string_view bytes) : name_(name), bytes_(bytes) {}

  const absl::Status& status() const { return status_; }
  std::size_t left() const { return bytes_.size() - at_; }

  void Fail(const std::string& why) {
    if (!status_.ok()) return;
    status_ = absl::InvalidArgumentError(absl::StrCat(name_, ", byte ", at_, ": ", why));
  }

  template <class T>
  T Take() {
    T value{};
    if (!status_.ok()) return value;
    if (left() < sizeof value) {
      Fail("the file is cut off");
      return value;
    }
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }

  // A count of records of at least `record` bytes each, which must be there.
  std::uint32_t TakeCount(std::size_t record) {
    const std::uint32_t count = Take<std::uint32_t>();
    if (count <= left() / record) return count;
    Fail(absl::StrCat("the file is cut off, or no scan graph: ", left(), " bytes are left for ",
                      count, " records"));
    return 0;
  }

  template <int kSize>
  Eigen::Matrix<double, kSize, 1> TakeVector() {
    if (Take<std::int32_t>() != kSize)
      Fail(absl::StrCat("a vector that has not ", kSize, " numbers"));
    Eigen::Matrix<double, kSize, 1> vector;
    for (int i = 0; i < kSize; ++i) vector[i] = Take<double>();
    if (!vector.allFinite()) Fail("a number that is not finite");
    return vector;
  }

  Pose TakePose() {
    const Eigen::Vector3d translation = TakeVector<3>();
    const Eigen::Vector4d wxyz = TakeVector<4>();
    const Eigen::Quaterniond rotation(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
    if (!IsNearlyUnit(rotation)) Fail(absl::StrCat("a quaternion ", NotUnitText(rotation)));
    if (!status_.ok()) return Pose();
    return {rotation.normalized(), translation};
  }

 private:
  const std::string& name_;
  std::string_view bytes_;
  std::size_t at_ = 0;
  absl::Status status_;
};

PosedCloud TakeNode(GraphReader& reader) {
  PosedCloud cloud;
  const std::uint32_t points = reader.TakeCount(kPointBytes);
  cloud.points_S.reserve(points);
  for (std::uint32_t i = 0; i < points && reader.status().ok(); ++i) {
    cloud.points_S.push_back(reader.TakeVector<3>().cast<float>());
  }
  cloud.T_W_S = reader.TakePose();
  reader.Take<std::uint32_t>();  // the node's id
  return cloud;
}

void TakeEdge(GraphReader& reader) {
  reader.Take<std::uint32_t>();
  reader.Take<std::uint32_t>();
  reader.TakePose();
  reader.Take<double>();  // weight
}

}  // namespace

absl::StatusOr<PosedCloud> ParseTextCloud(const std::string& name, std::string_view text) {
  PosedCloud cloud;
  for (int line_number = 1; !text.empty(); ++line_number) {
    const std::size_t end = text.find('\n');
    const auto fail = [&](const char* why) {
      return absl::InvalidArgumentError(absl::StrCat(name, ", line ", line_number, ": ", why));
    };
    if (end == std::string_view::npos) return fail("the line does not end: the file is cut off");
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end + 1);
    std::string_view rest = line;
    const std::string_view word = TakeWord(rest);
    if (word.empty() || word.front() == '#') continue;
    Eigen::Vector3f point;
    if (!ParsePoint(line, point)) return fail("three finite numbers x, y, z are expected");
    cloud.points_S.push_back(point);
  }
  return cloud;
}

absl::StatusOr<std::vector<PosedCloud>> ParseScanGraph(const std::string& name,
                                                       std::string_view bytes) {
  constexpr std::size_t kLeastNodeBytes = 72, kEdgeBytes = 80;
  GraphReader reader(name, bytes);
  std::vector<PosedCloud> clouds;
  const std::uint32_t nodes = reader.TakeCount(kLeastNodeBytes);
  for (std::uint32_t i = 0; i < nodes && reader.status().ok(); ++i) {
    clouds.push_back(TakeNode(reader));
  }
  const std::uint32_t edges = reader.TakeCount(kEdgeBytes);
  for (std::uint32_t i = 0; i < edges && reader.status().ok(); ++i) TakeEdge(reader);
  if (reader.left() > 0) reader.Fail(absl::StrCat(reader.left(), " bytes follow the last edge"));
  if (!reader.status().ok()) return reader.status();
  return clouds;
}

absl::StatusOr<std::vector<PosedCloud>> ReadPointClouds(const std::filesystem::path& path) {
  const absl::StatusOr<std::string> bytes = ReadWholeFile(path, kMaxBytes);
  if (!bytes.ok()) return bytes.status();
  if (LowerExtension(path) == ".graph") return ParseScanGraph(path.string(), *bytes);
  absl::StatusOr<PosedCloud> cloud = ParseTextCloud(path.string(), *bytes);
  if (!cloud.ok()) return cloud.status();
  return std::vector<PosedCloud>{*std::move(cloud)};
}

}  // namespace clearway
