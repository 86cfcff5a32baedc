// Objects that are told, not seen.
#include "clearway/scene/given_object.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "clearway/geometry/hull.h"
#include "clearway/scene/object_extent.h"
#include "clearway/scene/occupancy.h"
#include "clearway/scene/scene_builder.h"
#include "support/frames.h"

namespace clearway {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using testing_support::AddPoint;
using testing_support::At;
using testing_support::FrameAt;

// A scene with object 1, seen at 1 s at (5, 0, 0), and static points about it.
class GivenObjectTest : public testing::Test {
 protected:
  GivenObjectTest() {
    Frame frame = FrameAt(1);
    AddPoint(frame, kStaticLabel, {9, 0.05, 0.05});
    AddPoint(frame, 1, {5, 3, 0});
    EXPECT_TRUE(dut_.Apply(frame).ok());
  }
  // A person at (4, 0, 0).
  static GivenObject Person(ObjectId id = 7) {
    return {id, Cylinder{0.3, 1.8}, {At(1), Pose::Translation(4, 0, 0)}, {}, {}};
  }
  const MovingObject* Find(ObjectId id) {
    scene_ = dut_.Publish();
    return scene_->FindObject(id);
  }
  PointOccupancy Ask(const Eigen::Vector3d& p_W, double seconds) {
    scene_ = dut_.Publish();
    return SceneAtTime(*scene_, At(seconds)).At(p_W);
  }
  // Refused so, and without a trace.
  void ExpectRefused(const GivenObject& given, const std::string& message,
                     absl::StatusCode code = absl::StatusCode::kInvalidArgument) {
    const ScenePtr before = dut_.Publish();
    const absl::Status status = dut_.AddObject(given);
    EXPECT_EQ(status.code(), code) << status;
    EXPECT_THAT(std::string(status.message()), StartsWith(message));
    EXPECT_EQ(dut_.Publish(), before);
  }

