#include "clearway/report/box_residue.h"

#include <gtest/gtest.h>

namespace clearway {
namespace {

const Time kFirst(std::chrono::seconds(1)), kLast(std::chrono::seconds(2));

// A box of 2 m at the origin, then at x = 10.
Truth OneBox() {
  Truth truth;
  truth.end = kLast;
  truth.boxes = [](Time t) {
    return std::vector<TrueBox>{
        {7, Eigen::Vector3d::Constant(2), Pose::Translation(t == kFirst ? 0 : 10, 0, 0)}};
  };
  return truth;
}

TEST(BoxResidueScore, CountsWhatIsOccupiedWhereABoxWas) {
  BoxResidueScore dut(OneBox());
  dut.Add(kFirst);
  dut.Add(kLast);
  VoxelMap map_W(0.1);
  const auto occupy = [&](double x, double z) {
    map_W.Set(map_W.grid().KeyOf({x, 0.05, z}), map_W.model().clamp_max);
  };
  occupy(0.05, 0.05);   // in the box that has left: counts
  occupy(0.95, 0.05);   // at its face
  occupy(0.05, -0.85);  // near its bottom
  occupy(5.05, 0.05);   // outside
  occupy(10.05, 0.05);  // where it may still be
  const BoxResidue found = dut.Of(map_W);
  EXPECT_EQ(found.occupied, 1);
  EXPECT_EQ(found.passed, 18 * 18 * 16);  // centres: 1.8 m along x and y, 1.6 m along z
}

TEST(BoxResidueScore, NothingIsKnownWithoutBoxes) {
  const BoxResidue found = BoxResidueScore(OneBox()).Of(VoxelMap(0.1));
  EXPECT_EQ(found.passed, 0);
}

}  // namespace
}  // namespace clearway
