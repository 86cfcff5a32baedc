#include "scene/view_registration.h"

#include <gtest/gtest.h>

#include <functional>
#include <numbers>
#include <vector>

#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

constexpr double kRadPerDeg = std::numbers::pi / 180;

// The back (x = 0), a side (y = 0) and the roof (z = 0) of a car of 4 x 1.8 x 1.5 m.
enum class Face { kBack, kSide, kRoof };

Eigen::Vector3d On(Face face, Random& random) {
  const double x = random.Uniform(0, 4), y = random.Uniform(0, 1.8), z = random.Uniform(-1.5, 0);
  switch (face) {
    case Face::kBack:
      return {0, y, z};
    case Face::kSide:
      return {x, 0, z};
    default:
      return {x, y, 0};
  }
}

std::vector<Eigen::Vector3d> PointsOn(const std::vector<Face>& faces, int each, Random& random) {
  std::vector<Eigen::Vector3d> points_O;
  for (const Face face : faces) {
    for (int i = 0; i < each; ++i) points_O.push_back(On(face, random));
  }
  return points_O;
}

VoxelMap MapOf(const std::vector<Eigen::Vector3d>& points_O) {
  VoxelMap map_O(0.1);
  for (const Eigen::Vector3d& p : points_O) map_O.Set(map_O.grid().KeyOf(p), 1000);
  return map_O;
}

std::vector<Eigen::Vector3d> Placed(const Pose& T_W_O,
                                    const std::vector<Eigen::Vector3d>& points_O) {
  std::vector<Eigen::Vector3d> points_W;
  for (const Eigen::Vector3d& p : points_O) points_W.push_back(T_W_O * p);
  return points_W;
}

Pose Off(double up_to_m, double up_to_deg, Random& random) {
  return Exp({up_to_deg * kRadPerDeg * random.UnitVector(), up_to_m * random.UnitVector()});
}

double Turned_deg(const Pose& a, const Pose& b) {
  return a.rotation.angularDistance(b.rotation) / kRadPerDeg;
}

class ViewOfACar : public testing::Test {
 protected:
  // How far from the truth views of these points end that are guessed 0.6 m and 3 degrees off: the
  // mean of some.
  struct Errors {
    double mean_m = 0, mean_deg = 0;
  };
  Errors ErrorsOf(const std::function<std::vector<Eigen::Vector3d>()>& points_O) {
    constexpr int kViews = 60;
    Errors errors;
    for (int i = 0; i < kViews; ++i) {
      const PoseGuess guess{T_W_O_ * Off(0.6, 3, random_), 0.4, 0.04};
      const Pose dut = RegisterView(map_O_, Placed(T_W_O_, points_O()), {{guess}});
      errors.mean_m += (Inverse(T_W_O_) * dut).translation.norm() / kViews;
      errors.mean_deg += Turned_deg(dut, T_W_O_) / kViews;
    }
    return errors;
  }

  Random random_{11};
  VoxelMap map_O_ = MapOf(PointsOn({Face::kBack, Face::kSide, Face::kRoof}, 1500, random_));
  Pose T_W_O_ = random_.AnyPose(20);
};

TEST_F(ViewOfACar, IsPutWhereItFits) {
  const Errors dut = ErrorsOf([&] {
    return PointsOn({Face::kBack, Face::kSide, Face::kRoof}, 100, random_);
  });
  EXPECT_LT(dut.mean_m, 0.1);
  EXPECT_LT(dut.mean_deg, 1.5);
}

TEST_F(ViewOfACar, IsPutWhereMostOfItFits) {
  const Errors dut = ErrorsOf([&] {
    auto points_O = PointsOn({Face::kBack, Face::kSide, Face::kRoof}, 100, random_);
    for (int k = 0; k < 60; ++k) points_O.push_back({5.5 + 0.2 * random_.Normal(), 1, -1});
    return points_O;
  });
  EXPECT_LT(dut.mean_m, 0.12);
  EXPECT_LT(dut.mean_deg, 1.5);
}

TEST_F(ViewOfACar, HardlyMovesWhereItFits) {
  const auto points_W =
      Placed(T_W_O_, PointsOn({Face::kBack, Face::kSide, Face::kRoof}, 100, random_));
  const Pose dut = RegisterView(map_O_, points_W, {{{T_W_O_, 0.4, 0.04}}});
  EXPECT_LT((Inverse(T_W_O_) * dut).translation.norm(), 0.1);
}

// Nothing tells how far a wall has slid along itself.
TEST_F(ViewOfACar, OfOneFaceIsNotMovedAlongIt) {
  std::vector<Eigen::Vector3d> points_O;
  for (int i = 0; i < 200; ++i) {
    points_O.push_back({random_.Uniform(1.2, 2.8), 0, random_.Uniform(-1.1, -0.4)});
  }
  const Pose off = Pose::Translation(0.2, 0.3, 0);
  const Pose dut = RegisterView(map_O_, Placed(T_W_O_, points_O), {{{T_W_O_ * off, 0.4, 0.001}}});
  const Eigen::Vector3d left_O = (Inverse(T_W_O_) * dut).translation;
  EXPECT_NEAR(left_O.y(), 0, 0.05);
  EXPECT_NEAR(left_O.x(), 0.2, 0.1);
}

TEST_F(ViewOfACar, ThatFitsNowhereIsWhereTheGuessesSay) {
  const auto points_W =
      Placed(T_W_O_ * Pose::Translation(0, 0, 9), PointsOn({Face::kBack}, 50, random_));
  const Pose near = T_W_O_ * Pose::Translation(0.3, 0, 0);
  const Pose dut = RegisterView(map_O_, points_W, {{{T_W_O_, 0.1, 0.01}, {near, 0.2, 0.02}}});
  // The mean by information, 4 : 1.
  EXPECT_NEAR((Inverse(T_W_O_) * dut).translation.x(), 0.06, 1e-4);
}

TEST_F(ViewOfACar, ThatIsSaidToBeAnywhereIsThere) {
  const auto points_W = Placed(T_W_O_, PointsOn({Face::kBack}, 50, random_));
  for (const double far_m : {1e4, 1e12, 1e15}) {
    const Pose far = Pose::Translation(far_m, 0, 0) * T_W_O_;
    const Pose dut = RegisterView(map_O_, points_W, {{{far, 0.1, 0.01}}});
    EXPECT_LT((dut.translation - far.translation).norm(), 1e-9 * far_m);
  }
}

}  // namespace
}  // namespace clearway