  ThreadPool pool_{1};
  SceneBuilder dut_{{}, {}, pool_};
  ScenePtr scene_;
};

TEST_F(GivenObjectTest, OccupiesItsShape) {
  ASSERT_TRUE(dut_.AddObject(Person()).ok());
  const MovingObject* object = Find(7);
  ASSERT_NE(object, nullptr);
  EXPECT_TRUE(object->given());
  EXPECT_TRUE(object->AtRest());
  EXPECT_EQ(object->t_k(), At(1));
  EXPECT_EQ(Ask({4.29, 0, 0.89}, 1).status, SpaceStatus::kOccupied);
  EXPECT_EQ(Ask({4.29, 0, 0.89}, 99).object, 7);
  EXPECT_NE(Ask({4.31, 0, 0}, 1).object, 7);
  EXPECT_NE(Ask({4, 0, 0.91}, 1).object, 7);
  const ObjectExtent extent = ExtentOf(*object);
  EXPECT_NEAR(extent.size_m.z(), 1.8, 1e-9);
  EXPECT_NEAR(extent.size_m.x(), 0.6, 0.006);
}

TEST_F(GivenObjectTest, CountsAsItsHullWhereOthersAreTheirVoxels) {
  SceneParams params;
  params.solid = SolidMode::kVoxels;
  SceneBuilder dut(params, {}, pool_);
  ASSERT_TRUE(dut.AddObject(Person()).ok());
  const ScenePtr scene = dut.Publish();
  EXPECT_EQ(SceneAtTime(*scene, At(1)).At({4, 0, 0}).status, SpaceStatus::kOccupied);
}

TEST_F(GivenObjectTest, MovesAsItsVelocityOrItsFutureSays) {
  GivenObject walking = Person();
  walking.velocity_O = Twist{Eigen::Vector3d::Zero(), {0, 1, 0}};
  ASSERT_TRUE(dut_.AddObject(walking).ok());
  EXPECT_EQ(Ask({4, 2, 0}, 3).object, 7);
  GivenObject planned = Person(8);
  planned.future = {{At(2), Pose::Translation(4, -2, 0)}, {At(3), Pose::Translation(4, -2, 0)}};
  ASSERT_TRUE(dut_.AddObject(planned).ok());
  EXPECT_EQ(Ask({4, -1, 0}, 1.5).object, 8);
  EXPECT_EQ(Ask({4, -2, 0}, 300).object, 8);
}

TEST_F(GivenObjectTest, GoesWithoutATraceAndOnlyIfItWasGiven) {
  const std::string before = dut_.Publish()->Hash();
  ASSERT_TRUE(dut_.AddObject(Person()).ok());
  EXPECT_NE(dut_.Publish()->Hash(), before);
  ASSERT_TRUE(dut_.RemoveObject(7).ok());
  EXPECT_EQ(dut_.Publish()->Hash(), before);
  for (const ObjectId id : {7, 1, 0, -5}) {
    EXPECT_EQ(dut_.RemoveObject(id).code(), absl::StatusCode::kNotFound) << id;
  }
  EXPECT_EQ(dut_.Publish()->Hash(), before);
}

// Its id is the label of something else: the scene cannot tell of what, but not free.
TEST_F(GivenObjectTest, PointsElsewhereAreBackgroundAndNamed) {
  ASSERT_TRUE(dut_.AddObject(Person()).ok());
  for (const bool with_motion : {false, true}) {
    Frame frame = FrameAt(with_motion ? 2.1 : 2);
    for (double y = 0; y < 1; y += 0.1) AddPoint(frame, 7, {12, y, 0.05});
    if (with_motion) frame.motions = {{7, Pose::Translation(0, 1, 0), At(2)}};
    const auto report = dut_.Apply(frame);
    ASSERT_TRUE(report.ok());
    EXPECT_EQ(report->points_given, 0u);
    ASSERT_EQ(report->issues.size(), 1u);
    EXPECT_EQ(report->issues[0].kind, ObjectIssueKind::kContradicted);
    EXPECT_EQ(report->issues[0].id, 7);
    EXPECT_GT(report->issues[0].value, 5);
    EXPECT_EQ(Find(7)->history.size(), 1u);
    const VoxelMap& map = scene_->static_map_W;
    EXPECT_EQ(map.State(map.grid().KeyOf({12, 0.5, 0.05})), VoxelState::kOccupied);
  }
}

TEST_F(GivenObjectTest, OutlivesItsLifetimeUnseen) {
  ASSERT_TRUE(dut_.AddObject(Person()).ok());
  ASSERT_TRUE(dut_.Apply(FrameAt(100)).ok());
  EXPECT_NE(Find(7), nullptr);
  EXPECT_EQ(Find(1), nullptr);
}

TEST_F(GivenObjectTest, TakesNoPointsButTheirRaysClear) {
  ASSERT_TRUE(dut_.AddObject(Person()).ok());
  Frame frame = FrameAt(2);
  AddPoint(frame, 7, {3.7, 0.05, 0.05});
  AddPoint(frame, 7, {3.7, 0.25, 0.05});
  const auto report = dut_.Apply(frame);
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->points_given, 2u);
  EXPECT_EQ(report->points_used, 2u);
  const MovingObject* object = Find(7);
  EXPECT_EQ(object->map_O.observed_count(), 0);
  EXPECT_EQ(object->frames_seen, 0);
  EXPECT_EQ(object->t_k(), At(1));
  const VoxelMap& map = scene_->static_map_W;
  EXPECT_EQ(map.State(map.grid().KeyOf({2.05, 0.03, 0.03})), VoxelState::kFree);
  EXPECT_NE(map.State(map.grid().KeyOf({3.7, 0.05, 0.05})), VoxelState::kOccupied);
}

TEST_F(GivenObjectTest, FramesMoveIt) {
  ASSERT_TRUE(dut_.AddObject(Person()).ok());
  Frame frame = FrameAt(2);
  frame.motions = {{7, Pose::Translation(0, 1, 0), At(1)}};
  ASSERT_TRUE(dut_.Apply(frame).ok());
  EXPECT_EQ(Find(7)->history.back().T_W_O, Pose::Translation(4, 1, 0));
  EXPECT_NEAR(Find(7)->SpeedMps(), 1, 1e-9);
}

