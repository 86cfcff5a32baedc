// Points and labels of one file, PCD or PLY.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/scene/frame.h"

namespace clearway {

struct CloudPoints {
  std::vector<Eigen::Vector3f> points_S;  // NaN for lost returns
  std::vector<ObjectId> labels;           // one per point; static unless a field is asked for
  std::vector<std::string> fields;        // of the file
  bool has_viewpoint = false;             // a PCD's VIEWPOINT that is not the identity
};

inline constexpr std::size_t kMaxCloudPoints = 20'000'000;

// Labels of points out of the values of a field. NaN, negative values and the largest of 32 bits
// without sign (what -1 becomes there) leave a point out.
class LabelReader {
 public:
  // The label of point `i`; the first bad value is kept as an error that begins with `where`.
  ObjectId LabelOf(double value, const std::string& where, std::size_t i);
  const absl::Status& status() const { return status_; }

 private:
  absl::Status status_;
};

// Reads fields x, y, z (32 or 64 bits, metres) and, unless it is empty, the label field; skips
// others. INVALID_ARGUMENT names the line or byte: not PCD, cut off, sizes that disagree, no such
// field. RESOURCE_EXHAUSTED above 1 GB or kMaxCloudPoints. Any thread.
absl::StatusOr<CloudPoints> ReadPcd(const std::filesystem::path& path,
                                    const std::string& label_field);
// The same of the vertices of a PLY, ascii or binary.
absl::StatusOr<CloudPoints> ReadPlyCloud(const std::filesystem::path& path,
                                         const std::string& label_field);

}  // namespace clearway
