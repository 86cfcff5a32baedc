#include "collision/validation.h"

#include <limits>
#include <string>

#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"
#include "clearway/scene/frame.h"

namespace clearway {
namespace {

constexpr double kMaxDistance_m = 1e5;
constexpr double kMaxInflation_mps = 1e3, kMaxBoundMultiple = 100;

absl::Status Invalid(const std::string& field, const std::string& what) {
  return absl::InvalidArgumentError(absl::StrCat(field, " ", what));
}

absl::Status CheckBetween(const char* field, double value, double low, double high) {
  if (value >= low && value <= high) return absl::OkStatus();  // false for NaN
  return Invalid(field, absl::StrCat("is ", NumberText(value), "; it must lie between ",
                                     NumberText(low), " and ", NumberText(high)));
}

absl::Status CheckLists(const CheckOptions& options, const Robot& robot) {
  for (std::size_t i = 0; i < options.known_free_W.size(); ++i) {
    const Aabb& box = options.known_free_W[i];
    if (box.min.allFinite() && box.max.allFinite() && !box.Empty()) continue;
    return Invalid(absl::StrCat("known_free[", i, "]"),
                   "must be finite with min at most max on each axis");
  }
  for (std::size_t i = 0; i < options.ignored_objects.size(); ++i) {
    if (options.ignored_objects[i] > 0) continue;
    return Invalid(absl::StrCat("ignored_objects[", i, "]"),
                   absl::StrCat("is ", options.ignored_objects[i],
                                "; an object's id is at least 1 (the static map is not ignored)"));
  }
  for (std::size_t i = 0; i < options.allowed_contacts.size(); ++i) {
    const auto& [link, object] = options.allowed_contacts[i];
    const std::string field = absl::StrCat("allowed_contacts[", i, "]");
    if (link < 0 || link >= static_cast<int>(robot.links.size())) {
      return Invalid(absl::StrCat(field, ".link"),
                     absl::StrCat("is ", link, "; the robot has ", robot.links.size(), " links"));
    }
    if (object < kStaticLabel) {
      return Invalid(absl::StrCat(field, ".object_id"),
                     absl::StrCat("is ", object, "; it must be at least 0"));
    }
  }
  return absl::OkStatus();
}

}  // namespace

absl::Status Validate(const CheckOptions& options, const Robot& robot) {
  const UnknownPolicy unknown = options.unknown;
  if (unknown != UnknownPolicy::kBlocked && unknown != UnknownPolicy::kFree &&
      unknown != UnknownPolicy::kTolerated) {
    return Invalid("unknown", absl::StrCat("is ", static_cast<int>(unknown), ", not a policy"));
  }
  for (const absl::Status& status :
       {CheckBetween("max_unknown_fraction", options.max_unknown_fraction, 0, 1),
        CheckBetween("padding_m", options.padding_m, 0, kMaxDistance_m),
        CheckBetween("inflation_mps", options.inflation_mps, 0, kMaxInflation_mps),
        CheckBetween("bound_multiple", options.bound_multiple, 0, kMaxBoundMultiple),
        CheckBetween("clearance_up_to_m", options.clearance_up_to_m.value_or(0), 0, kMaxDistance_m),
        CheckLists(options, robot)}) {
    if (!status.ok()) return status;
  }
  return absl::OkStatus();
}

absl::Status Validate(const StateBatch& states, const Robot& robot) {
  return ValidateStates(states.times, states.T_W_L, robot);
}

absl::Status ValidateTime(const std::string& field, Time time) {
  const std::int64_t time_ns = ToNanoseconds(time);
  if (time_ns >= -kFarthest_ns && time_ns <= kFarthest_ns) return absl::OkStatus();
  return Invalid(field,
                 absl::StrCat("is ", time_ns, "; it must lie within ", kFarthest_ns, " of 0"));
}

absl::Status ValidateStates(const std::vector<Time>& times, const std::vector<Pose>& T_W_L,
                            const Robot& robot) {
  const std::size_t links = robot.links.size();
  if (T_W_L.size() != times.size() * links) {
    return Invalid("world_from_link",
                   absl::StrCat("has ", T_W_L.size(), " poses; ", times.size(), " states of ",
                                links, " links need ", times.size() * links));
  }
  for (std::size_t s = 0; s < times.size(); ++s) {
    if (ValidateTime("", times[s]).ok()) continue;
    return ValidateTime(absl::StrCat("times_ns[", s, "]"), times[s]);
  }
  for (std::size_t i = 0; i < T_W_L.size(); ++i) {
    constexpr double kAnywhere_m = std::numeric_limits<double>::max();
    if (ValidatePose("", T_W_L[i], kAnywhere_m).ok()) continue;
    return ValidatePose(absl::StrCat("world_from_link[", i, "]"), T_W_L[i], kAnywhere_m);
  }
  return absl::OkStatus();
}

}  // namespace clearway
