#include "clearway/scene/frame.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "absl/container/flat_hash_map.h"
#include "absl/container/flat_hash_set.h"
#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"
#include "clearway/geometry/unit_quaternion.h"

namespace clearway {
namespace {

absl::Status Invalid(const std::string& field, const std::string& what) {
  return absl::InvalidArgumentError(absl::StrCat(field, ": ", what));
}

absl::Status CheckLengths(const Frame& frame, const FrameLimits& limits) {
  const std::size_t points = frame.points_S.size();
  if (points > limits.max_points) {
    return absl::ResourceExhaustedError(
        absl::StrCat("points_m: ", points, " points; the limit is ", limits.max_points));
  }
  if (frame.motions.size() + frame.poses.size() > limits.max_objects) {
    return absl::ResourceExhaustedError(
        absl::StrCat("motions: ", frame.motions.size() + frame.poses.size(),
                     " motions and poses; the limit is ", limits.max_objects));
  }
  const auto check = [&](const char* field, std::size_t size, bool may_be_empty) {
    if (size == points || (may_be_empty && size == 0)) return absl::OkStatus();
    return Invalid(field, absl::StrCat("has ", size, " entries for ", points, " points"));
  };
  if (auto status = check("labels", frame.labels.size(), false); !status.ok()) return status;
  if (auto status = check("no_return", frame.no_return.size(), true); !status.ok()) return status;
  return check("origins_m", frame.origins_S.size(), true);
}

absl::Status CheckParts(const Frame& frame, const FrameLimits& limits) {
  if (frame.parts.size() > limits.max_objects) {
    return absl::ResourceExhaustedError(
        absl::StrCat("parts: ", frame.parts.size(), " parts; the limit is ", limits.max_objects));
  }
  absl::flat_hash_map<ObjectId, ObjectId> wholes;
  for (std::size_t i = 0; i < frame.parts.size(); ++i) {
    const auto [id, whole] = frame.parts[i];
    const std::string id_field = absl::StrCat("parts[", i, "].object_id");
    const std::string whole_field = absl::StrCat("parts[", i, "].whole_id");
    if (id <= kStaticLabel) {
      return Invalid(id_field, absl::StrCat("is ", id, "; object ids start at 1"));
    }
    if (whole < kStaticLabel) {
      return Invalid(whole_field,
                     absl::StrCat("is ", whole, "; object ids start at 1, and 0 is no object"));
    }
    if (id == whole) return Invalid(whole_field, absl::StrCat("is object ", id, " itself"));
    if (!wholes.emplace(id, whole).second) {
      return Invalid(id_field, absl::StrCat("object ", id, " is told to be a part twice"));
    }
  }
  for (std::size_t i = 0; i < frame.parts.size(); ++i) {
    const auto of_whole = wholes.find(frame.parts[i].whole);
    if (of_whole == wholes.end() || of_whole->second == kStaticLabel) continue;
    return Invalid(absl::StrCat("parts[", i, "].whole_id"),
                   absl::StrCat("object ", of_whole->first, " is itself a part, of object ",
                                of_whole->second));
  }
  return absl::OkStatus();
}

absl::Status CheckLabels(const Frame& frame) {
  ObjectId lowest = kIgnoreLabel;
  for (const ObjectId label : frame.labels) lowest = std::min(lowest, label);
  if (lowest == kIgnoreLabel) return absl::OkStatus();
  const auto first =
      std::ranges::find_if(frame.labels, [](ObjectId l) { return l < kIgnoreLabel; });
  return Invalid(absl::StrCat("labels[", first - frame.labels.begin(), "]"),
                 absl::StrCat("is ", *first, "; the lowest label is -1"));
}

absl::Status CheckId(const std::string& field, ObjectId id, absl::flat_hash_set<ObjectId>& seen) {
  if (id <= kStaticLabel) {
    return Invalid(field, absl::StrCat("is ", id, "; object ids start at 1"));
  }
  if (!seen.insert(id).second) {
    return Invalid(field, absl::StrCat("object ", id, " has more than one motion or pose"));
  }
  return absl::OkStatus();
}

absl::Status CheckMotion(const std::string& field, const ObjectMotion& motion, const Frame& frame) {
  constexpr double kAnyFinite_m = std::numeric_limits<double>::max();
  if (auto status = ValidatePose(absl::StrCat(field, ".world_motion"), motion.H_W, kAnyFinite_m);
      !status.ok()) {
    return status;
  }
  const std::string from_field = absl::StrCat(field, ".from_stamp_ns");
  if (auto status = ValidateStamp(from_field, motion.from); !status.ok()) return status;
  if (motion.from >= frame.stamp) {
    return Invalid(from_field,
                   absl::StrCat("is ", ToNanoseconds(motion.from),
                                ", not before the frame's stamp ", ToNanoseconds(frame.stamp)));
  }
  return absl::OkStatus();
}

}  // namespace

absl::Status ValidateStamp(const std::string& field, Time stamp) {
  const std::int64_t ns = ToNanoseconds(stamp);
  if (ns >= -kFarthest_ns && ns <= kFarthest_ns) return absl::OkStatus();
  return Invalid(field, absl::StrCat("is ", ns, "; it must lie within 2^62 ns of zero"));
}

absl::Status ValidatePose(const std::string& field, const Pose& pose, double max_coordinate_m) {
  if (!pose.translation.allFinite() || !pose.rotation.coeffs().allFinite()) {
    return Invalid(field, "is not finite");
  }
  if (!IsNearlyUnit(pose.rotation)) {
    return Invalid(absl::StrCat(field, ".rotation"), NotUnitText(pose.rotation));
  }
  const double largest_m = pose.translation.cwiseAbs().maxCoeff();
  if (largest_m > max_coordinate_m) {
    return Invalid(absl::StrCat(field, ".translation_m"),
                   absl::StrCat("reaches ", NumberText(largest_m), " m; the limit is ",
                                NumberText(max_coordinate_m), " m"));
  }
  return absl::OkStatus();
}

absl::Status Validate(const Frame& frame, const FrameLimits& limits) {
  if (auto status = ValidateStamp("stamp_ns", frame.stamp); !status.ok()) return status;
  if (auto status = ValidatePose("world_from_sensor", frame.T_W_S, limits.max_coordinate_m);
      !status.ok()) {
    return status;
  }
  if (auto status = CheckLengths(frame, limits); !status.ok()) return status;
  if (auto status = CheckLabels(frame); !status.ok()) return status;
  if (auto status = CheckParts(frame, limits); !status.ok()) return status;
  absl::flat_hash_set<ObjectId> seen;
  for (std::size_t i = 0; i < frame.motions.size(); ++i) {
    const std::string field = absl::StrCat("motions[", i, "]");
    if (auto status = CheckId(absl::StrCat(field, ".object_id"), frame.motions[i].id, seen);
        !status.ok()) {
      return status;
    }
    if (auto status = CheckMotion(field, frame.motions[i], frame); !status.ok()) {
      return status;
    }
  }
  for (std::size_t i = 0; i < frame.poses.size(); ++i) {
    const std::string field = absl::StrCat("poses[", i, "]");
    if (auto status = CheckId(absl::StrCat(field, ".object_id"), frame.poses[i].id, seen);
        !status.ok()) {
      return status;
    }
    // The scene leaves out one that is too far away, and names it.
    constexpr double kAnywhere_m = std::numeric_limits<double>::max();
    if (auto status =
            ValidatePose(absl::StrCat(field, ".world_from_box"), frame.poses[i].T_W_B, kAnywhere_m);
        !status.ok()) {
      return status;
    }
  }
  return absl::OkStatus();
}

}  // namespace clearway
