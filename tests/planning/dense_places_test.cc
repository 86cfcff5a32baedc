// Where a longer wait is the only way out, and many places nearer to the goal can be come to
// before.
#include <gtest/gtest.h>

#include "clearway/planning/safe_interval_planner.h"
#include "clearway/planning/task_setup.h"
#include "planning/fixtures.h"
#include "planning/solved_tasks.h"

namespace clearway {
namespace {

// Two carts, one after the other, fill a corridor and come towards the disc, which has to let both
// go by in a niche. Between them there are 14 m, which lead nearer to the goal and nowhere else.
ScenePtr CorridorWithNiche() {
  TestWorld world;
  const auto wall = [&](ObjectId id, double from_x_m, double until_x_m, double y_m) {
    world.Given(id, Box{{until_x_m - from_x_m, 0.2, 2}},
                Pose::Translation((from_x_m + until_x_m) / 2, y_m, 1));
  };
  wall(1, -12, 12, -1.1);
  wall(2, -12, -1, 1.1);
  wall(3, 1.2, 12, 1.1);
  for (const double x_m : {-1.1, 1.3}) {
    world.Given(x_m < 0 ? 4 : 5, Box{{0.2, 1.2, 2}}, Pose::Translation(x_m, 1.6, 1));
  }
  for (const double x_m : {10, 24}) {
    const auto cart = [&](double at_s) { return Pose::Translation(x_m - at_s, 0, 0.6); };
    world.Given(x_m < 20 ? 6 : 7, Box{{1.6, 1.4, 1.2}}, cart(0), {}, {{TestTime(60), cart(60)}});
  }
  return world.Scene();
}

TEST(DensePlaces, ADeadEndNearTheGoalDoesNotHideTheWay) {
  constexpr std::size_t kPlaces = 4000;
  PlanTask task = AcrossThePlace();
  task.area_W = {{-11.5, -1, 0}, {11.5, 2.2, 0}};
  task.start = {-9, 0};
  task.goal = {9, 0};
  task.time_limit = std::chrono::seconds(60);
  const auto checker = std::make_shared<SceneChecker>(CorridorWithNiche(), Disc());
  const auto setup = MakeTaskSetup(task, checker);
  ASSERT_TRUE(setup.ok()) << setup.status();
  (*setup)->setup();
  ompl::base::Planner& dut = *(*setup)->getPlanner();
  dut.as<SafeIntervalPlanner>()->SetFirstBatch(kPlaces);
  const auto places = dut.getPlannerProgressProperties().at("places INTEGER");
  const ompl::base::PlannerTerminationCondition until(
      [&] { return (*setup)->haveExactSolutionPath() || std::stoul(places()) > 2 * kPlaces; });
  EXPECT_EQ(dut.solve(until), ompl::base::PlannerStatus::EXACT_SOLUTION);
  EXPECT_LT(std::stoul(places()), 2 * kPlaces);
}

}  // namespace
}  // namespace clearway
