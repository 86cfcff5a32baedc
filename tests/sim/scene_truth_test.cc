// A scene built of simulated frames against the truth of the simulated world.
#include <gtest/gtest.h>

#include "clearway/scene/scene_builder.h"
#include "clearway/sim/scenarios.h"

namespace clearway {
namespace {

// The small world with exact motions, and what a scene makes of all its frames.
class SceneTruthTest : public testing::Test {
 protected:
  SceneTruthTest() : simulation_(*MakeScenario("small")) {
    ThreadPool pool(1);
    SceneBuilder builder(params_, {}, pool);
    for (std::size_t k = 0; k < simulation_.frame_count(); ++k) {
      EXPECT_TRUE(builder.Apply(simulation_.MakeFrame(k)).ok());
    }
    scene_ = builder.Publish();
  }
  const World& world() const { return simulation_.world(); }
  // A voxel as a shape, a little larger, for a point on its boundary counts as in it.
  Box VoxelShape() const { return {Eigen::Vector3d::Constant(params_.resolution_m + 1e-4)}; }

  SceneParams params_;
  Simulation simulation_;
  ScenePtr scene_;
};

World Only(const World& world, ObjectId id) {
  World only;
  for (const Body& body : world.bodies()) {
    if (body.id == id) only.Add(body);
  }
  return only;
}

TEST_F(SceneTruthTest, EveryObjectIsThere) {
  ASSERT_EQ(scene_->objects.size(), world().ObjectIds().size());
  for (const auto& object : scene_->objects) EXPECT_GT(object->map_O.occupied_count(), 20);
}

TEST_F(SceneTruthTest, OccupiedStaticVoxelsTouchTheStaticWorld) {
  const World background = Only(world(), kStaticLabel);
  const WorldAtTime truth(background, scene_->stamp);
  const VoxelMap& map_W = scene_->static_map_W;
  map_W.blocks().ForEach([&](BlockKey key, const VoxelBlock& block) {
    block.occupied.ForEach([&](int i) {
      const Eigen::Vector3d center_W = map_W.grid().CenterOf(VoxelAt(key, i));
      const Pose T_W_V = Pose::Translation(center_W.x(), center_W.y(), center_W.z());
      EXPECT_EQ(truth.Touched(VoxelShape(), T_W_V), kStaticLabel) << center_W.transpose();
    });
  });
}

TEST_F(SceneTruthTest, OccupiedObjectVoxelsTouchTheObject) {
  for (const auto& object : scene_->objects) {
    const World alone = Only(world(), object->id);
    const WorldAtTime truth(alone, scene_->stamp);
    const Pose T_W_O = object->history.back().T_W_O;
    object->map_O.blocks().ForEach([&](BlockKey key, const VoxelBlock& block) {
      block.occupied.ForEach([&](int i) {
        const Eigen::Vector3d center_O = object->map_O.grid().CenterOf(VoxelAt(key, i));
        const Pose T_O_V = Pose::Translation(center_O.x(), center_O.y(), center_O.z());
        EXPECT_EQ(truth.Touched(VoxelShape(), T_W_O * T_O_V), object->id);
      });
    });
  }
}

TEST_F(SceneTruthTest, PredictionsOfSteadyMotionsAreTheTruth) {
  for (const auto& object : scene_->objects) {
    const Pose T_B_O =
        Inverse(*world().T_W_B(object->id, object->t_k())) * object->history.back().T_W_O;
    // Object 2 drives on an arc until 3 s; the others go on for ever.
    const double longest_s = object->id == 2 ? 1.0 : 4.0;
    for (double ahead_s = 0; ahead_s <= longest_s; ahead_s += 0.25) {
      const Time t = object->t_k() + FromSeconds(ahead_s);
      const PredictedPose dut = PredictPose(*object, t, params_.horizon);
      const Pose truth = *world().T_W_B(object->id, t) * T_B_O;
      EXPECT_FALSE(dut.beyond_horizon_radius_m);
      EXPECT_LT((dut.T_W_O.translation - truth.translation).norm(), 1e-6) << object->id;
      EXPECT_LT(dut.T_W_O.rotation.angularDistance(truth.rotation), 1e-6) << object->id;
    }
  }
}

TEST_F(SceneTruthTest, TheObjectFrameStaysFixedInTheBody) {
  for (const auto& object : scene_->objects) {
    const Pose first_T_B_O = Inverse(*world().T_W_B(object->id, object->history.front().stamp)) *
                             object->history.front().T_W_O;
    for (const StampedPose& pose : object->history) {
      const Pose T_B_O = Inverse(*world().T_W_B(object->id, pose.stamp)) * pose.T_W_O;
      EXPECT_LT((T_B_O.translation - first_T_B_O.translation).norm(), 1e-9);
      EXPECT_LT(T_B_O.rotation.angularDistance(first_T_B_O.rotation), 1e-7);
    }
  }
}

}  // namespace
}  // namespace clearway
