// Against SceneAtTime, which places every object at every time.
#include "clearway/scene/timed_scene.h"

#include <gtest/gtest.h>

#include "clearway/scene/scene_builder.h"
#include "support/frames.h"

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
  int by_objects = 0, beyond = 0;
  for (int i = 0; i < 40; ++i) {
    ASSERT_TRUE(builder.Apply(frames.Next()).ok());
    const ScenePtr scene = builder.Publish();
    TimedScene dut(*scene, scene->stamp + FromSeconds(-1), scene->stamp + FromSeconds(2));
    for (int k = 0; k < 400; ++k) {
      // Before and after the newest stamp; every other time comes again.
      const Time time =
          scene->stamp + FromSeconds(k % 2 == 0 ? random.Uniform(-1, 2) : k % 7 * 0.2);
      const Eigen::Vector3d p_W = random.Vector(9);
      const PointOccupancy truth = SceneAtTime(*scene, time).At(p_W);
      ExpectSame(dut.At(p_W, time), truth);
      by_objects += truth.object != kStaticLabel;
      beyond += truth.status == SpaceStatus::kBeyondHorizon;
    }
  }
  EXPECT_GT(by_objects, 100);
  EXPECT_GT(beyond, 100);
}

TEST(ObjectIndex, Empty) {
  const SceneSnapshot scene = SceneSnapshot::Empty({});
  const ObjectIndex dut(scene, Time(), Time());
  dut.ForEachNear({{-9, -9, -9}, {9, 9, 9}}, [](std::size_t) { FAIL() << "nothing is near"; });
}

TEST(ObjectIndex, HoldsEveryObjectThatMeetsTheBox) {
  ThreadPool pool(1);
  SceneBuilder builder(CoarseParams(), {}, pool);
  RandomFrames frames(5);
  Random random(6);
  int near = 0, spared = 0;
  for (int i = 0; i < 40; ++i) {
    ASSERT_TRUE(builder.Apply(frames.Next()).ok());
    const ScenePtr scene = builder.Publish();
    const double first_s = random.Uniform(-2, 1), last_s = first_s + random.Uniform(0, 2);
    const double inflation_mps = random.Uniform(0, 1);
    const ObjectIndex dut(*scene, scene->stamp + FromSeconds(first_s),
                          scene->stamp + FromSeconds(last_s), inflation_mps);
    for (int k = 0; k < 50; ++k) {
      const Eigen::Vector3d corner_W = random.Vector(12);
      const Aabb box_W{corner_W, corner_W + Eigen::Vector3d::Constant(random.Uniform(0, 2))};
      std::vector<std::size_t> visited;
      dut.ForEachNear(box_W, [&](std::size_t object) { visited.push_back(object); });
      EXPECT_TRUE(std::is_sorted(visited.begin(), visited.end()));
      const Time time = scene->stamp + FromSeconds(random.Uniform(first_s, last_s));
      const SceneAtTime placed(*scene, time);
      for (std::size_t object = 0; object < scene->objects.size(); ++object) {
        const double grown_m =
            inflation_mps * std::max(0.0, ToSeconds(time - scene->objects[object]->t_k()));
        const bool found = std::binary_search(visited.begin(), visited.end(), object);
        const bool meets = placed.objects()[object].box_W.Padded(grown_m).Intersects(box_W);
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
    dut.ForEachNear({p_W, p_W}, [&](std::size_t near) { visited.push_back(near); });
    EXPECT_TRUE(std::find(visited.begin(), visited.end(), object) != visited.end());
    EXPECT_LE(visited.size(), 8u);  // a cell is 9.4 m wide
  }
}

}  // namespace
}  // namespace clearway
