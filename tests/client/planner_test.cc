// Plans and watches over gRPC.
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "clearway/client/remote_checker.h"
#include "clearway/client/remote_planner.h"
#include "clearway/client/scene_client.h"
#include "clearway/collision/scene_checker.h"
#include "planning/solved_tasks.h"
#include "support/test_server.h"

namespace clearway {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing_support::TestServer;

GivenObject Post(ObjectId id, double x_m, double y_m) {
  GivenObject post;
  post.id = id;
  post.shape = Cylinder{0.5, 2};
  post.pose = {Time(), Pose::Translation(x_m, y_m, 0)};
  return post;
}

// The server's scene is of the beginning of time.
PlanTask AcrossTheServersPlace() {
  PlanTask task = AcrossThePlace();
  task.start_time = Time() + seconds(1);
  return task;
}

class PlannerTest : public testing::Test {
 protected:
  void SetUp() override {
    connection_ = server_.Connect();
    ASSERT_TRUE(SceneClient(connection_).AddObjects(std::vector{Post(1, 0, 0)}).ok());
    auto planner = RemotePlanner::For(connection_, Disc());
    ASSERT_TRUE(planner.ok()) << planner.status();
    planner_ = *std::move(planner);
  }
  // The first plan.
  Plan AnyPlan() {
    Plan first;
    const auto outcome =
        planner_->Plan(AcrossTheServersPlace(), seconds(10), [&](const Plan& plan) {
          first = plan;
          return false;
        });
    EXPECT_TRUE(outcome.ok()) << outcome.status();
    return first;
  }

