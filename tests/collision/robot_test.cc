#include "clearway/collision/robot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "clearway/geometry/hull.h"
#include "collision/test_world.h"

namespace clearway {
namespace {

using ::testing::HasSubstr;

Mesh Flat() { return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}}; }

Mesh TurnedInward(Mesh mesh) {
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

Mesh Dented() {
  Mesh mesh = *CubeMesh(1);
  mesh.vertices[7] *= 0.2;
  return mesh;
}

std::shared_ptr<const Mesh> Shared(Mesh mesh) {
  return std::make_shared<const Mesh>(std::move(mesh));
}

TEST(RobotTest, Empty) {
  const Robot dut;
  EXPECT_THAT(std::string(Validate(dut).message()), HasSubstr("links is empty"));
  EXPECT_EQ(RobotId(dut), RobotId(Robot{}));
}

TEST(RobotTest, SingleShapeIsOneLinkAtItsOrigin) {
  const Robot dut = Robot::SingleShape("ball", Sphere{0.5});
  ASSERT_EQ(dut.links.size(), 1u);
  ASSERT_EQ(dut.links[0].shapes.size(), 1u);
  EXPECT_EQ(dut.name, "ball");
  EXPECT_EQ(std::get<Sphere>(dut.links[0].shapes[0].shape).radius_m, 0.5);
  EXPECT_EQ(dut.links[0].shapes[0].T_L_G, Pose{});
}

TEST(RobotTest, EveryKindOfShapeIsValid) {
  for (const Shape& shape :
       {Shape{Sphere{1}}, Shape{Box{{1, 2, 3}}}, Shape{Capsule{1, 2}}, Shape{Cylinder{1, 2}},
        Shape{ConvexPolytope{CubeMesh(1)}}, Shape{TriangleMesh{CubeMesh(1)}},
        Shape{TriangleMesh{Shared(Flat())}}}) {
    EXPECT_EQ(Validate(Robot::SingleShape("r", shape)), absl::OkStatus());
  }
}

TEST(RobotTest, HullsOfHullFunctionAreValid) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 200; ++i) {
    points.emplace_back(std::sin(i * 1.7), std::cos(i * 2.3), std::sin(i * 0.9 + 1));
  }
  const ConvexPolytope hull{Shared(ConvexHullOf(points))};
  EXPECT_EQ(Validate(Robot::SingleShape("r", hull)), absl::OkStatus());
}

TEST(RobotTest, TheIdIsThatOfTheContent) {
  EXPECT_EQ(RobotId(Robot::SingleShape("ball", Sphere{0.5})),
            RobotId(Robot::SingleShape("ball", Sphere{0.5})));
  EXPECT_EQ(RobotId(Robot::SingleShape("m", TriangleMesh{CubeMesh(1)})),
            RobotId(Robot::SingleShape("m", TriangleMesh{CubeMesh(1)})));
  EXPECT_EQ(RobotId(Robot::SingleShape("ball", Sphere{0.5})).size(), 32u);
}

TEST(RobotTest, TheIdIsTheSameOnEveryMachine) {
  EXPECT_EQ(RobotId(Robot::SingleShape("ball", Sphere{0.5})), "5d71c996243728d64921f8af366514e9");
}

TEST(RobotTest, ZeroHasOneSignInTheId) {
  Robot positive = Robot::SingleShape("ball", Sphere{0.5}), negative = positive;
  negative.links[0].shapes[0].T_L_G.translation = {-0.0, 0, -0.0};
  EXPECT_EQ(RobotId(positive), RobotId(negative));
}

TEST(RobotTest, EveryFieldChangesTheId) {
  const Robot base = Robot::SingleShape("ball", Sphere{0.5});
  std::vector<Robot> robots = {
      base,
      Robot::SingleShape("ball2", Sphere{0.5}),
      Robot::SingleShape("ball", Sphere{0.6}),
      Robot::SingleShape("ball", Box{{0.5, 0.5, 0.5}}),
      Robot::SingleShape("ball", Box{{0.5, 0.5, 0.6}}),
      Robot::SingleShape("ball", Capsule{0.5, 0.5}),
      Robot::SingleShape("ball", Cylinder{0.5, 0.5}),
      Robot::SingleShape("ball", ConvexPolytope{CubeMesh(1)}),
      Robot::SingleShape("ball", TriangleMesh{CubeMesh(1)}),
      Robot::SingleShape("ball", TriangleMesh{CubeMesh(2)}),
      Robot::SingleShape("ball", TriangleMesh{Shared(TurnedInward(*CubeMesh(1)))}),
      {"ball", {base.links[0], base.links[0]}},
      {"ball", {{"ball", {base.links[0].shapes[0], base.links[0].shapes[0]}}}},
      {"ball", {{"hand", base.links[0].shapes}}},
  };
  robots.push_back(base);
  robots.back().links[0].shapes[0].T_L_G = Pose::Translation(0, 0, 1);
  std::set<std::string> ids;
  for (const Robot& robot : robots) ids.insert(RobotId(robot));
  EXPECT_EQ(ids.size(), robots.size());
}

