// Contact of shapes against closed formulas. Cases within 1e-6 m of touching are left out.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "clearway/geometry/hull.h"
#include "sim/convex.h"
#include "sim/meshes.h"
#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

constexpr double kMarginM = 1e-6;

// Distance from a point to each shape, negative inside.
double DistanceTo(const Box& box, const Eigen::Vector3d& p) {
  const Eigen::Vector3d out = p.cwiseAbs() - 0.5 * box.size_m;
  return out.cwiseMax(0.0).norm() + std::min(0.0, out.maxCoeff());
}
double DistanceTo(const Cylinder& c, const Eigen::Vector3d& p) {
  const double side = p.head<2>().norm() - c.radius_m, end = std::abs(p.z()) - c.length_m / 2;
  return std::hypot(std::max(side, 0.0), std::max(end, 0.0)) + std::min(0.0, std::max(side, end));
}
double DistanceTo(const Capsule& c, const Eigen::Vector3d& p) {
  const double above = std::max(0.0, std::abs(p.z()) - c.length_m / 2);
  return std::hypot(p.x(), p.y(), above) - c.radius_m;
}

// Largest gap between two boxes along any of the 15 axes that can separate them; Gottschalk, Lin,
// Manocha, "OBBTree", 1996. Negative if they overlap.
double Gap(const Box& a, const Pose& T_W_A, const Box& b, const Pose& T_W_B) {
  const Eigen::Matrix3d A = T_W_A.rotation.toRotationMatrix();
  const Eigen::Matrix3d B = T_W_B.rotation.toRotationMatrix();
  double gap = -1e9;
  const auto try_axis = [&](const Eigen::Vector3d& axis) {
    if (axis.norm() < 1e-9) return;
    const Eigen::Vector3d n = axis.normalized();
    const double reach = 0.5 * a.size_m.dot((A.transpose() * n).cwiseAbs()) +
                         0.5 * b.size_m.dot((B.transpose() * n).cwiseAbs());
    gap = std::max(gap, std::abs(n.dot(T_W_B.translation - T_W_A.translation)) - reach);
  };
  for (int i = 0; i < 3; ++i) {
    try_axis(A.col(i));
    try_axis(B.col(i));
    for (int j = 0; j < 3; ++j) try_axis(A.col(i).cross(B.col(j)));
  }
  return gap;
}

struct Counts {
  int touching = 0, apart = 0;
};

// Random poses; `gap` is positive where the shapes are apart.
Counts Compare(const Shape& a, const Shape& b, double spread_m,
               const std::function<double(const Pose&, const Pose&)>& gap) {
  Random random(17);
  Counts counts;
  for (int i = 0; i < 3'000; ++i) {
    const Pose T_W_A = random.AnyPose(spread_m);
    const Pose T_W_B = random.AnyPose(spread_m);
    const double gap_m = gap(T_W_A, T_W_B);
    if (std::abs(gap_m) < kMarginM) continue;
    EXPECT_EQ(Touch(a, T_W_A, b, T_W_B), gap_m < 0) << gap_m;
    EXPECT_EQ(Touch(b, T_W_B, a, T_W_A), gap_m < 0) << gap_m;
    ++(gap_m < 0 ? counts.touching : counts.apart);
  }
  return counts;
}

template <class S>
void CompareWithSphere(const S& shape) {
  const Sphere sphere{0.3};
  const Counts counts = Compare(shape, sphere, 1, [&](const Pose& T_W_A, const Pose& T_W_B) {
    return DistanceTo(shape, Inverse(T_W_A) * T_W_B.translation) - sphere.radius_m;
  });
  EXPECT_GT(counts.touching, 200);
  EXPECT_GT(counts.apart, 200);
}

TEST(TouchTest, BoxAndSphere) { CompareWithSphere(Box{{1, 0.7, 0.4}}); }
TEST(TouchTest, CylinderAndSphere) { CompareWithSphere(Cylinder{0.4, 1}); }
TEST(TouchTest, CapsuleAndSphere) { CompareWithSphere(Capsule{0.3, 1}); }

TEST(TouchTest, BoxAndBox) {
  const Box a{{1, 0.7, 0.4}}, b{{0.2, 1.6, 0.5}};
  const Counts counts = Compare(
      a, b, 1, [&](const Pose& T_W_A, const Pose& T_W_B) { return Gap(a, T_W_A, b, T_W_B); });
  EXPECT_GT(counts.touching, 200);
  EXPECT_GT(counts.apart, 200);
}

TEST(TouchTest, HullAndMeshOfABoxCountAsTheBox) {
  const Box a{{1, 0.7, 0.4}}, b{{0.4, 1.2, 0.6}};
  const auto mesh = Extruded({{-0.2, -0.3}, {0.2, -0.3}, {0.2, 0.3}, {-0.2, 0.3}}, 1.2);
  const auto hull = std::make_shared<const Mesh>(ConvexHullOf(mesh->vertices));
  const auto gap = [&](const Pose& T_W_A, const Pose& T_W_B) { return Gap(a, T_W_A, b, T_W_B); };
  Compare(a, ConvexPolytope{hull}, 1, gap);
  Compare(a, TriangleMesh{mesh}, 1, gap);
}

TEST(TouchTest, AShapeWithinAMeshTouchesIt) {
  const TriangleMesh mesh{Extruded({{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}, 4)};
  EXPECT_TRUE(Touch(mesh, Pose(), Sphere{0.5}, Pose::Translation(0.7, 0.3, 0)));
  EXPECT_TRUE(Touch(Sphere{0.5}, Pose(), mesh, Pose::Translation(0.7, 0.3, 0)));
  EXPECT_FALSE(Touch(mesh, Pose(), Sphere{0.5}, Pose::Translation(2.7, 0.3, 0)));
}

TEST(TouchTest, FacesThatMeetTouch) {
  const Box box{{1, 1, 1}};
  EXPECT_TRUE(Touch(box, Pose(), box, Pose::Translation(1, 0, 0)));
  EXPECT_TRUE(Touch(box, Pose(), box, Pose()));
  EXPECT_FALSE(Touch(box, Pose(), box, Pose::Translation(1.00001, 0, 0)));
}

}  // namespace
}  // namespace clearway
