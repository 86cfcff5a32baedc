// Intervals found in process, in a mirror, by the server, and by a search here that asks the
// server: the same.
#include <gtest/gtest.h>

#include "clearway/client/remote_checker.h"
#include "clearway/client/scene_mirror.h"
#include "clearway/collision/scene_checker.h"
#include "collision/random_motions.h"
#include "collision/random_world.h"
#include "support/test_server.h"

namespace clearway {
namespace {

using Intervals = std::vector<std::vector<TimeInterval>>;

// A small batch limit: questions go in pieces.
ServerConfig PiecewiseConfig() {
  ServerConfig config = testing_support::SmallConfig();
  config.limits.max_states_per_batch = 7;
  return config;
}

// Of intervals in all.
std::size_t Count(const Intervals& intervals) {
  std::size_t count = 0;
  for (const auto& of_item : intervals) count += of_item.size();
  return count;
}

class SearchedIntervals : public testing::Test {
 protected:
  SearchedIntervals() {
    server_.core().versions.Publish(scene_);
    auto remote = RemoteChecker::Pin(server_.Connect(), robot_);
    EXPECT_TRUE(remote.ok()) << remote.status();
    remote_ = *std::move(remote);
    auto mirror = SceneMirror::Follow(server_.Connect(), {});
    EXPECT_TRUE(mirror.ok()) << mirror.status();
    mirrored_ = std::make_unique<SceneChecker>(
        (*mirror)->WaitFor(scene_->version, std::chrono::seconds(60)).value(), robot_);
    options_.unknown = UnknownPolicy::kFree;
  }

  RandomWorld random_{12};
  const ScenePtr scene_ = random_.Scene();
  const Robot robot_{"small",
                     {{"body", {{Box{{0.1, 0.2, 0.1}}, Pose{}}}},
                      {"hand", {{Sphere{0.05}, Pose::Translation(0.1, 0, 0)}}}}};
  const TimeInterval window_{scene_->stamp, scene_->stamp + FromSeconds(2)};
  const SceneChecker local_{scene_, robot_};
  testing_support::TestServer server_{PiecewiseConfig()};
  std::unique_ptr<RemoteChecker> remote_;
  std::unique_ptr<SceneChecker> mirrored_;
  CheckOptions options_;
};

TEST_F(SearchedIntervals, OfPlacesAreTheSameAllWays) {
  const std::vector<Pose> T_W_L = random_.States(robot_, 30).T_W_L;
  const SafeIntervalOptions options{options_, FromSeconds(0.03)};
  const auto local = FindSafeIntervals(local_, T_W_L, window_, options);
  ASSERT_TRUE(local.ok()) << local.status();
  EXPECT_GT(Count(*local), 10u);
  const auto dut = remote_->FindSafeIntervals(T_W_L, window_, options);
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(*dut, *local);
  EXPECT_EQ(FindSafeIntervals(*mirrored_, T_W_L, window_, options).value(), *local);
  EXPECT_EQ(FindSafeIntervals(*remote_, T_W_L, window_, options).value(), *local);
}

TEST_F(SearchedIntervals, OfEdgesAreTheSameAllWays) {
  MotionBatch edges = RandomMotions(random_, robot_, 20).motions;
  std::size_t knot = 0;
  for (const std::size_t knots : edges.knot_counts) {
    const Duration begins = edges.times[knot].time_since_epoch();
    for (std::size_t k = 0; k < knots; ++k) edges.times[knot++] -= begins;
  }
  edges.deviations_m.assign(edges.T_W_L.size(), 0.001);
  const DepartureIntervalOptions options{{options_, 0.02}, FromSeconds(0.03)};
  const auto local = FindDepartureIntervals(local_, edges, window_, options);
  ASSERT_TRUE(local.ok()) << local.status();
  EXPECT_GT(Count(*local), 5u);
  const auto dut = remote_->FindDepartureIntervals(edges, window_, options);
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(*dut, *local);
  EXPECT_EQ(FindDepartureIntervals(*mirrored_, edges, window_, options).value(), *local);
  EXPECT_EQ(FindDepartureIntervals(*remote_, edges, window_, options).value(), *local);
}

TEST_F(SearchedIntervals, ArePinnedToTheCheckersVersion) {
  const std::vector<Pose> T_W_L = random_.States(robot_, 10).T_W_L;
  const auto before = remote_->FindSafeIntervals(T_W_L, window_, {options_});
  SceneSnapshot empty = SceneSnapshot::Empty(scene_->params);
  empty.version = scene_->version + 1;
  empty.stamp = scene_->stamp;
  server_.core().versions.Publish(std::make_shared<const SceneSnapshot>(std::move(empty)));
  EXPECT_EQ(remote_->FindSafeIntervals(T_W_L, window_, {options_}).value(), before.value());
}

TEST_F(SearchedIntervals, SayWhatIsWrong) {
  const auto names = [](const auto& dut, const std::string& field) {
    return absl::IsInvalidArgument(dut.status()) &&
           dut.status().message().find(field) != std::string::npos;
  };
  const TimeInterval backwards{window_.until, window_.from};
  const Intervals none;
  EXPECT_EQ(remote_->FindSafeIntervals({}, window_, {options_}).value(), none);
  EXPECT_EQ(remote_->FindDepartureIntervals({}, window_, {{options_}}).value(), none);
  EXPECT_TRUE(names(remote_->FindSafeIntervals({}, backwards, {options_}), "window.until_ns"));
  EXPECT_TRUE(
      names(remote_->FindDepartureIntervals({}, backwards, {{options_}}), "window.until_ns"));
  EXPECT_TRUE(names(remote_->FindSafeIntervals({Pose{}}, window_, {options_}), "world_from_link"));
  MotionBatch edge{{8}, {}, std::vector<Pose>(16), {}};
  EXPECT_TRUE(
      names(remote_->FindDepartureIntervals(edge, window_, {{options_}}), "world_from_link"));
  for (int k = 0; k < 8; ++k) edge.times.push_back(TimeFromNanoseconds(k));
  EXPECT_TRUE(absl::IsResourceExhausted(
      remote_->FindDepartureIntervals(edge, window_, {{options_}}).status()));
}

}  // namespace
}  // namespace clearway
