// Against SceneAtTime, which places every object at every time.
#include "clearway/scene/timed_scene.h"

#include <gtest/gtest.h>

#include <numbers>

#include "clearway/scene/scene_builder.h"
#include "support/frames.h"
#include "support/random_given.h"

namespace clearway {
namespace {

using testing_support::AddPoint;
using testing_support::FrameAt;
using testing_support::Random;
using testing_support::RandomFrames;

void ExpectSame(const PointOccupancy& a, const PointOccupancy& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.object, b.object);
  EXPECT_EQ(a.fused_log_odds, b.fused_log_odds);
}

SceneParams CoarseParams() {
  SceneParams params;
  params.resolution_m = params.object_resolution_m = 0.4;
  params.horizon = std::chrono::milliseconds(500);
  return params;
}

TEST(TimedScene, Empty) {
  const SceneSnapshot scene = SceneSnapshot::Empty({});
  TimedScene dut(scene, Time(), Time());
  EXPECT_EQ(dut.At({1, 2, 3}, Time()).status, SpaceStatus::kUnknownSpace);
  EXPECT_EQ(dut.At({1e6, 2, 3}, Time()).status, SpaceStatus::kOutOfBounds);
}

TEST(TimedScene, SaysWhatPlacedObjectsSay) {
  ThreadPool pool(1);
  SceneBuilder builder(CoarseParams(), {}, pool);
  RandomFrames frames(3);
  Random random(4);
  int by_objects = 0, beyond = 0, hit = 0;
  for (int i = 0; i < 40; ++i) {
    ASSERT_TRUE(builder.Apply(frames.Next()).ok());
    testing_support::ChangeGivenRandomly(builder, random);
    const ScenePtr scene = builder.Publish();
    TimedScene dut(*scene, scene->stamp + FromSeconds(-1), scene->stamp + FromSeconds(2));
    for (int k = 0; k < 400; ++k) {
      // Before and after the newest stamp; every other time comes again.
      const Time time =
          scene->stamp + FromSeconds(k % 2 == 0 ? random.Uniform(-1, 2) : k % 7 * 0.2);
      const Eigen::Vector3d p_W = random.Vector(9);
      const PointOccupancy truth = SceneAtTime(*scene, time).At(p_W);
      ExpectSame(dut.At(p_W, time), truth);
      const Eigen::Vector3d direction_W = random.Vector(1);
      const RayAnswer ray = dut.CastRay(p_W, direction_W, 9, time, [] { return false; });
      const RayAnswer true_ray = CastQueryRay(SceneAtTime(*scene, time), p_W, direction_W, 9);
      EXPECT_EQ(ray.first_hit_m, true_ray.first_hit_m);
      EXPECT_EQ(ray.first_unknown_m, true_ray.first_unknown_m);
      EXPECT_EQ(ray.object, true_ray.object);
      hit += ray.first_hit_m.has_value();
      by_objects += truth.object != kStaticLabel;
      beyond += truth.status == SpaceStatus::kBeyondHorizon;
    }
  }
  EXPECT_GT(by_objects, 100);
  EXPECT_GT(beyond, 100);
  EXPECT_GT(hit, 100);
}

TEST(TimedScene, ARayEndsWhenNobodyWaits) {
  const SceneSnapshot scene = SceneSnapshot::Empty({});
  TimedScene dut(scene, Time(), Time());
  int asked = 0;
  dut.CastRay({0, 0, 0}, {1, 0, 0}, 3'000, Time(), [&] { return ++asked == 3; });
  EXPECT_EQ(asked, 3);
}

TEST(ObjectIndex, Empty) {
  const SceneSnapshot scene = SceneSnapshot::Empty({});
  const ObjectIndex dut(scene, Time(), Time());
  dut.ForEachNear({{-9, -9, -9}, {9, 9, 9}}, Time(),
                  [](std::size_t) { FAIL() << "nothing is near"; });
}

// Whether one of some points of the object, or of the ball that it may be in, is that near to the
// box.
bool MeetsBox(const SceneAtTime::Placed& placed, const Aabb& box_W, double within_m,
              Random& random) {
  Aabb box_O = placed.object->observed_box_O;
  box_O.Extend(placed.object->solid->box_O);
  for (int k = 0; k < 30; ++k) {
    Eigen::Vector3d part(k & 1, k >> 1 & 1, k >> 2 & 1);  // a corner
    if (k >= 8) part = 0.5 * (random.Vector(1).array() + 1);
    Eigen::Vector3d p_W =
        placed.T_W_O * (box_O.min + part.cwiseProduct(box_O.max - box_O.min)).eval();
    if (placed.beyond_horizon_radius_m) {
      p_W = placed.T_W_O.translation + *placed.beyond_horizon_radius_m * random.UnitVector();
    }
    const Eigen::Vector3d nearest_W = p_W.cwiseMax(box_W.min).cwiseMin(box_W.max);
    if ((nearest_W - p_W).norm() <= within_m) return true;
  }
  return false;
}

TEST(ObjectIndex, HoldsEveryObjectThatMeetsTheBox) {
  ThreadPool pool(1);
  SceneBuilder builder(CoarseParams(), {}, pool);
  RandomFrames frames(5);
  Random random(6);
  int near = 0, spared = 0;
  for (int i = 0; i < 40; ++i) {
    ASSERT_TRUE(builder.Apply(frames.Next()).ok());
    testing_support::ChangeGivenRandomly(builder, random);
    const ScenePtr scene = builder.Publish();
    const double first_s = random.Uniform(-2, 1), last_s = first_s + random.Uniform(0, 2);
    const ObjectGrowth growth{random.Uniform(0, 1), random.Uniform(0, 1)};
    const ObjectIndex dut(*scene, scene->stamp + FromSeconds(first_s),
                          scene->stamp + FromSeconds(last_s), 1 + i % 5);
    for (int k = 0; k < 200; ++k) {
      const Eigen::Vector3d corner_W = random.Vector(12);
      const Aabb box_W{corner_W, corner_W + Eigen::Vector3d::Constant(random.Uniform(0, 2))};
      const double before_s = k % 8 == 0 ? 1 : 0;  // also outside
      const Time time =
          scene->stamp + FromSeconds(random.Uniform(first_s - before_s, last_s + before_s));
      const double long_s = k % 4 == 0 ? random.Uniform(0, 0.5) : 0;
      const double begins = random.Uniform(0, 1);
      std::vector<std::size_t> visited;
      dut.ForEachNear(box_W, time - FromSeconds(begins * long_s),
                      time + FromSeconds((1 - begins) * long_s), growth,
                      [&](std::size_t object) { visited.push_back(object); });
      EXPECT_TRUE(std::is_sorted(visited.begin(), visited.end()));
      const SceneAtTime placed(*scene, time);
      for (std::size_t object = 0; object < scene->objects.size(); ++object) {
        const MovingObject& here = *scene->objects[object];
        const double grown_m =
            growth.mps * std::max(0.0, ToSeconds(time - here.t_k())) +
            growth.bound_multiple * here.bound.At(ToSeconds(time - here.LastPose().stamp));
        const bool found = std::binary_search(visited.begin(), visited.end(), object);
        const bool meets = MeetsBox(placed.objects()[object], box_W, grown_m, random);
        EXPECT_TRUE(found || !meets) << "object " << object;
        near += meets;
        spared += !found;
      }
    }
  }
  EXPECT_GT(near, 100);
  EXPECT_GT(spared, 100);
}

TEST(ObjectIndex, TakesMoreObjectsThanAWordHasBits) {
  ThreadPool pool(1);
  SceneBuilder builder({}, {}, pool);
  Frame frame = FrameAt(0);
  for (ObjectId id = 1; id <= 200; ++id) AddPoint(frame, id, {3.0 * id, 1, 0});
  ASSERT_TRUE(builder.Apply(frame).ok());
  const ScenePtr scene = builder.Publish();
  const ObjectIndex dut(*scene, scene->stamp, scene->stamp);
  for (std::size_t object = 0; object < 200; ++object) {
    const Eigen::Vector3d p_W(3.0 * (static_cast<double>(object) + 1), 1, 0);
    std::vector<std::size_t> visited;
    dut.ForEachNear({p_W, p_W}, scene->stamp, [&](std::size_t near) { visited.push_back(near); });
    EXPECT_EQ(visited, std::vector{object});
  }
}

// One that goes round in a circle, of a metre and a half in radius, is spared on the straight line.
TEST(ObjectIndex, FollowsAnObjectThatTurns) {
  ThreadPool pool(1);
  SceneParams params;
  params.horizon = std::chrono::seconds(10);
  SceneBuilder builder(params, {}, pool);
  constexpr double kTurn_rad = 0.1;  // in 0.1 s
  const Pose turn{Eigen::Quaterniond(Eigen::AngleAxisd(kTurn_rad, Eigen::Vector3d::UnitZ())),
                  Eigen::Vector3d::Zero()};
  Frame frame = FrameAt(0);
  AddPoint(frame, 1, {1.5, 0, 0});
  ASSERT_TRUE(builder.Apply(frame).ok());
  Frame next = FrameAt(0.1);
  AddPoint(next, 1, turn * Eigen::Vector3d(1.5, 0, 0));
  next.motions = {{1, turn, frame.stamp}};
  ASSERT_TRUE(builder.Apply(next).ok());
  const ScenePtr scene = builder.Publish();
  const ObjectIndex dut(*scene, scene->stamp, scene->stamp + FromSeconds(7));
  for (int k = 0; k <= 70; ++k) {
    const Time time = scene->stamp + FromSeconds(0.1 * k);
    const Pose T_W_O = PredictPose(*scene->objects[0], time, params.horizon).T_W_O;
    const Eigen::Vector3d p_W = T_W_O * scene->objects[0]->solid->box_O.Center();
    EXPECT_NEAR(p_W.norm(), 1.5, 0.2);
    int visits = 0;
    dut.ForEachNear({p_W, p_W}, time, [&](std::size_t) { ++visits; });
    EXPECT_EQ(visits, 1) << k;
  }
  const Eigen::Vector3d behind_W(1.5, -1.5, 0);
  dut.ForEachNear({behind_W, behind_W}, scene->stamp + FromSeconds(0.5),
                  [](std::size_t) { FAIL() << "it has gone the other way"; });
}

// Round a square of 20 m a side, ten times, a pose every metre and second.
TEST(ObjectIndex, FollowsALongFuture) {
  ThreadPool pool(1);
  SceneBuilder builder({}, {}, pool);
  GivenObject given{1, Sphere{0.5}, {Time{}, Pose{}}, {}, {}};
  Pose T_W_O;
  for (int k = 1; k <= 800; ++k) {
    const double turn_rad = k % 20 == 0 ? std::numbers::pi / 2 : 0;
    T_W_O = T_W_O * Exp({{0, 0, turn_rad}, {1, 0, 0}});
    given.future.push_back({Time{} + FromSeconds(k), T_W_O});
  }
  ASSERT_TRUE(builder.AddObject(given).ok());
  const ScenePtr scene = builder.Publish();
  const ObjectIndex dut(*scene, Time{}, Time{} + FromSeconds(60), 8);
  EXPECT_GT(dut.FastestMps(Time{}, {}), 1);
  EXPECT_LT(dut.FastestMps(Time{}, {}), 1.6 + 0.5 * std::numbers::pi);
  int spared = 0, met = 0;
  for (int k = 0; k <= 2000; ++k) {
    const Time time = Time{} + FromSeconds(0.4 * k);
    const Duration half = FromSeconds(k % 3 == 0 ? 1.7 : 0.0);
    const Eigen::Vector3d p_W = PredictPose(*scene->objects[0], time, {}).T_W_O.translation;
    const auto visits = [&](const Eigen::Vector3d& place_W) {
      int count = 0;
      dut.ForEachNear({place_W, place_W}, time - half, time + half, {},
                      [&](std::size_t) { ++count; });
      return count;
    };
    const bool known = time - half >= Time{};
    met += visits(p_W);
    spared += visits(p_W + Eigen::Vector3d(0, 0, 1)) == 0;
    EXPECT_TRUE(visits(p_W + Eigen::Vector3d(4, 4, 0)) == 0 || !known) << k;
    MovingBall ball{time - half, time + half, p_W, p_W, 0.1};
    EXPECT_TRUE(dut.MayMeet(0, ball, {}));
    ball.from_W = ball.until_W = p_W + Eigen::Vector3d(0, 0, 1.5);
    EXPECT_FALSE(half == Duration::zero() && dut.MayMeet(0, ball, {})) << k;
  }
  EXPECT_EQ(met, 2001);
  EXPECT_GT(spared, 1200);
}

}  // namespace
}  // namespace clearway
