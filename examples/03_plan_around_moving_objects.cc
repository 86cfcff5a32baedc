// Plans a delivery robot's way across a road, around where the traffic will be. One car has told
// what it will do; of the rest, the motion tells. The scene is in this process, on a server, or
// mirrored from one; the planning is the same.
//
//   03_plan_around_moving_objects --in-process
//   clearway-server --scene-horizon-s 12 &
//   03_plan_around_moving_objects --remote 127.0.0.1:50151 --planner EST
//   03_plan_around_moving_objects --mirror 127.0.0.1:50151
#include <ompl/base/ScopedState.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/geometric/planners/est/EST.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/util/Console.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <numbers>

#include "clearway/client/frame_sender.h"
#include "clearway/client/remote_checker.h"
#include "clearway/client/scene_client.h"
#include "clearway/client/scene_mirror.h"
#include "clearway/collision/plan_task.h"
#include "clearway/collision/scene_checker.h"
#include "clearway/planning/path_check.h"
#include "clearway/planning/space_time_setup.h"
#include "clearway/scene/scene_builder.h"
#include "clearway/sim/scenarios.h"

namespace clearway {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using std::chrono::seconds;

struct Settings {
  bool in_process = false;
  std::string remote, mirror;  // or a server's address
  std::string planner = "SafeInterval";
  double planning_s = 3;
};

constexpr Duration kHorizon = seconds(12);  // beyond it, whatever could have moved is not free
constexpr Duration kTick = std::chrono::milliseconds(100);

using CheckerPtr = std::shared_ptr<const StateChecker>;

// The car that will brake for the robot, against what its motion says.
constexpr ObjectId kYielding = 3;

// What that car states, as another robot's planner would: where it will be, every 0.1 s.
ObjectFuture Stated(const Simulation& simulation, const StampedPose& now) {
  ObjectFuture future{kYielding, {}};
  for (Time t = now.stamp + kTick; t <= now.stamp + kHorizon; t += kTick) {
    const Pose H_W = *simulation.world().MotionOf(kYielding, now.stamp, t);
    future.poses.push_back({t, H_W * now.T_W_O});
  }
  return future;
}

// A scene of our own.
absl::StatusOr<CheckerPtr> InProcess(const Simulation& simulation, std::size_t frames,
                                     const Robot& robot) {
  ThreadPool pool(2);
  SceneParams params;
  params.horizon = kHorizon;
  SceneBuilder builder(params, FrameLimits(), pool);
  for (std::size_t k = 0; k < frames; ++k) {
    if (auto report = builder.Apply(simulation.MakeFrame(k)); !report.ok()) return report.status();
  }
  const auto seen = builder.Publish();
  const ObjectFuture future = Stated(simulation, seen->FindObject(kYielding)->history.back());
  if (auto status = builder.SetFuture(future.id, future.poses); !status.ok()) return status;
  return std::make_shared<SceneChecker>(builder.Publish(), robot);
}

// A server's scene: checked over there, or mirrored and checked here.
absl::StatusOr<CheckerPtr> OnServer(const Settings& settings, const Simulation& simulation,
                                    std::size_t frames, const Robot& robot) {
  const bool mirrored = settings.remote.empty();
  auto connection = Connection::Open(mirrored ? settings.mirror : settings.remote);
  if (!connection.ok()) return connection.status();
  SceneQuery latest;  // with all that we tell
  for (std::size_t k = 0; k < frames; ++k) {
    const auto ack = FrameSender(*connection).Push(simulation.MakeFrame(k));
    if (!ack.ok()) return ack.status();
    latest.min_version = ack->version;
  }
  const SceneClient client(*connection);
  const auto car = client.GetObject(kYielding, latest);
  if (!car.ok()) return car.status();
  const std::array futures{Stated(simulation, {car->t_k, car->T_W_O})};
  const auto stated = client.SetFutures(futures);
  if (!stated.ok()) return stated.status();

  if (!mirrored) return RemoteChecker::Pin(*connection, robot, {.min_version = stated->version});
  const auto mirror = SceneMirror::Follow(*connection);
  if (!mirror.ok()) return mirror.status();
  const auto scene = (*mirror)->WaitFor(stated->version, seconds(10));
  if (!scene.ok()) return scene.status();
  return std::make_shared<SceneChecker>(*scene, robot);
}

// Where: the road and its pavements. How: 2 m/s and 1.5 rad/s at most, done in time.
std::shared_ptr<SpaceTimeStateSpace> Space(const CrossingTask& task) {
  auto plane = std::make_shared<ob::SE2StateSpace>();
  ob::RealVectorBounds bounds(2);
  for (int axis : {0, 1}) {
    bounds.setLow(axis, task.area_W.min[axis]);
    bounds.setHigh(axis, task.area_W.max[axis]);
  }
  plane->setBounds(bounds);
  const SpeedLimits limits{.translation_mps = task.max_speed_mps, .rotation_radps = 1.5};
  return std::make_shared<SpaceTimeStateSpace>(plane, limits, task.time_limit);
}

// What counts as free. Beams leave holes, so some unknown space within the robot is tolerated.
// Traffic may not do what its motion predicts, so the robot keeps clear of everything, and of
// moving objects the more the longer the prediction.
PlanningOptions WhatIsFree() {
  PlanningOptions options;
  options.check.unknown = UnknownPolicy::kTolerated;
  options.check.max_unknown_fraction = 0.3;
  options.check.padding_m = 0.15;
  options.check.inflation_mps = 0.2;
  options.step_m = 0.1;
  options.time_step = std::chrono::milliseconds(50);
  return options;
}

// The planner at work, and its path. Whatever of OMPL's planners goes forward in time may stand in
// for the setup's own.
absl::StatusOr<og::PathGeometric> Solve(og::SimpleSetup& setup, const Settings& settings) {
  const ob::SpaceInformationPtr& si = setup.getSpaceInformation();
  if (settings.planner == "RRT") setup.setPlanner(std::make_shared<og::RRT>(si));
  if (settings.planner == "EST") setup.setPlanner(std::make_shared<og::EST>(si));
  const ob::PlannerStatus solved = setup.solve(settings.planning_s);
  const StateQuery& query = *QueryOf(*si);
  if (!query.first_error().ok()) return query.first_error();
  if (solved != ob::PlannerStatus::EXACT_SOLUTION) {
    return absl::NotFoundError(settings.planner + ": no path found, " + solved.asString());
  }
  return setup.getSolutionPath();
}

// Plans from the checker's stamp on. From here on nothing depends on where the scene is.
absl::StatusOr<std::vector<TimedPose>> Plan(const CrossingTask& task, const CheckerPtr& checker,
                                            const Settings& settings) {
  const auto space = Space(task);
  const PlanningOptions options = WhatIsFree();
  Ground ground;
  ground.clearance_m = DefaultGroundClearance(SceneParams{}.resolution_m, options.check.padding_m);
  const auto mapping = StateMapping::Se2(checker->robot(), ground, TimeSince{checker->stamp()});

  ob::ScopedState<> start(space), goal(space);
  start = std::vector<double>{task.start_W.x(), task.start_W.y(), std::numbers::pi / 2, 0};
  goal = std::vector<double>{task.goal_W.x(), task.goal_W.y(), std::numbers::pi / 2, 0};
  const auto setup = MakeSpaceTimeSetup(space, checker, mapping, options, start.get(),
                                        SpaceTimeStateSpace::SpacePart(goal.get()), GoalOptions());
  if (!setup.ok()) return setup.status();
  auto path = Solve(**setup, settings);
  if (!path.ok()) return path.status();

  const PathCheck check = CheckPath(*path, *QueryOf(*(*setup)->getSpaceInformation()));
  std::printf("%s: %zu states, %s on version %llu, %.0f %% of its volume unknown\n",
              settings.planner.c_str(), path->getStateCount(), check.free ? "free" : "blocked",
              static_cast<unsigned long long>(checker->version()),
              100 * check.unknown_fraction.value_or(1));
  path->interpolate(static_cast<unsigned int>(check.answers.size()));
  return TimedPoses(*path, mapping);
}

// What the plan would really have touched.
std::optional<ObjectId> Touched(const Simulation& simulation, const Robot& robot,
                                const std::vector<TimedPose>& plan) {
  for (const TimedPose& step : plan) {
    const auto& shape = robot.links[0].shapes[0].shape;
    if (auto hit = simulation.world().Touched(shape, step.T_W_L, step.time)) return hit;
  }
  return std::nullopt;
}

absl::Status Run(const Settings& settings) {
  const absl::StatusOr<Simulation> simulation = MakeScenario("crossing");
  if (!simulation.ok()) return simulation.status();
  const CrossingTask& task = simulation->spec().tasks[0];
  const Robot robot = Robot::SingleShape("delivery", Box{task.robot_size_m});

  const std::size_t frames = task.planning_frame + 1;
  const auto checker = settings.in_process ? InProcess(*simulation, frames, robot)
                                           : OnServer(settings, *simulation, frames, robot);
  if (!checker.ok()) return checker.status();
  const auto plan = Plan(task, *checker, settings);
  if (!plan.ok()) return plan.status();
  for (std::size_t i = 0; i < plan->size(); i += std::max<std::size_t>(1, plan->size() / 10)) {
    const TimedPose& step = (*plan)[i];
    std::printf("  %5.2f s  (%6.2f, %6.2f)\n", ToSeconds(step.time - (*checker)->stamp()),
                step.T_W_L.translation.x(), step.T_W_L.translation.y());
  }
  if (const auto hit = Touched(*simulation, robot, *plan)) {
    return absl::InternalError("the plan touches object " + std::to_string(*hit) +
                               ", which did not do what was predicted");
  }
  std::printf("arrives after %.2f s and touches nothing\n",
              ToSeconds(plan->back().time - (*checker)->stamp()));
  return absl::OkStatus();
}

}  // namespace
}  // namespace clearway

int main(int argc, char** argv) {
  CLI::App app("Plans a robot's way across a road with moving traffic.");
  clearway::Settings settings;
  auto* where = app.add_option_group("scene", "Where the scene is");
  where->add_flag("--in-process", settings.in_process, "In this process");
  where->add_option("--remote", settings.remote,
                    "On the server at this address, started with --scene-horizon-s 12");
  where->add_option("--mirror", settings.mirror,
                    "Mirrored from the server at this address, likewise");
  where->require_option(1);
  app.add_option("--planner", settings.planner)
      ->check(CLI::IsMember({"SafeInterval", "RRT", "EST"}));
  app.add_option("--planning-time", settings.planning_s, "Seconds to plan for")
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  ompl::msg::setLogLevel(ompl::msg::LOG_WARN);

  const absl::Status status = clearway::Run(settings);
  if (!status.ok()) std::fprintf(stderr, "%s\n", status.ToString().c_str());
  return status.ok() ? 0 : 1;
}
