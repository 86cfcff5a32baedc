// Samples of space-time that a planner can use.
#pragma once

#include <ompl/base/ScopedState.h>
#include <ompl/base/StateSampler.h>

#include "clearway/planning/space_time.h"

namespace clearway {

// Uniform samples are uniform in space, then uniform over the times at which that place can be
// visited (SpaceTimeStateSpace::Focus). Under Focus many of them lie on the straight way from start
// to goal, and some near it: past moving things, the right speed on the straight way is often all
// it takes (Kant and Zucker, "Toward Efficient Trajectory Planning: The Path-Velocity
// Decomposition", 1986). Samples near a state lie after it, where the speed limits let it go:
// planners that expand a tree by such samples (EST, KPIECE) would otherwise propose a motion back
// in time every second time. One thread at a time, as every OMPL sampler.
class SpaceTimeSampler : public ompl::base::StateSampler {
 public:
  explicit SpaceTimeSampler(const SpaceTimeStateSpace* space);

  void sampleUniform(ompl::base::State* state) override;
  void sampleUniformNear(ompl::base::State* state, const ompl::base::State* near,
                         double distance) override;
  void sampleGaussian(ompl::base::State* state, const ompl::base::State* mean,
                      double std_dev) override;

 private:
  void SamplePart(ompl::base::State* part);
  // Gives `state`, whose space part is drawn, a time after `from`: up to slack_s later than the
  // limits need.
  void DrawTimeAfter(const ompl::base::State* from, double slack_s, ompl::base::State* state);

  const SpaceTimeStateSpace* space_time_;
  ompl::base::StateSamplerPtr part_sampler_;
  ompl::base::ScopedState<> mean_;  // scratch
};

}  // namespace clearway