// One may be placed later than the newest frame.
TEST_F(GivenObjectTest, FramesFromBeforeItsPoseDoNotMoveIt) {
  GivenObject later = Person();
  later.pose.stamp = At(5);
  ASSERT_TRUE(dut_.AddObject(later).ok());
  Frame frame = FrameAt(2);
  frame.motions = {{7, Pose::Translation(0, 1, 0), At(1)}};
  const auto report = dut_.Apply(frame);
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->motions_ignored, 1u);
  EXPECT_EQ(Find(7)->history.size(), 1u);
}

TEST_F(GivenObjectTest, ConvexMeshesAreTakenOthersRefused) {
  GivenObject given = Person();
  const auto convex = std::make_shared<const Mesh>(HullAround(Box{{1, 1, 1}}));
  given.shape = TriangleMesh{convex};
  ASSERT_TRUE(dut_.AddObject(given).ok());
  EXPECT_EQ(*Find(7)->given_shape, Shape(ConvexPolytope{convex}));
  auto turned = std::make_shared<Mesh>(*convex);
  for (auto& triangle : turned->triangles) std::swap(triangle[0], triangle[1]);
  turned->triangles.pop_back();  // and a hole
  for (const Shape& shape : {Shape(TriangleMesh{turned}), Shape(ConvexPolytope{turned})}) {
    given.id += 10;
    given.shape = shape;
    const absl::Status status = dut_.AddObject(given);
    ASSERT_TRUE(status.ok()) << status;
    EXPECT_EQ(std::get<ConvexPolytope>(*Find(given.id)->given_shape).mesh->triangles.size(), 12u);
  }
  auto dented = std::make_shared<Mesh>(*convex);
  dented->vertices.emplace_back(0, 0, 0);
  dented->triangles.back()[2] = 8;
  given.id = 8;
  given.shape = TriangleMesh{dented};
  ExpectRefused(given, "shape.mesh.triangles are not convex");
  EXPECT_THAT(std::string(dut_.AddObject(given).message()), HasSubstr("in convex parts"));
  dented->triangles.resize(kMaxGivenTriangles + 1, {0, 1, 2});
  ExpectRefused(given, "shape: 2001 triangles", absl::StatusCode::kResourceExhausted);
}

TEST_F(GivenObjectTest, BadInputIsNamed) {
  const double kNan = std::nan("");
  GivenObject given = Person(0);
  ExpectRefused(given, "object_id: is 0");
  given = Person(1);
  ExpectRefused(given, "object_id: the scene has", absl::StatusCode::kAlreadyExists);
  given = Person();
  given.shape = Cylinder{-1, 1};
  ExpectRefused(given, "shape.cylinder.radius_m is -1");
  given = Person();
  given.shape = ConvexPolytope{};
  ExpectRefused(given, "shape.convex has no triangles");
  given = Person();
  given.pose.T_W_O.translation.x() = kNan;
  ExpectRefused(given, "world_from_object: is not finite");
  given.pose.T_W_O.translation.x() = 1e6;
  ExpectRefused(given, "world_from_object.translation_m: reaches 1e+06");
  given = Person();
  given.pose.T_W_O.rotation.w() = 2;
  ExpectRefused(given, "world_from_object.rotation");
  given = Person();
  given.pose.stamp = Time::max();
  ExpectRefused(given, "stamp_ns: is 9223372036854775807");
  given = Person();
  given.velocity_O = Twist{{0, kNan, 0}, Eigen::Vector3d::Zero()};
  ExpectRefused(given, "velocity_object.angular_radps: is of length nan");
  given.velocity_O = Twist{Eigen::Vector3d::Zero(), {2000, 0, 0}};
  ExpectRefused(given, "velocity_object.linear_mps: is of length 2000; the limit is 1000");
  given = Person();
  given.future = {{At(1), Pose{}}};
  ExpectRefused(given, "future.stamps_ns[0]: is 1000000000, not after the object's pose");
  given.future = {{given.pose.stamp + FromSeconds(0.05), given.pose.T_W_O}};
  given.future.push_back({given.pose.stamp + FromSeconds(0.1), given.pose.T_W_O});
  given.future[1].T_W_O.translation.x() += 90;
  ExpectRefused(given, "future.world_from_object[1]: is reached at 1800 m/s; the limit is 1000");
}