  TestServer server_;
  std::shared_ptr<Connection> connection_;
  std::unique_ptr<RemotePlanner> planner_;
};

TEST_F(PlannerTest, PlansComeAsTheyAreFoundAndAreProvedAgainByTheServerAndHere) {
  std::vector<Plan> plans;
  const auto outcome =
      planner_->Plan(AcrossTheServersPlace(), milliseconds(300), [&](const Plan& plan) {
        plans.push_back(plan);
        return true;
      });
  ASSERT_TRUE(outcome.ok()) << outcome.status();
  EXPECT_EQ(outcome->status, PlanStatus::kFound);
  EXPECT_EQ(outcome->version, server_.Newest()->version);
  ASSERT_FALSE(plans.empty());
  const MotionOptions options = AcrossTheServersPlace().options;
  const SceneChecker here(server_.Newest(), Disc());
  const auto there = RemoteChecker::Pin(connection_, Disc());
  ASSERT_TRUE(there.ok());
  for (const Plan& plan : plans) {
    EXPECT_EQ(plan.configurations.front(), (std::vector<double>{-4, 0}));
    EXPECT_EQ(plan.configurations.back(), (std::vector<double>{4, 0}));
    for (const StateChecker* checker : {static_cast<const StateChecker*>(&here),
                                        static_cast<const StateChecker*>(there->get())}) {
      const auto proof = checker->CheckMotions(plan.motion, options);
      ASSERT_TRUE(proof.ok()) << proof.status();
      EXPECT_EQ(proof->answers[0].status, SpaceStatus::kFree);
    }
  }
  EXPECT_LT(ToSeconds(plans.back().times.back() - AcrossTheServersPlace().start_time), 9);
}

TEST_F(PlannerTest, EndsWhenAPlanIsGoodEnough) {
  int plans = 0;
  const auto begin = std::chrono::steady_clock::now();
  const auto outcome = planner_->Plan(AcrossTheServersPlace(), seconds(50), [&](const Plan&) {
    ++plans;
    return false;
  });
  EXPECT_LT(std::chrono::steady_clock::now() - begin, seconds(20));
  ASSERT_TRUE(outcome.ok()) << outcome.status();
  EXPECT_EQ(outcome->status, PlanStatus::kFound);
  EXPECT_EQ(plans, 1);
  while (server_.core().plans.size() > 0)
    std::this_thread::sleep_for(milliseconds(1));  // it stops too
}

TEST_F(PlannerTest, SaysWhatBlocksTheGoal) {
  PlanTask task = AcrossTheServersPlace();
  task.goal = {0, 0.3};
  const auto outcome = planner_->Plan(task, milliseconds(50), [](const Plan&) { return true; });
  ASSERT_TRUE(outcome.ok()) << outcome.status();
  EXPECT_EQ(outcome->status, PlanStatus::kGoalBlocked);
  EXPECT_EQ(outcome->blocker.status, SpaceStatus::kOccupied);
  EXPECT_EQ(outcome->blocker.object, 1);
}

TEST_F(PlannerTest, ARobotThatTheServerForgotIsRegisteredAgain) {
  for (int i = 0; i < static_cast<int>(connection_->server().limits.max_robots) + 1; ++i) {
    const Robot other = Robot::SingleShape("other", Sphere{0.1 + 0.001 * i});
    ASSERT_TRUE(RemotePlanner::For(connection_, other).ok());
  }
  EXPECT_FALSE(AnyPlan().times.empty());
}

TEST_F(PlannerTest, AWatchTellsOfPlansThatBreakAndMend) {
  const Plan plan = AnyPlan();
  ASSERT_FALSE(plan.times.empty());
  // Two motions: the plan's, and one that is in the post.
  MotionBatch motions = plan.motion;
  motions.knot_counts.push_back(2);
  for (const int second : {100, 101}) {
    motions.times.push_back(Time() + seconds(second));
    motions.T_W_L.push_back(Pose::Translation(0, 0, 0.6));
    motions.deviations_m.push_back(0);
  }
  std::atomic<int> told = 0;
  std::vector<RemotePlanner::News> news;
  std::thread watcher([&] {
    const auto status = planner_->Watch(motions, AcrossTheServersPlace().options,
                                        [&](const RemotePlanner::News& n) {
                                          news.push_back(n);
                                          return ++told < 3;
                                        });
    EXPECT_TRUE(status.ok()) << status;
  });
  const SceneClient client(connection_);
  const auto wait_for = [&](int count) {
    while (told < count) std::this_thread::sleep_for(milliseconds(1));
  };
  wait_for(1);
  ASSERT_TRUE(client.AddObjects(std::vector{Post(2, -1, 4.6)}).ok());  // in nobody's way
  ASSERT_TRUE(client.AddObjects(std::vector{Post(3, 3.6, 0)}).ok());
  wait_for(2);
  ASSERT_TRUE(client.RemoveObjects(std::vector<ObjectId>{3}).ok());
  watcher.join();
  ASSERT_EQ(news.size(), 3u);
  EXPECT_EQ(news[0].broken, std::vector<std::size_t>{1});
  EXPECT_EQ(news[0].reply.answers[1].witness->object, 1);
  EXPECT_EQ(news[1].broken, std::vector<std::size_t>{0});
  EXPECT_EQ(news[1].reply.answers[0].witness->object, 3);
  EXPECT_TRUE(news[1].mended.empty());
  EXPECT_EQ(news[2].mended, std::vector<std::size_t>{0});
  EXPECT_GT(news[2].reply.version, news[1].reply.version);
}

// That nothing was found until then says nothing.
TEST_F(PlannerTest, AServerThatDrainsDoesNotSayThatThereIsNoPlan) {
  PlanTask task = AcrossTheServersPlace();
  GivenObject wall = Post(2, 0, 0);
  wall.shape = Box{{0.2, 12, 2}};
  ASSERT_TRUE(SceneClient(connection_).AddObjects(std::vector{wall}).ok());
  std::thread drain([&] {
    while (server_.core().plans.size() == 0) std::this_thread::sleep_for(milliseconds(1));
    server_.core().draining = true;
  });
  const auto outcome = planner_->Plan(task, seconds(10), [](const Plan&) { return true; });
  drain.join();
  EXPECT_TRUE(absl::IsUnavailable(outcome.status())) << outcome.status();
}

TEST_F(PlannerTest, NoMorePlansAtOnceThanTheLimit) {
  ServerConfig config = testing_support::SmallConfig();
  config.limits.max_plans = 1;
  config.limits.max_planning_s = 30;
  TestServer server(config);
  const auto connection = server.Connect();
  // Round the post there is always a better way to look for.
  ASSERT_TRUE(SceneClient(connection).AddObjects(std::vector{Post(1, 0, 0)}).ok());
  const auto planner = RemotePlanner::For(connection, Disc());
  ASSERT_TRUE(planner.ok());
  const auto good = [](const Plan&) { return false; };
  absl::Status inner;
  const auto outer = (*planner)->Plan(AcrossTheServersPlace(), seconds(20), [&](const Plan&) {
    inner = (*planner)->Plan(AcrossTheServersPlace(), seconds(1), good).status();
    return false;
  });
  EXPECT_TRUE(outer.ok()) << outer.status();
  EXPECT_EQ(inner.code(), absl::StatusCode::kResourceExhausted) << inner;
  while (server.core().plans.size() > 0) std::this_thread::sleep_for(milliseconds(1));
  const auto too_long = (*planner)->Plan(AcrossTheServersPlace(), seconds(31), good);
  EXPECT_EQ(too_long.status().code(), absl::StatusCode::kResourceExhausted);
  EXPECT_EQ(too_long.status().message().rfind("budget_s", 0), 0u);
}

}  // namespace
}  // namespace clearway
