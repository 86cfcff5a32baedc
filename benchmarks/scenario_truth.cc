#include "scenario_truth.h"

#include <algorithm>
#include <cmath>

#include "clearway/planning/space_time.h"

namespace clearway::bench {
namespace {

namespace ob = ompl::base;

Trajectory WayOf(const GivenObject& object) {
  if (!object.future.empty()) {
    WaypointPath path;
    path.points.push_back({object.pose.stamp, object.pose.T_W_O});
    for (const StampedPose& pose : object.future) path.points.push_back({pose.stamp, pose.T_W_O});
    return path;
  }
  if (object.velocity_O)
    return ConstantTwist{object.pose.T_W_O, *object.velocity_O, object.pose.stamp};
  return FixedPose{object.pose.T_W_O};
}

std::optional<ObjectId> TouchedAt(const World& truth, const Robot& robot, const StateBatch& state) {
  const WorldAtTime now(truth, state.times[0]);
  for (std::size_t link = 0; link < robot.links.size(); ++link) {
    for (const LinkShape& part : robot.links[link].shapes) {
      const auto touched = now.Touched(part.shape, state.T_W_L[link] * part.T_L_G);
      if (touched) return touched;
    }
  }
  return std::nullopt;
}

}  // namespace

World TruthOf(const cli::Scenario& scenario) {
  World world;
  for (const GivenObject& object : scenario.objects) {
    world.Add(Body::Single(object.id, "", object.shape, WayOf(object)));
  }
  return world;
}

std::optional<ObjectId> FirstTouched(const World& truth, const Robot& robot,
                                     const ompl::geometric::PathGeometric& path,
                                     const StateMapping& mapping, Duration step) {
  const ob::StateSpace& space = *path.getSpaceInformation()->getStateSpace();
  ob::State* const state = space.allocState();
  std::optional<ObjectId> touched;
  for (std::size_t i = 1; i < path.getStateCount() && !touched; ++i) {
    const ob::State *from = path.getState(i - 1), *to = path.getState(i);
    const double seconds =
        SpaceTimeStateSpace::SecondsOf(to) - SpaceTimeStateSpace::SecondsOf(from);
    const int steps = std::max(1, static_cast<int>(std::ceil(seconds / ToSeconds(step))));
    for (int k = 0; k <= steps && !touched; ++k) {
      space.interpolate(from, to, static_cast<double>(k) / steps, state);
      StateBatch batch;
      if (mapping.Append(state, batch).ok()) touched = TouchedAt(truth, robot, batch);
    }
  }
  space.freeState(state);
  return touched;
}

}  // namespace clearway::bench