TEST_F(GivenObjectTest, OneTooManyIsRefused) {
  FrameLimits limits;
  limits.max_objects = 2;
  SceneBuilder dut({}, limits, pool_);
  EXPECT_TRUE(dut.AddObject(Person(1)).ok());
  const std::vector<GivenObject> two{Person(2), Person(3)};
  const absl::Status status = dut.AddObjects(two);
  EXPECT_EQ(status.code(), absl::StatusCode::kResourceExhausted);
  EXPECT_THAT(std::string(status.message()), StartsWith("objects[1].object_id: the scene holds 2"));
  EXPECT_EQ(dut.Publish()->objects.size(), 1u);
}

TEST_F(GivenObjectTest, OfManyAllOrNoneAreTaken) {
  std::vector<GivenObject> many{Person(9), Person(3), Person(9)};
  EXPECT_EQ(dut_.AddObjects(many).code(), absl::StatusCode::kAlreadyExists);
  EXPECT_EQ(Find(9), nullptr);
  many.pop_back();
  ASSERT_TRUE(dut_.AddObjects(many).ok());
  EXPECT_NE(Find(9), nullptr);
  EXPECT_TRUE(std::is_sorted(scene_->objects.begin(), scene_->objects.end(),
                             [](const auto& a, const auto& b) { return a->id < b->id; }));
  const absl::Status status = dut_.RemoveObjects(std::vector<ObjectId>{3, 1});
  EXPECT_EQ(status.code(), absl::StatusCode::kNotFound);
  EXPECT_THAT(std::string(status.message()), StartsWith("object_ids[1]: object 1 was recon"));
  EXPECT_NE(Find(3), nullptr);
  ASSERT_TRUE(dut_.RemoveObjects(std::vector<ObjectId>{3, 9}).ok());
  EXPECT_EQ(Find(3), nullptr);
}

TEST_F(GivenObjectTest, ResetForgetsThem) {
  ASSERT_TRUE(dut_.AddObject(Person()).ok());
  dut_.Reset();
  EXPECT_EQ(Find(7), nullptr);
  EXPECT_TRUE(dut_.AddObject(Person()).ok()) << "before any frame";
}

// Of another clock: until then it would stand still.
TEST_F(GivenObjectTest, RefusesStampsFarAheadOfTheFrames) {
  constexpr auto kCode = absl::StatusCode::kFailedPrecondition;
  GivenObject given = Person();
  given.pose.stamp = At(3601.1);
  ExpectRefused(given, "stamp_ns: 3601100000000 lies more than 3600 s (max_stamp_jump_s)", kCode);
  given.pose.stamp = At(1);
  given.future = {{At(1.7e9), Pose::Translation(6, 0, 0)}};
  ExpectRefused(given, "future.stamps_ns[0]: 1700000000000000000 lies more than", kCode);
  given.future = {{At(3601), Pose::Translation(4, 0, 0)}, {At(1e5), Pose::Translation(6, 0, 0)}};
  EXPECT_TRUE(dut_.AddObject(given).ok());  // where it is until then is said
  EXPECT_EQ(dut_.SetFuture(1, {{At(1.7e9), Pose::Translation(6, 0, 0)}}).code(), kCode);
  EXPECT_TRUE(dut_.SetFuture(1, {}).ok());
}

TEST_F(GivenObjectTest, WithoutFramesAnyStampWillDo) {
  dut_.Reset();
  GivenObject given = Person();
  given.pose.stamp = At(1.7e9);
  EXPECT_TRUE(dut_.AddObject(given).ok());
}

}  // namespace
}  // namespace clearway
