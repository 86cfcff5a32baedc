#include "clearway/planning/space_time.h"

#include <ompl/base/ProjectionEvaluator.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"
#include "planning/space_time_sampler.h"

namespace clearway {
namespace {

namespace ob = ompl::base;
using TimeState = ob::TimeStateSpace::StateType;

// Rounding of interpolated states must not make a part of a possible motion impossible.
constexpr double kRelativeSlack = 1e-6;
constexpr double kSlackSeconds = 1e-9;
constexpr double kUnreachableExtents = 1e4;

double OfAxes(const ob::StateSpace& space, const SpeedLimits& limits, const ob::State* from,
              const ob::State* to) {
  if (space.getType() != ob::STATE_SPACE_REAL_VECTOR) return 0;
  const auto& a = *from->as<ob::RealVectorStateSpace::StateType>();
  const auto& b = *to->as<ob::RealVectorStateSpace::StateType>();
  double seconds = 0;
  for (std::size_t i = 0; i < limits.axes_per_s.size(); ++i) {
    seconds = std::max(seconds, std::abs(b[i] - a[i]) / limits.axes_per_s[i]);
  }
  return seconds;
}

double MinSecondsIn(const ob::StateSpace& space, const SpeedLimits& limits, const ob::State* from,
                    const ob::State* to) {
  if (space.isCompound()) {
    const auto& compound = *space.as<ob::CompoundStateSpace>();
    const auto& a = *from->as<ob::CompoundState>();
    const auto& b = *to->as<ob::CompoundState>();
    double seconds = 0;
    for (unsigned int i = 0; i < compound.getSubspaceCount(); ++i) {
      seconds = std::max(seconds, MinSecondsIn(*compound.getSubspace(i), limits, a[i], b[i]));
    }
    return seconds;
  }
  const double distance = space.distance(from, to);
  switch (space.getType()) {
    case ob::STATE_SPACE_SO2:
      return distance / limits.rotation_radps;
    case ob::STATE_SPACE_SO3:
      return 2 * distance / limits.rotation_radps;  // OMPL's is the angle between quaternions
    default:
      return std::max(distance / limits.translation_mps, OfAxes(space, limits, from, to));
  }
}

// The projection of the space part, and time. R^n is projected here: the default projection of R^1
// and R^2 aborts in OMPL 1.5.2 (RealVectorIdentityProjectionEvaluator::project maps bytes as
// doubles).
class SpaceTimeProjection : public ob::ProjectionEvaluator {
 public:
  static bool CanProject(const ob::StateSpace& part) {
    return part.getType() == ob::STATE_SPACE_REAL_VECTOR || part.hasDefaultProjection();
  }

  explicit SpaceTimeProjection(const SpaceTimeStateSpace* space) : ob::ProjectionEvaluator(space) {
    if (space->space()->getType() == ob::STATE_SPACE_REAL_VECTOR) {
      size_ = std::min(2u, space->space()->getDimension());
    } else {
      part_ = space->space()->getDefaultProjection();
      size_ = part_->getDimension();
    }
  }

  unsigned int getDimension() const override { return size_ + 1; }

  void project(const ob::State* state, Eigen::Ref<Eigen::VectorXd> projection) const override {
    const ob::State* part = SpaceTimeStateSpace::SpacePart(state);
    if (part_ != nullptr) {
      part_->project(part, projection.head(size_));
    } else {
      const auto& coordinates = *part->as<ob::RealVectorStateSpace::StateType>();
      for (unsigned int i = 0; i < size_; ++i) projection[i] = coordinates[i];
    }
    projection[size_] = SpaceTimeStateSpace::SecondsOf(state);
  }