struct Refused {
  Shape shape;
  const char* field;
};

TEST(RobotTest, RefusesBadShapesByField) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  Mesh not_finite = *CubeMesh(1), out_of_range = *CubeMesh(1);
  not_finite.vertices[3].y() = kNaN;
  out_of_range.triangles[5][2] = 8;
  Mesh too_far = *CubeMesh(1);
  too_far.vertices[1].x() = 100.5;
  const Mesh line{{{0, 0, 0}, {1, 1, 1}, {3, 3, 3}, {0.1, 0.1, 0.1}}, {{0, 1, 2}, {3, 1, 3}}};
  const Mesh point{{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}, {{0, 1, 2}}};
  const std::vector<Refused> cases = {
      {Sphere{0}, "sphere.radius_m is 0"},
      {Sphere{kNaN}, "sphere.radius_m is nan"},
      {Sphere{kInf}, "sphere.radius_m is inf"},
      {Box{{1, -1, 1}}, "box.size_m.y is -1"},
      {Capsule{-1, 1}, "capsule.radius_m"},
      {Capsule{1, 0}, "capsule.length_m"},
      {Cylinder{1, kNaN}, "cylinder.length_m"},
      {ConvexPolytope{nullptr}, "convex has no triangles"},
      {ConvexPolytope{Shared(Flat())}, "convex has no volume"},
      {ConvexPolytope{Shared(TurnedInward(*CubeMesh(1)))}, "face inward"},
      {ConvexPolytope{Shared(Dented())}, "not convex"},
      {TriangleMesh{nullptr}, "mesh has no triangles"},
      {TriangleMesh{Shared(Mesh{})}, "mesh has no triangles"},
      {TriangleMesh{Shared(not_finite)},
       "mesh.vertices_m must be finite and within 100 m; vertex 3 is at ("},
      {TriangleMesh{Shared(too_far)}, "vertex 1 is at (100.5, "},
      {TriangleMesh{Shared(line)}, "mesh.triangles have no area: of all 2 the corners"},
      {TriangleMesh{Shared(point)}, "mesh.triangles have no area"},
      {TriangleMesh{Shared(out_of_range)}, "mesh.triangles name vertex 8 of 8 in triangle 5"},
  };
  for (const Refused& refused : cases) {
    const absl::Status status = Validate(Robot::SingleShape("r", refused.shape));
    EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument) << refused.field;
    EXPECT_THAT(std::string(status.message()), HasSubstr(refused.field));
    EXPECT_THAT(std::string(status.message()), HasSubstr("links[0].shapes[0]"));
  }
}

TEST(RobotTest, RefusesLinksOfTooManyShapes) {
  Robot robot = Robot::SingleShape("r", Sphere{1});
  robot.links[0].shapes.assign(1000, {Sphere{1}, Pose{}});
  EXPECT_EQ(Validate(robot), absl::OkStatus());
  robot.links[0].shapes.push_back({Sphere{1}, Pose{}});
  EXPECT_EQ(Validate(robot).code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(std::string(Validate(robot).message()),
              HasSubstr("links[0].shapes has 1001 items; the limit is 1000"));
}

TEST(RobotTest, RefusesLinksWithoutShapesAndPosesThatAreNotRigid) {
  Robot robot = Robot::SingleShape("r", Sphere{1});
  robot.links.push_back({"bare", {}});
  EXPECT_THAT(std::string(Validate(robot).message()), HasSubstr("links[1].shapes is empty"));
  robot.links[1].shapes.push_back({Sphere{1}, Pose{}});
  robot.links[1].shapes[0].T_L_G.rotation.coeffs() *= 2;
  EXPECT_EQ(Validate(robot).code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(std::string(Validate(robot).message()),
              HasSubstr("links[1].shapes[0].link_from_shape"));
}

}  // namespace
}  // namespace clearway
