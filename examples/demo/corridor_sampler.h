// Samples of space-time near the straight way.
#pragma once

#include <ompl/base/StateSampler.h>

#include "clearway/planning/space_time.h"
#include "demo/crossing.h"

namespace clearway::demo {

// A crossing is mostly a matter of when, not of where: most samples lie near the straight way,
// heading along it, at any time at which they can be reached and the goal still can be from there;
// the others are uniform, so that every solution stays possible. Used by one thread.
class CorridorSampler : public ompl::base::StateSampler {
 public:
  // `space` is over SE(2).
  CorridorSampler(const SpaceTimeStateSpace* space, const Crossing& crossing);

  void sampleUniform(ompl::base::State* state) override;
  void sampleUniformNear(ompl::base::State* state, const ompl::base::State* near,
                         double distance) override;
  void sampleGaussian(ompl::base::State* state, const ompl::base::State* mean,
                      double deviation) override;

 private:
  const SpaceTimeStateSpace* space_time_;
  Crossing crossing_;
  ompl::base::StateSamplerPtr uniform_;
};

}  // namespace clearway::demo
