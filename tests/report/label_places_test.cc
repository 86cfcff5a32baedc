#include "report/label_places.h"

#include <gtest/gtest.h>

#include <vector>

#include "support/random.h"

namespace clearway::report {
namespace {

using testing_support::Random;

const Rect kFrame{Eigen::Vector2d(0, 0), Eigen::Vector2d(1000, 600)};
const Eigen::Vector2d kSize(100, 20);

Rect SquareAt(double x, double y) {
  return {Eigen::Vector2d(x - 10, y - 10), Eigen::Vector2d(x + 10, y + 10)};
}

bool Overlap(const Rect& a, const Rect& b) {
  return a.intersects(b) && a.intersection(b).volume() > 0;
}

TEST(LabelPlaces, AboveAndInTheMiddle) {
  const Rect dut = LabelPlaces(kFrame).Take(SquareAt(300, 200), kSize);
  EXPECT_DOUBLE_EQ(dut.center().x(), 300);
  EXPECT_LT(dut.max().y(), 190);
  EXPECT_GT(dut.max().y(), 180);
  EXPECT_EQ(dut.sizes(), kSize);
}

TEST(LabelPlaces, TheSecondOneGivesWay) {
  LabelPlaces dut(kFrame);
  const Rect first = dut.Take(SquareAt(300, 200), kSize);
  const Rect second = dut.Take(SquareAt(320, 200), kSize);
  EXPECT_FALSE(Overlap(first, second));
  EXPECT_GT(second.min().y(), 210);  // below what it names
}

TEST(LabelPlaces, WhatIsToBeClearIsNotCovered) {
  LabelPlaces dut(kFrame);
  dut.KeepClear(SquareAt(300, 175));
  EXPECT_FALSE(Overlap(dut.Take(SquareAt(300, 200), kSize), SquareAt(300, 175)));
}

TEST(LabelPlaces, StaysInTheFrame) {
  for (const double x : {2.0, 500.0, 998.0}) {
    for (const double y : {3.0, 300.0, 597.0}) {
      const Rect dut = LabelPlaces(kFrame).Take(SquareAt(x, y), kSize);
      EXPECT_TRUE(kFrame.contains(dut)) << x << " " << y;
      EXPECT_FALSE(Overlap(dut, SquareAt(x, y))) << x << " " << y;
    }
  }
}

TEST(LabelPlaces, NoneCoversAnotherWhereThereIsRoom) {
  Random random(1);
  LabelPlaces dut(kFrame);
  std::vector<Rect> labels;
  for (int i = 0; i < 30; ++i) {
    labels.push_back(dut.Take(SquareAt(random.Uniform(0, 1000), random.Uniform(0, 600)), kSize));
    for (int k = 0; k < i; ++k) EXPECT_FALSE(Overlap(labels[i], labels[k])) << i << " " << k;
  }
}

TEST(LabelPlaces, TellsThoseThatCouldBeAnothers) {
  LabelPlaces dut(kFrame);
  const Rect above = dut.Take(SquareAt(300, 200), kSize),
             below = dut.Take(SquareAt(300, 200), kSize);
  EXPECT_FALSE(LabelPlaces::IsFar(above, SquareAt(300, 200)));
  EXPECT_FALSE(LabelPlaces::IsFar(below, SquareAt(300, 200)));
  EXPECT_TRUE(LabelPlaces::IsFar(dut.Take(SquareAt(300, 200), kSize), SquareAt(300, 200)));
}

TEST(LabelPlaces, ACrowdIsLabelledAllTheSame) {
  LabelPlaces dut(kFrame);
  for (int i = 0; i < 50; ++i) EXPECT_TRUE(kFrame.contains(dut.Take(SquareAt(300, 200), kSize)));
}

}  // namespace
}  // namespace clearway::report
