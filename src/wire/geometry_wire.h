// Converters of geometry.proto, and the reader that all converters check their fields with.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "clearway/base/time.h"
#include "clearway/geometry/aabb.h"
#include "clearway/geometry/pose.h"
#include "clearway/scene/moving_object.h"
#include "clearway/v1/geometry.pb.h"

namespace clearway {

void Write(const Eigen::Vector3d& vector, v1::Vector3* proto);
void Write(const Pose& pose, v1::Pose* proto);
void Write(const Twist& twist, v1::Twist* proto);
void Write(const PositionBound& bound, v1::PositionBound* proto);
void Write(const Aabb& box, v1::AxisAlignedBox* proto);
void Append(const Pose& pose, v1::PoseArray* proto);
void Write(std::span<const StampedPose> poses, v1::TimedPoses* proto);

// Reads the fields of one message and remembers the first error, with the field's path; after an
// error every read is harmless. Not thread-safe.
class FieldReader {
 public:
  // `path` is put before each field's name: "", "frame.".
  explicit FieldReader(std::string path = "") : path_(std::move(path)) {}

  bool ok() const { return status_.ok(); }
  const absl::Status& status() const { return status_; }

  void Fail(const std::string& field, const std::string& what);
  void Fail(const absl::Status& status);  // whose message starts with a field
  void AtMost(const std::string& field, std::uint64_t size, std::uint64_t limit);
  void Require(bool condition, const std::string& field, const char* what) {
    if (!condition) Fail(field, what);
  }

  double Finite(const std::string& field, double value);
  double NotNegative(const std::string& field, double value);
  double Positive(const std::string& field, double value);
  Time Stamp(const std::string& field, bool present, std::int64_t ns);

  Eigen::Vector3d Vector(const std::string& field, bool present, const v1::Vector3& proto);
  Pose ReadPose(const std::string& field, bool present, const v1::Pose& proto);
  Twist ReadTwist(const std::string& field, const v1::Twist& proto);
  PositionBound ReadBound(const std::string& field, const v1::PositionBound& proto);
  Aabb Box(const std::string& field, bool present, const v1::AxisAlignedBox& proto);
  // Exactly `count` poses.
  std::vector<Pose> Poses(const std::string& field, const v1::PoseArray& proto, std::size_t count);
  // RESOURCE_EXHAUSTED for more than `limit`.
  std::vector<StampedPose> ReadTimedPoses(const std::string& field, const v1::TimedPoses& proto,
                                          std::uint64_t limit);
  // A repeated field of triples, which may be NaN unless `finite`.
  template <class Repeated>
  void CheckTriples(const std::string& field, const Repeated& values, bool finite);
  template <class Scalar, class Repeated>
  std::vector<Eigen::Matrix<Scalar, 3, 1>> Triples(const std::string& field, const Repeated& values,
                                                   bool finite);
  // One for all or one per item; never none for a question that has items.
  void CheckTimes(const std::string& field,
                  const google::protobuf::RepeatedField<std::int64_t>& times_ns, std::size_t items);
  std::vector<Time> Times(const std::string& field,
                          const google::protobuf::RepeatedField<std::int64_t>& times_ns,
                          std::size_t items);

 private:
  void CheckPose(const std::string& field, const Pose& pose);

  std::string path_;
  absl::Status status_;
};

template <class Repeated>
void FieldReader::CheckTriples(const std::string& field, const Repeated& values, bool finite) {
  if (values.size() % 3 != 0) Fail(field, "its length is not a multiple of 3");
  if (!ok() || !finite) return;
  const auto bad =
      std::find_if(values.begin(), values.end(), [](auto value) { return !std::isfinite(value); });
  if (bad == values.end()) return;
  const auto triple = (bad - values.begin()) / 3;
  Fail(field + "[" + std::to_string(3 * triple) + "]", "is not finite");
}

template <class Scalar, class Repeated>
std::vector<Eigen::Matrix<Scalar, 3, 1>> FieldReader::Triples(const std::string& field,
                                                              const Repeated& values, bool finite) {
  std::vector<Eigen::Matrix<Scalar, 3, 1>> triples;
  CheckTriples(field, values, finite);
  if (!ok()) return triples;
  triples.reserve(values.size() / 3);
  for (int i = 0; i < values.size(); i += 3) {
    triples.emplace_back(values[i], values[i + 1], values[i + 2]);
  }
  return triples;
}

}  // namespace clearway
