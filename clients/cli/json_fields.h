// Reads a JSON object field by field; errors name the path of the field.
#pragma once

#include <Eigen/Core>
#include <initializer_list>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/base/time.h"
#include "clearway/geometry/pose.h"
#include "cli/json.h"

namespace clearway::cli {

// One object within a document. It must not outlive the document.
class JsonFields {
 public:
  // INVALID_ARGUMENT if `value` is no object, or has a field that is not in `known`.
  static absl::StatusOr<JsonFields> Of(const Json& value, const std::string& path,
                                       std::initializer_list<const char*> known);

  bool Has(const char* field) const { return value_->contains(field); }
  std::string PathOf(const std::string& field) const;
  absl::Status Error(const std::string& field, const std::string& what) const;

  absl::StatusOr<std::string> Text(const char* field) const;
  absl::StatusOr<double> Positive(const char* field) const;
  absl::StatusOr<double> Number(const char* field) const;
  absl::StatusOr<double> NumberOr(const char* field, double otherwise) const;
  // Of at most 1e6 s either way.
  absl::StatusOr<Duration> Seconds(const char* field) const;
  absl::StatusOr<bool> FlagOr(const char* field, bool otherwise) const;
  // A list of any length.
  absl::StatusOr<std::vector<double>> NumberList(const char* field) const;
  absl::StatusOr<Eigen::Vector3d> Vector(const char* field) const;
  absl::StatusOr<std::vector<Eigen::Vector3d>> Vectors(const char* field) const;
  // A list that is not empty.
  absl::StatusOr<const Json*> List(const char* field) const;
  // The pose of field "pose", {"position_m": [..], "rpy_rad": [..] or "rotation_xyzw": [..]};
  // identity if there is none. Roll, pitch and yaw turn about the fixed axes x, y, z in this order.
  absl::StatusOr<Pose> PoseOrIdentity(const char* field) const;

 private:
  JsonFields(const Json& value, const std::string& path) : value_(&value), path_(path) {}
  absl::StatusOr<std::vector<double>> Numbers(const char* field, std::size_t count) const;

  const Json* value_;
  std::string path_;
};

}  // namespace clearway::cli
