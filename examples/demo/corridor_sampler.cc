#include "demo/corridor_sampler.h"

#include <ompl/base/spaces/SE2StateSpace.h>

namespace clearway::demo {

CorridorSampler::CorridorSampler(const SpaceTimeStateSpace* space, const Crossing& crossing)
    : ompl::base::StateSampler(space),
      space_time_(space),
      crossing_(crossing),
      uniform_(space->allocDefaultStateSampler()) {}

void CorridorSampler::sampleUniform(ompl::base::State* state) {
  constexpr double kShare = 0.8;      // of samples in the corridor
  constexpr double kSidewaysM = 1.0;  // standard deviation
  constexpr double kTurnRad = 0.3;    // standard deviation
  uniform_->sampleUniform(state);
  if (rng_.uniform01() > kShare) return;
  const Eigen::Vector2d way = crossing_.goal_W - crossing_.start_W;
  const Eigen::Vector2d left = Eigen::Vector2d(-way.y(), way.x()).normalized();
  const Eigen::Vector2d p_W =
      crossing_.start_W + rng_.uniformReal(-0.05, 1.05) * way + rng_.gaussian(0, kSidewaysM) * left;
  ompl::base::State* part = SpaceTimeStateSpace::SpacePart(state);
  auto* se2 = part->as<ompl::base::SE2StateSpace::StateType>();
  se2->setXY(p_W.x(), p_W.y());
  se2->setYaw(crossing_.Yaw() + rng_.gaussian(0, kTurnRad));
  space_time_->space()->enforceBounds(part);
  const auto [first_s, last_s] = space_time_->VisitableSeconds(part);
  if (first_s > last_s) return uniform_->sampleUniform(state);
  SpaceTimeStateSpace::SetSeconds(state, rng_.uniformReal(first_s, last_s));
}

void CorridorSampler::sampleUniformNear(ompl::base::State* state, const ompl::base::State* near,
                                        double distance) {
  uniform_->sampleUniformNear(state, near, distance);
}

void CorridorSampler::sampleGaussian(ompl::base::State* state, const ompl::base::State* mean,
                                     double deviation) {
  uniform_->sampleGaussian(state, mean, deviation);
}

}  // namespace clearway::demo
