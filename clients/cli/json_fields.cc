#include "cli/json_fields.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"
#include "clearway/geometry/unit_quaternion.h"

namespace clearway::cli {
namespace {

// The value as it stands in the file, cut to a message's length.
std::string Shown(const Json& value) {
  const std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  return text.size() <= 40 ? text : text.substr(0, 37) + "...";
}

bool NumbersOf(const Json& value, std::size_t count, std::vector<double>* numbers) {
  if (!value.is_array() || value.size() != count) return false;
  for (const Json& item : value) {
    if (!item.is_number() || !std::isfinite(item.get<double>())) return false;
    numbers->push_back(item.get<double>());
  }
  return true;
}

}  // namespace

absl::StatusOr<JsonFields> JsonFields::Of(const Json& value, const std::string& path,
                                          std::initializer_list<const char*> known) {
  const JsonFields fields(value, path);
  if (!value.is_object()) {
    return absl::InvalidArgumentError(
        absl::StrCat(path.empty() ? "the file" : path, ": expected an object, not ", Shown(value)));
  }
  for (const auto& [name, ignored] : value.items()) {
    const bool is_known = std::any_of(known.begin(), known.end(),
                                      [&name = name](const char* k) { return name == k; });
    if (!is_known) return fields.Error(name, "unknown field");
  }
  return fields;
}

std::string JsonFields::PathOf(const std::string& field) const {
  return path_.empty() ? field : path_ + "." + field;
}

absl::Status JsonFields::Error(const std::string& field, const std::string& what) const {
  return absl::InvalidArgumentError(absl::StrCat(PathOf(field), ": ", what));
}

absl::StatusOr<std::string> JsonFields::Text(const char* field) const {
  if (!Has(field)) return Error(field, "missing");
  const Json& value = value_->at(field);
  if (!value.is_string()) return Error(field, "expected a text, not " + Shown(value));
  return value.get<std::string>();
}

absl::StatusOr<double> JsonFields::Positive(const char* field) const {
  if (!Has(field)) return Error(field, "missing");
  const Json& value = value_->at(field);
  const double number = value.is_number() ? value.get<double>() : 0;
  if (!std::isfinite(number) || number <= 0) {
    return Error(field, "expected a number above 0, not " + Shown(value));
  }
  return number;
}

absl::StatusOr<double> JsonFields::Number(const char* field) const {
  if (!Has(field)) return Error(field, "missing");
  const Json& value = value_->at(field);
  if (!value.is_number() || !std::isfinite(value.get<double>())) {
    return Error(field, "expected a number, not " + Shown(value));
  }
  return value.get<double>();
}

absl::StatusOr<double> JsonFields::NumberOr(const char* field, double otherwise) const {
  return Has(field) ? Number(field) : otherwise;
}

absl::StatusOr<Duration> JsonFields::Seconds(const char* field) const {
  constexpr double kLongest_s = 1e6;
  const auto seconds = Number(field);
  if (!seconds.ok()) return seconds.status();
  if (std::abs(*seconds) <= kLongest_s) return FromSeconds(*seconds);
  return Error(field, absl::StrCat("is ", NumberText(*seconds), " s, must be at most ",
                                   NumberText(kLongest_s), " s either way"));
}

absl::StatusOr<bool> JsonFields::FlagOr(const char* field, bool otherwise) const {
  if (!Has(field)) return otherwise;
  const Json& value = value_->at(field);
  if (!value.is_boolean()) return Error(field, "expected true or false, not " + Shown(value));
  return value.get<bool>();
}

absl::StatusOr<std::vector<double>> JsonFields::NumberList(const char* field) const {
  const auto list = List(field);
  if (!list.ok()) return list.status();
  return Numbers(field, (*list)->size());
}

absl::StatusOr<std::vector<double>> JsonFields::Numbers(const char* field,
                                                        std::size_t count) const {
  if (!Has(field)) return Error(field, "missing");
  std::vector<double> numbers;
  if (!NumbersOf(value_->at(field), count, &numbers)) {
    return Error(field, absl::StrCat("expected ", count, " numbers in a list, not ",
                                     Shown(value_->at(field))));
  }
  return numbers;
}

absl::StatusOr<Eigen::Vector3d> JsonFields::Vector(const char* field) const {
  const auto n = Numbers(field, 3);
  if (!n.ok()) return n.status();
  return Eigen::Vector3d((*n)[0], (*n)[1], (*n)[2]);
}

absl::StatusOr<const Json*> JsonFields::List(const char* field) const {
  if (!Has(field)) return Error(field, "missing");
  const Json& value = value_->at(field);
  if (!value.is_array() || value.empty()) {
    return Error(field, "expected a list that is not empty, not " + Shown(value));
  }
  return &value;
}

absl::StatusOr<std::vector<Eigen::Vector3d>> JsonFields::Vectors(const char* field) const {
  const auto list = List(field);
  if (!list.ok()) return list.status();
  std::vector<Eigen::Vector3d> vectors;
  for (std::size_t i = 0; i < (*list)->size(); ++i) {
    std::vector<double> n;
    if (!NumbersOf((**list)[i], 3, &n)) {
      return Error(absl::StrCat(field, "[", i, "]"),
                   "expected 3 numbers in a list, not " + Shown((**list)[i]));
    }
    vectors.emplace_back(n[0], n[1], n[2]);
  }
  return vectors;
}

absl::StatusOr<Pose> JsonFields::PoseOrIdentity(const char* field) const {
  if (!Has(field)) return Pose{};
  const auto pose_fields =
      Of(value_->at(field), PathOf(field), {"position_m", "rpy_rad", "rotation_xyzw"});
  if (!pose_fields.ok()) return pose_fields.status();
  Pose pose;
  if (pose_fields->Has("position_m")) {
    const auto position = pose_fields->Vector("position_m");
    if (!position.ok()) return position.status();
    pose.translation = *position;
  }
  if (pose_fields->Has("rpy_rad") && pose_fields->Has("rotation_xyzw")) {
    return pose_fields->Error("rpy_rad", "give this or rotation_xyzw, not both");
  }
  if (pose_fields->Has("rpy_rad")) {
    const auto rpy = pose_fields->Vector("rpy_rad");
    if (!rpy.ok()) return rpy.status();
    pose.rotation = Eigen::AngleAxisd(rpy->z(), Eigen::Vector3d::UnitZ()) *
                    Eigen::AngleAxisd(rpy->y(), Eigen::Vector3d::UnitY()) *
                    Eigen::AngleAxisd(rpy->x(), Eigen::Vector3d::UnitX());
  }
  if (pose_fields->Has("rotation_xyzw")) {
    const auto q = pose_fields->Numbers("rotation_xyzw", 4);
    if (!q.ok()) return q.status();
    const Eigen::Quaterniond rotation((*q)[3], (*q)[0], (*q)[1], (*q)[2]);
    if (!IsNearlyUnit(rotation)) {
      return pose_fields->Error("rotation_xyzw", NotUnitText(rotation));
    }
    pose.rotation = rotation.normalized();
  }
  return pose;
}

}  // namespace clearway::cli
