#include "clearway/planning/state_mapping.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "absl/strings/str_cat.h"
#include "clearway/planning/space_time.h"

namespace clearway {
namespace {

namespace ob = ompl::base;

// Seconds that fit into Time with room to add an epoch: 100 years.
constexpr double kMaxSeconds = 3.2e9;

bool IsFinite(const Pose& pose) {
  return pose.translation.allFinite() && pose.rotation.coeffs().allFinite();
}

}  // namespace

StateMapping::StateMapping(Kind kind, std::size_t links, Kinematics kinematics, MotionBound bound,
                           TimeSource time)
    : kind_(kind),
      links_(links),
      kinematics_(std::make_shared<const Kinematics>(std::move(kinematics))),
      bound_(bound ? std::make_shared<const MotionBound>(std::move(bound)) : nullptr),
      time_(time) {}

absl::Status StateMapping::ValidateSpace(const ob::StateSpace& space, const Robot& robot) const {
  if (robot.links.size() != links_) {
    return absl::InvalidArgumentError(absl::StrCat(
        "mapping: made for ", links_, " links, the checker's robot has ", robot.links.size()));
  }
  if (!slope_ || !(*slope_ >= 0) || !std::isfinite(*slope_)) {
    return absl::InvalidArgumentError(
        "ground.max_slope: must be stated with height_m, finite and at least 0");
  }
  const ob::StateSpace* part = &space;
  if (has_time()) {
    const auto* space_time = dynamic_cast<const SpaceTimeStateSpace*>(&space);
    if (space_time == nullptr) {
      return absl::InvalidArgumentError(absl::StrCat(
          "space: '", space.getName(), "' has no time component; the mapping's time is TimeSince"));
    }
    part = space_time->space().get();
  }
  const int type = part->getType();
  const unsigned int dimension = part->getDimension();
  const bool r_n = type == ob::STATE_SPACE_REAL_VECTOR;
  const bool fits = (kind_ == Kind::kOther) ||
                    (kind_ == Kind::kSe2 && type == ob::STATE_SPACE_SE2) ||
                    (kind_ == Kind::kSe3 && type == ob::STATE_SPACE_SE3) ||
                    (kind_ == Kind::kR2 && r_n && dimension == 2) ||
                    (kind_ == Kind::kR3 && r_n && dimension == 3);
  if (fits) return absl::OkStatus();
  static constexpr const char* kNames[] = {"SE(2)", "SE(3)", "R^2", "R^3"};
  return absl::InvalidArgumentError(absl::StrCat("space: '", part->getName(), "' of dimension ",
                                                 dimension, " is not the mapping's ",
                                                 kNames[static_cast<int>(kind_)]));
}

absl::StatusOr<Time> StateMapping::TimeOf(const ob::State* state) const {
  if (const auto* fixed = std::get_if<FixedTime>(&time_)) return fixed->time;
  const double seconds = SpaceTimeStateSpace::SecondsOf(state);
  if (!(std::abs(seconds) <= kMaxSeconds)) {
    return absl::InvalidArgumentError(
        absl::StrCat("state: time ", seconds, " s is not finite or above ", kMaxSeconds, " s"));
  }
  return std::get<TimeSince>(time_).epoch + FromSeconds(seconds);
}

absl::Status StateMapping::Append(const ob::State* state, StateBatch& batch) const {
  const absl::StatusOr<Time> time = TimeOf(state);
  if (!time.ok()) return time.status();
  const std::size_t old_size = batch.T_W_L.size();
  batch.T_W_L.resize(old_size + links_);
  const std::span<Pose> links = std::span(batch.T_W_L).subspan(old_size);
  (*kinematics_)(has_time() ? SpaceTimeStateSpace::SpacePart(state) : state, links);
  if (!std::ranges::all_of(links, IsFinite)) {
    batch.T_W_L.resize(old_size);
    return absl::InvalidArgumentError("state: the pose of a link is not finite");
  }
  batch.times.push_back(*time);
  return absl::OkStatus();
}

std::optional<double> StateMapping::MotionBoundMetres(const ob::State* from,
                                                      const ob::State* to) const {
  if (bound_ == nullptr) return std::nullopt;
  if (!has_time()) return (*bound_)(from, to);
  return (*bound_)(SpaceTimeStateSpace::SpacePart(from), SpaceTimeStateSpace::SpacePart(to));
}

double StateMapping::LegCount(const ob::StateSpace& space, const ob::State* from,
                              const ob::State* to, double leg_m) const {
  double legs = 1;
  if (kind_ == Kind::kOther || slope_ != 0) {
    const auto bound_m = MotionBoundMetres(from, to);
    // Where it is known how little links stray, their legs may be longer.
    legs = bound_m ? std::ceil(*bound_m / (deviations_ ? 3 * leg_m : leg_m))
                   : static_cast<double>(space.validSegmentCount(from, to));
    if (std::isnan(legs)) return legs;
  }
  if (kind_ == Kind::kOther) return std::max(legs, 1.0);
  // Half a turn may go either way; half of it goes one.
  constexpr double kHalfTurn_rad = 3;
  StateBatch ends;
  if (!Append(from, ends).ok() || !Append(to, ends).ok()) return std::max(legs, 1.0);
  const double turn_rad = ends.T_W_L[0].rotation.angularDistance(ends.T_W_L[links_].rotation);
  return std::max(legs, turn_rad > kHalfTurn_rad ? 2.0 : 1.0);
}

// Two ways from one place to another, of lengths a and b: at no time are they farther apart than
// (a + b) / 2, as one end or the other is no farther than half of its own way from each.
void StateMapping::AppendDeviations(const ob::State* from, const ob::State* to,
                                    std::span<const Pose> T_W_L,
                                    std::vector<double>& deviations_m) const {
  if (deviations_) {
    deviations_m.resize(deviations_m.size() + links_);
    const auto part = [&](const ob::State* state) {
      return has_time() ? SpaceTimeStateSpace::SpacePart(state) : state;
    };
    return deviations_(part(from), part(to), std::span(deviations_m).last(links_));
  }
  const auto bound_m = kind_ == Kind::kOther ? MotionBoundMetres(from, to) : std::nullopt;
  for (std::size_t l = 0; l < links_; ++l) {
    const Pose &before = T_W_L[l], &after = T_W_L[links_ + l];
    const Eigen::Vector3d way = after.translation - before.translation;
    if (bound_m) {
      const double straight_m =
          way.norm() + reaches_m_[l] * before.rotation.angularDistance(after.rotation);
      deviations_m.push_back(0.5 * (*bound_m + straight_m));
    } else {
      deviations_m.push_back(0.5 * slope_.value_or(0) * way.head<2>().norm());
    }
  }
}

}  // namespace clearway