 private:
  ob::ProjectionEvaluatorPtr part_;  // null for R^n
  unsigned int size_;
};

}  // namespace

SpaceTimeStateSpace::SpaceTimeStateSpace(ob::StateSpacePtr space, SpeedLimits limits,
                                         Duration latest, double time_weight)
    : limits_(std::move(limits)), focus_latest_s_(ToSeconds(latest)) {
  setName("SpaceTime" + getName());
  addSubspace(std::move(space), 1 - time_weight);
  auto time = std::make_shared<ob::TimeStateSpace>();
  time->setBounds(0, std::max(0.0, ToSeconds(latest)));  // it throws at less
  addSubspace(time, time_weight);
  lock();
}

double SpaceTimeStateSpace::SecondsOf(const ob::State* state) {
  return state->as<ob::CompoundState>()->as<TimeState>(1)->position;
}

void SpaceTimeStateSpace::SetSeconds(ob::State* state, double seconds) {
  state->as<ob::CompoundState>()->as<TimeState>(1)->position = seconds;
}

const ob::State* SpaceTimeStateSpace::SpacePart(const ob::State* state) {
  return (*state->as<ob::CompoundState>())[0];
}

ob::State* SpaceTimeStateSpace::SpacePart(ob::State* state) {
  return (*state->as<ob::CompoundState>())[0];
}

double SpaceTimeStateSpace::latest_s() const {
  return components_[1]->as<ob::TimeStateSpace>()->getMaxTimeBound();
}

double SpaceTimeStateSpace::MinSeconds(const ob::State* from_part, const ob::State* to_part) const {
  return MinSecondsIn(*space(), limits_, from_part, to_part);
}

bool SpaceTimeStateSpace::CanReach(const ob::State* from, const ob::State* to) const {
  const double seconds = SecondsOf(to) - SecondsOf(from);
  return seconds * (1 + kRelativeSlack) + kSlackSeconds >=
         MinSeconds(SpacePart(from), SpacePart(to));
}

double SpaceTimeStateSpace::UnreachableDistance() const {
  return kUnreachableExtents * getMaximumExtent();
}

double SpaceTimeStateSpace::distance(const ob::State* from, const ob::State* to) const {
  if (!CanReach(from, to)) return UnreachableDistance();
  return weights_[0] * space()->distance(SpacePart(from), SpacePart(to)) +
         weights_[1] * std::abs(SecondsOf(to) - SecondsOf(from));
}

void SpaceTimeStateSpace::Focus(const ob::State* start, const ob::State* goal_part,
                                double latest_s) {
  focus_start_s_ = SecondsOf(start);
  focus_latest_s_ = latest_s;
  focus_start_part_ = OwnedState(space()->cloneState(SpacePart(start)), {space()});
  focus_goal_part_ = OwnedState(space()->cloneState(goal_part), {space()});
}

std::pair<double, double> SpaceTimeStateSpace::VisitableSeconds(const ob::State* part) const {
  if (focus_start_part_ == nullptr) return {0, latest_s()};
  return {focus_start_s_ + MinSeconds(focus_start_part_.get(), part),
          focus_latest_s_ - MinSeconds(part, focus_goal_part_.get())};
}

bool SpaceTimeStateSpace::OnStraightWay(double fraction, ob::State* part) const {
  if (focus_start_part_ == nullptr) return false;
  space()->interpolate(focus_start_part_.get(), focus_goal_part_.get(), fraction, part);
  return true;
}

double SpaceTimeStateSpace::StraightLength() const {
  if (focus_start_part_ == nullptr) return 0;
  return space()->distance(focus_start_part_.get(), focus_goal_part_.get());
}

ob::StateSamplerPtr SpaceTimeStateSpace::allocDefaultStateSampler() const {
  return std::make_shared<SpaceTimeSampler>(this);
}

void SpaceTimeStateSpace::registerProjections() {
  if (SpaceTimeProjection::CanProject(*space())) {
    registerDefaultProjection(std::make_shared<SpaceTimeProjection>(this));
  }
}

void SpaceTimeStateSpace::sanityChecks() const {
  constexpr unsigned int kMetricOnly =
      STATESPACE_DISTANCE_SYMMETRIC | STATESPACE_TRIANGLE_INEQUALITY | STATESPACE_DISTANCE_BOUND;
  sanityChecks(std::numeric_limits<double>::epsilon(), std::numeric_limits<float>::epsilon(),
               ~kMetricOnly);
}

namespace {

constexpr double kLongest_s = 3e9;  // nearly a century; StateMapping knows no more

absl::Status ValidateLimit(const std::string& name, double limit) {
  if (limit > 0) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat(name, ": is ", NumberText(limit), ", must be above 0"));
}

absl::Status ValidatePart(const ob::StateSpace& space, const SpeedLimits& limits) {
  constexpr double kWidest = 1e9;
  if (space.isCompound()) {
    for (const auto& part : space.as<ob::CompoundStateSpace>()->getSubspaces()) {
      if (auto status = ValidatePart(*part, limits); !status.ok()) return status;
    }
  }
  if (space.getType() != ob::STATE_SPACE_REAL_VECTOR) return absl::OkStatus();
  const std::size_t axes = limits.axes_per_s.size();
  if (axes != 0 && axes != space.getDimension()) {
    return absl::InvalidArgumentError(absl::StrCat(
        "limits.axes_per_s: has ", axes, " limits; R^n has ", space.getDimension(), " axes"));
  }
  const ob::RealVectorBounds& bounds = space.as<ob::RealVectorStateSpace>()->getBounds();
  for (std::size_t i = 0; i < bounds.low.size(); ++i) {
    const double low = bounds.low[i], high = bounds.high[i];
    if (low <= high && high - low <= kWidest) continue;
    return absl::InvalidArgumentError(absl::StrCat("bounds[", i, "]: are ", NumberText(low), " to ",
                                                   NumberText(high), ", must ascend by at most ",
                                                   NumberText(kWidest)));
  }
  return absl::OkStatus();
}

}  // namespace

absl::Status Validate(const SpaceTimeStateSpace& space) {
  const SpeedLimits& limits = space.limits();
  absl::Status status = ValidateLimit("limits.translation_mps", limits.translation_mps);
  if (status.ok()) status = ValidateLimit("limits.rotation_radps", limits.rotation_radps);
  for (std::size_t i = 0; status.ok() && i < limits.axes_per_s.size(); ++i) {
    status = ValidateLimit(absl::StrCat("limits.axes_per_s[", i, "]"), limits.axes_per_s[i]);
  }
  if (status.ok()) status = ValidateLimit("latest", space.latest_s());
  if (status.ok() && space.latest_s() > kLongest_s) {
    status = absl::InvalidArgumentError(absl::StrCat("latest: is ", NumberText(space.latest_s()),
                                                     " s, above the limit of ",
                                                     NumberText(kLongest_s), " s"));
  }
  return status.ok() ? ValidatePart(*space.space(), limits) : status;
}

}  // namespace clearway
