#include "planning/space_time_sampler.h"

#include <algorithm>
#include <cmath>

namespace clearway {

namespace ob = ompl::base;

SpaceTimeSampler::SpaceTimeSampler(const SpaceTimeStateSpace* space)
    : ob::StateSampler(space),
      space_time_(space),
      part_sampler_(space->space()->allocStateSampler()),
      mean_(space->space()) {}

void SpaceTimeSampler::sampleUniform(ob::State* state) {
  constexpr int kAttempts = 32;
  for (int i = 0; i < kAttempts; ++i) {
    ob::State* part = SpaceTimeStateSpace::SpacePart(state);
    SamplePart(part);
    const auto [earliest_s, last_s] = space_time_->VisitableSeconds(part);
    if (earliest_s > last_s) continue;
    SpaceTimeStateSpace::SetSeconds(state, rng_.uniformReal(earliest_s, last_s));
    return;
  }
  // Nearly nothing can be visited in time: any state within the bounds will do.
  SpaceTimeStateSpace::SetSeconds(state, rng_.uniformReal(0, space_time_->latest_s()));
}

void SpaceTimeSampler::SamplePart(ob::State* part) {
  constexpr double kOnStraightWay = 0.4, kNearStraightWay = 0.3;  // shares; the rest is uniform
  constexpr double kAside = 0.1;  // standard deviation, as a share of the straight way
  const double draw = rng_.uniform01();
  if (draw > kOnStraightWay + kNearStraightWay ||
      !space_time_->OnStraightWay(rng_.uniform01(), part)) {
    part_sampler_->sampleUniform(part);
  } else if (draw > kOnStraightWay) {
    mean_ = part;
    part_sampler_->sampleGaussian(part, mean_.get(), kAside * space_time_->StraightLength());
  }
}

void SpaceTimeSampler::sampleUniformNear(ob::State* state, const ob::State* near, double distance) {
  const double weight = space_time_->getSubspaceWeight(0);
  part_sampler_->sampleUniformNear(SpaceTimeStateSpace::SpacePart(state),
                                   SpaceTimeStateSpace::SpacePart(near),
                                   weight > 0 ? distance / weight : distance);
  DrawTimeAfter(near, rng_.uniformReal(0, distance / space_time_->getSubspaceWeight(1)), state);
}

void SpaceTimeSampler::sampleGaussian(ob::State* state, const ob::State* mean, double std_dev) {
  part_sampler_->sampleGaussian(SpaceTimeStateSpace::SpacePart(state),
                                SpaceTimeStateSpace::SpacePart(mean), std_dev);
  DrawTimeAfter(mean, std::abs(rng_.gaussian(0, std_dev)), state);
}

void SpaceTimeSampler::DrawTimeAfter(const ob::State* from, double slack_s, ob::State* state) {
  const double need_s = space_time_->MinSeconds(SpaceTimeStateSpace::SpacePart(from),
                                                SpaceTimeStateSpace::SpacePart(state));
  const double seconds = SpaceTimeStateSpace::SecondsOf(from) + need_s + slack_s;
  SpaceTimeStateSpace::SetSeconds(state, std::min(seconds, space_time_->latest_s()));
}

}  // namespace clearway
