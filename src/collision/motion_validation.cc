#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"
#include "clearway/collision/motion.h"
#include "collision/validation.h"

namespace clearway {
namespace {

absl::Status Invalid(const std::string& field, const std::string& what) {
  return absl::InvalidArgumentError(absl::StrCat(field, " ", what));
}

// Knots of motions, one after the other.
absl::Status CheckKnots(const MotionBatch& motions) {
  std::size_t knot = 0;
  for (std::size_t m = 0; m < motions.knot_counts.size(); ++m) {
    const std::size_t count = motions.knot_counts[m];
    if (count < 2) {
      return Invalid(absl::StrCat("knot_counts[", m, "]"),
                     absl::StrCat("is ", count, "; a motion has at least 2 knots"));
    }
    if (count > motions.times.size() - knot) {
      return Invalid("times_ns", absl::StrCat("has ", motions.times.size(), " knots; motion ", m,
                                              " needs more"));
    }
    for (std::size_t k = knot + 1; k < knot + count; ++k) {
      if (motions.times[k] > motions.times[k - 1]) continue;
      return Invalid(absl::StrCat("times_ns[", k, "]"),
                     "is not later than that of the knot before");
    }
    knot += count;
  }
  if (knot == motions.times.size()) return absl::OkStatus();
  return Invalid("times_ns",
                 absl::StrCat("has ", motions.times.size(), " knots; the motions have ", knot));
}

absl::Status CheckDeviations(const MotionBatch& motions) {
  const std::vector<double>& deviations_m = motions.deviations_m;
  if (!deviations_m.empty() && deviations_m.size() != motions.T_W_L.size()) {
    return Invalid("deviations_m", absl::StrCat("has ", deviations_m.size(), " entries for ",
                                                motions.T_W_L.size(), " poses"));
  }
  constexpr double kMost_m = 1e5;
  for (std::size_t i = 0; i < deviations_m.size(); ++i) {
    if (deviations_m[i] >= 0 && deviations_m[i] <= kMost_m) continue;
    return Invalid(absl::StrCat("deviations_m[", i, "]"),
                   absl::StrCat("is ", NumberText(deviations_m[i]), "; it must lie between 0 and ",
                                NumberText(kMost_m)));
  }
  return absl::OkStatus();
}

}  // namespace

absl::Status Validate(const MotionBatch& motions, const Robot& robot) {
  if (auto status = ValidateStates(motions.times, motions.T_W_L, robot); !status.ok())
    return status;
  if (auto status = CheckKnots(motions); !status.ok()) return status;
  return CheckDeviations(motions);
}

absl::Status Validate(const MotionOptions& options, const Robot& robot) {
  if (auto status = Validate(options.check, robot); !status.ok()) return status;
  if (options.check.clearance_up_to_m) {
    return Invalid("clearance_up_to_m", "is not answered for motions");
  }
  if (options.check.with_unknown_fraction) {
    return Invalid("with_unknown_fraction", "is not answered for motions");
  }
  if (options.world_at) {
    if (auto status = ValidateTime("world_at_ns", *options.world_at); !status.ok()) return status;
  }
  constexpr double kLeast_m = 1e-4, kMost_m = 10;
  const double resolution_m = options.contact_resolution_m;
  if (resolution_m >= kLeast_m && resolution_m <= kMost_m) return absl::OkStatus();
  return Invalid("contact_resolution_m",
                 absl::StrCat("is ", NumberText(resolution_m), "; it must lie between ",
                              NumberText(kLeast_m), " and ", NumberText(kMost_m)));
}

}  // namespace clearway
