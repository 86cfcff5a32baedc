#include "clearway/scene/scene_delta.h"

#include <gtest/gtest.h>

#include <cmath>

#include "clearway/scene/scene_builder.h"
#include "support/frames.h"
#include "support/random_given.h"

namespace clearway {
namespace {

using testing_support::AddPoint;
using testing_support::FrameAt;
using testing_support::RandomFrames;

// Versions of one scene after each of a number of random frames.
std::vector<ScenePtr> RandomVersions(unsigned seed, int count) {
  ThreadPool pool(1);
  SceneParams params;
  params.clear_objects_by_rays = seed % 2 == 0;
  params.solid = seed == 3 ? SolidMode::kCompletedHull : SolidMode::kConvexHull;
  params.keep_distance_m = seed == 3 ? 3 : 0;  // blocks are removed, too
  SceneBuilder builder(params, {}, pool);
  RandomFrames frames(seed);
  testing_support::Random given(seed);
  std::vector<ScenePtr> versions{builder.Publish()};
  for (int k = 0; k < count; ++k) {
    EXPECT_TRUE(builder.Apply(frames.Next()).ok());
    testing_support::ChangeGivenRandomly(builder, given);
    if (k == count / 2) builder.ClearRegion({{-2, -2, -2}, {2, 2, 2}});
    if (k == count / 3) builder.SetKeepOut({{{0, 0, 0}, {1, 1, 1}}});
    if (k == 2 * count / 3 && seed == 5) builder.Reset();
    versions.push_back(builder.Publish());
  }
  return versions;
}

void ExpectEqual(const SceneSnapshot& a, const SceneSnapshot& b) {
  EXPECT_TRUE(SameContent(a, b));
  EXPECT_EQ(a.Hash(), b.Hash());
  EXPECT_EQ(a.version, b.version);
  for (const auto& object : b.objects) {
    const MovingObject* twin = a.FindObject(object->id);
    ASSERT_NE(twin, nullptr);
    EXPECT_EQ(twin->solid->hull->vertices, object->solid->hull->vertices);
    EXPECT_EQ(twin->solid->hull->triangles, object->solid->hull->triangles);
    EXPECT_EQ(twin->observed_box_O, object->observed_box_O);
  }
}

TEST(SceneDelta, EmptyBetweenAVersionAndItself) {
  const auto versions = RandomVersions(1, 3);
  const SceneDelta dut = Diff(versions[3].get(), *versions[3]);
  EXPECT_TRUE(dut.static_map_W.empty());
  EXPECT_TRUE(dut.objects.empty());
  EXPECT_TRUE(dut.removed.empty());
  EXPECT_FALSE(dut.params);
}

// The law: Apply(a, Diff(a, b)) == b, for any skip and also backwards.
TEST(SceneDelta, ApplyUndoesDiffBetweenAnyTwoVersions) {
  for (unsigned seed : {2u, 3u, 5u}) {
    const auto versions = RandomVersions(seed, 24);
    testing_support::Random random(seed);
    for (int i = 0; i < 60; ++i) {
      const auto& a = versions[random.Integer(0, 24)];
      const auto& b = versions[random.Integer(0, 24)];
      const auto applied = Apply(a.get(), Diff(a.get(), *b));
      ASSERT_TRUE(applied.ok()) << applied.status();
      ExpectEqual(*applied, *b);
    }
  }
}

TEST(SceneDelta, FromNothingItIsTheWholeScene) {
  for (const ScenePtr& version : RandomVersions(4, 12)) {
    const auto applied = Apply(nullptr, Diff(nullptr, *version));
    ASSERT_TRUE(applied.ok());
    ExpectEqual(*applied, *version);
  }
}

void ExpectSameStates(const VoxelMap& a, const VoxelMap& b) {
  BlockTree::ForEachDifference(a.blocks(), b.blocks(),
                               [](BlockKey, const VoxelBlock* left, const VoxelBlock* right) {
                                 const VoxelBlock none;
                                 EXPECT_EQ((left == nullptr ? none : *left).observed,
                                           (right == nullptr ? none : *right).observed);
                                 EXPECT_EQ((left == nullptr ? none : *left).occupied,
                                           (right == nullptr ? none : *right).occupied);
                               });
}

std::size_t ChangedVoxels(const SceneDelta& delta) {
  std::size_t count = 0;
  for (const BlockDelta& block : delta.static_map_W) count += block.changed.Count();
  return count;
}

// The law for states alone, and that they are the states of the scene.
TEST(SceneDelta, OfStatesMakesTheSceneOfTheStates) {
  const auto versions = RandomVersions(3, 24);
  const auto states_of = [](const SceneSnapshot& scene) {
    return *Apply(nullptr, Diff(nullptr, scene, MapDetail::kStates));
  };
  testing_support::Random random(3);
  std::size_t changed = 0, changed_states = 0;
  for (int i = 0; i < 60; ++i) {
    const auto& a = versions[random.Integer(0, 24)];
    const auto& b = versions[random.Integer(0, 24)];
    const SceneSnapshot base = states_of(*a);
    const auto applied = Apply(&base, Diff(a.get(), *b, MapDetail::kStates));
    ASSERT_TRUE(applied.ok()) << applied.status();
    ExpectEqual(*applied, states_of(*b));
    ExpectSameStates(applied->static_map_W, b->static_map_W);
    for (const auto& object : b->objects) {
      ExpectSameStates(applied->FindObject(object->id)->map_O, object->map_O);
    }
    changed += ChangedVoxels(Diff(a.get(), *b));
    changed_states += ChangedVoxels(Diff(a.get(), *b, MapDetail::kStates));
  }
  EXPECT_LT(changed_states, changed);
}

// Neither a future that frames shorten nor a shape is sent again.
TEST(SceneDelta, HoldsNewFuturesAndShapesAlone) {
  ThreadPool pool(1);
  SceneBuilder builder({}, {}, pool);
  GivenObject given{9, Sphere{1}, {testing_support::At(0), Pose{}}, {}, {}};
  for (int k = 1; k <= 10; ++k) {
    given.future.push_back({testing_support::At(k), Pose::Translation(k, 0, 0)});
  }
  ASSERT_TRUE(builder.AddObject(given).ok());
  const ScenePtr before = builder.Publish();
  Frame frame = FrameAt(4);
  frame.motions = {{9, Pose::Translation(4, 0.1, 0), testing_support::At(0)}};
  ASSERT_TRUE(builder.Apply(frame).ok());
  const ScenePtr after = builder.Publish();
  ASSERT_EQ(after->objects[0]->future.size(), 6u);
  const SceneDelta dut = Diff(before.get(), *after);
  ASSERT_EQ(dut.objects.size(), 1u);
  EXPECT_TRUE(dut.objects[0].keeps_future);
  EXPECT_TRUE(dut.objects[0].future.empty());
  EXPECT_TRUE(dut.objects[0].given);
  EXPECT_EQ(dut.objects[0].given_shape, nullptr);
  ExpectEqual(*Apply(before.get(), dut), *after);
  EXPECT_NE(before->Hash(), after->Hash());
}

TEST(SceneDelta, HoldsChangedVoxelsAlone) {
  ThreadPool pool(1);
  SceneBuilder builder({}, {}, pool);
  Frame frame = FrameAt(0);
  AddPoint(frame, kStaticLabel, {2.05, 0.05, 0.05});
  ASSERT_TRUE(builder.Apply(frame).ok());
  const ScenePtr before = builder.Publish();
  VoxelMap prior(0.1);
  prior.Set({1, 1, 1}, 77);
  ASSERT_TRUE(builder.LoadPrior(prior).ok());
  const SceneDelta dut = Diff(before.get(), *builder.Publish());
  ASSERT_EQ(dut.static_map_W.size(), 1u);
  EXPECT_EQ(dut.static_map_W[0].changed.Count(), 1);
  EXPECT_EQ(dut.static_map_W[0].log_odds, (std::vector<LogOdds>{77}));
}

class SceneDeltaRefusalTest : public testing::Test {
 protected:
  void SetUp() override {
    versions_ = RandomVersions(3, 6);
    delta_ = Diff(nullptr, *versions_.back());
    ASSERT_FALSE(delta_.objects.empty());
    ASSERT_FALSE(delta_.static_map_W.empty());
  }
  absl::StatusCode Code() { return Apply(nullptr, delta_).status().code(); }
  std::vector<ScenePtr> versions_;
  SceneDelta delta_;
};

TEST_F(SceneDeltaRefusalTest, AnotherBaseVersion) {
  EXPECT_EQ(Apply(versions_[1].get(), delta_).status().code(),
            absl::StatusCode::kFailedPrecondition);
}

TEST_F(SceneDeltaRefusalTest, MissingParams) {
  delta_.params.reset();
  EXPECT_EQ(Code(), absl::StatusCode::kInvalidArgument);
}

TEST_F(SceneDeltaRefusalTest, MasksAndValuesDisagree) {
  delta_.static_map_W[0].log_odds.push_back(1);
  EXPECT_EQ(Code(), absl::StatusCode::kInvalidArgument);
}

TEST_F(SceneDeltaRefusalTest, AddressOutOfRange) {
  delta_.static_map_W[0].key.x = kMaxVoxelIndex;
  EXPECT_EQ(Code(), absl::StatusCode::kInvalidArgument);
}

TEST_F(SceneDeltaRefusalTest, EmptyHistory) {
  delta_.objects[0].history.clear();
  EXPECT_EQ(Code(), absl::StatusCode::kInvalidArgument);
}

TEST_F(SceneDeltaRefusalTest, HistoryThatDoesNotAscend) {
  delta_.objects[0].history.push_back(delta_.objects[0].history.front());
  EXPECT_EQ(Code(), absl::StatusCode::kInvalidArgument);
}

TEST_F(SceneDeltaRefusalTest, FutureThatDoesNotFollowTheHistory) {
  delta_.objects[0].future = {delta_.objects[0].history.back()};
  EXPECT_EQ(Code(), absl::StatusCode::kInvalidArgument);
}

// Products with times must be finite, or checkers would spare what is there.
TEST_F(SceneDeltaRefusalTest, BoundsOutOfRange) {
  for (const double bad : {-1e-9, 1.1e6, 1e308, double{NAN}, double{INFINITY}}) {
    for (double PositionBound::*field :
         {&PositionBound::at_m, &PositionBound::speed_mps, &PositionBound::accel_mps2}) {
      delta_.objects[0].bound = {};
      delta_.objects[0].bound.*field = bad;
      EXPECT_EQ(Code(), absl::StatusCode::kInvalidArgument) << bad;
    }
  }
}

TEST_F(SceneDeltaRefusalTest, CompletionsOutOfRange) {
  delta_.objects[0].completion = Completion{3.1, -1, false};
  EXPECT_EQ(Code(), absl::StatusCode::kOk);
  for (const Completion& bad :
       {Completion{4.1, 0, false}, {NAN, 0, false}, {0, 2, false}, {0, -2, true}}) {
    delta_.objects[0].completion = bad;
    EXPECT_EQ(Code(), absl::StatusCode::kInvalidArgument) << bad.yaw_rad << bad.unseen_end;
  }
  delta_ = Diff(nullptr, *versions_.back());
  delta_.objects[0].map_O.clear();
  delta_.objects[0].given = true;
  delta_.objects[0].given_shape = std::make_shared<const Shape>(Sphere{1});
  delta_.objects[0].completion = Completion();
  EXPECT_EQ(Code(), absl::StatusCode::kInvalidArgument);
}

// The law with nothing but the completion changed.
TEST(SceneDelta, HoldsACompletionThatChangedAlone) {
  const auto versions = RandomVersions(3, 8);
  SceneSnapshot turned = *versions.back();
  ASSERT_FALSE(turned.objects.empty());
  MovingObject object = *turned.objects[0];
  object.completion = Completion{0.4, 1, false};
  object = WithMap(object, object.map_O);
  turned.objects[0] = std::make_shared<const MovingObject>(object);
  const SceneDelta dut = Diff(versions.back().get(), turned);
  ASSERT_EQ(dut.objects.size(), 1u);
  EXPECT_TRUE(dut.objects[0].map_O.empty());
  const auto applied = Apply(versions.back().get(), dut);
  ASSERT_TRUE(applied.ok()) << applied.status();
  ExpectEqual(*applied, turned);
  EXPECT_NE(applied->Hash(), versions.back()->Hash());
}

TEST_F(SceneDeltaRefusalTest, FutureThatThereIsNone) {
  delta_.objects[0].keeps_future = true;
  EXPECT_EQ(Code(), absl::StatusCode::kInvalidArgument);
}

TEST_F(SceneDeltaRefusalTest, GivenWithoutAShapeOrWithABadOne) {
  delta_.objects[0].map_O.clear();
  delta_.objects[0].completion.reset();
  delta_.objects[0].given = true;
  EXPECT_EQ(Code(), absl::StatusCode::kInvalidArgument);
  for (const double radius_m : {0.0, 1e9, std::nan("")}) {
    delta_.objects[0].given_shape = std::make_shared<const Shape>(Sphere{radius_m});
    EXPECT_EQ(Code(), absl::StatusCode::kInvalidArgument);
  }
  delta_.objects[0].given_shape = std::make_shared<const Shape>(Sphere{1});
  EXPECT_EQ(Code(), absl::StatusCode::kOk);
  delta_.objects[0].given = false;
  EXPECT_EQ(Code(), absl::StatusCode::kInvalidArgument);
}

TEST_F(SceneDeltaRefusalTest, ResolutionCannotChange) {
  delta_ = Diff(versions_[1].get(), *versions_[2]);
  delta_.params = SceneParams{};
  delta_.params->resolution_m = 0.2;
  EXPECT_EQ(Apply(versions_[1].get(), delta_).status().code(), absl::StatusCode::kInvalidArgument);
}

// -0.0 and 0.0 are one number: what Diff leaves out is no difference to the hash either.
TEST(SceneDelta, ZerosOfEitherSignAreEqual) {
  ThreadPool pool(1);
  SceneBuilder builder(SceneParams{}, {}, pool);
  Frame frame = FrameAt(1);
  AddPoint(frame, 4, {3, 0, 0});
  ASSERT_TRUE(builder.Apply(frame).ok());
  builder.SetKeepOut({{{0, 0, 0}, {1, 1, 1}}});
  const ScenePtr from = builder.Publish();
  SceneSnapshot to = *from;
  to.params.keep_out_W.front().min = {-0.0, -0.0, -0.0};
  auto object = std::make_shared<MovingObject>(*to.objects.front());
  for (StampedPose& stamped : object->history) {
    stamped.T_W_O.translation.z() = 0;
    stamped.T_W_O.rotation = Eigen::Quaterniond(1, -0.0, 0, -0.0);
  }
  object->velocity_O = Twist{};
  SceneSnapshot twin = to;
  to.objects = {object};
  auto mirrored = std::make_shared<MovingObject>(*object);
  for (StampedPose& stamped : mirrored->history) {
    stamped.T_W_O.translation.z() = -0.0;
    stamped.T_W_O.rotation = Eigen::Quaterniond(1, 0, -0.0, 0);
  }
  mirrored->velocity_O = Twist{{-0.0, 0, 0}, {0, -0.0, 0}};
  twin.objects = {mirrored};
  EXPECT_TRUE(SameContent(to, twin));
  EXPECT_EQ(to.Hash(), twin.Hash());
  EXPECT_FALSE(Diff(from.get(), to).params);
  to.version = from->version + 1;
  const auto applied = Apply(from.get(), Diff(from.get(), to));
  ASSERT_TRUE(applied.ok()) << applied.status();
  EXPECT_TRUE(SameContent(*applied, to));
  EXPECT_EQ(applied->Hash(), to.Hash());
}

}  // namespace
}  // namespace clearway
