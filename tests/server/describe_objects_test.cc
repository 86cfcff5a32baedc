#include "server/describe_objects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "clearway/scene/scene_builder.h"
#include "support/frames.h"
#include "wire/object_wire.h"

namespace clearway {
namespace {

using testing_support::AddObject;
using testing_support::At;
using testing_support::BoxSurface;
using testing_support::FrameAt;

// Two boxes of 2 m side by side, and a third one far away.
SceneSnapshot ThreeBoxes(std::vector<ObjectPart> parts) {
  ThreadPool pool(1);
  SceneBuilder builder(SceneParams{}, FrameLimits{}, pool);
  Frame frame = FrameAt(0);
  const auto box = BoxSurface({1.9, 1.9, 1.9}, 0.1);
  for (const auto& [id, x_m] : {std::pair{3, 5.0}, {5, 7.0}, {6, 20.0}}) {
    AddObject(frame, id, Pose::Translation(x_m, 0, 0), box);
  }
  frame.parts = parts;
  EXPECT_TRUE(builder.Apply(frame).ok());
  frame = FrameAt(0.1);
  AddObject(frame, 5, Pose::Translation(7, 0, 0), box);
  frame.motions = {{3, Pose(), At(0)}};
  EXPECT_TRUE(builder.Apply(frame).ok());
  return *builder.Publish();
}

const Gone kNever = [] { return false; };

TEST(DescribeObjects, EndsWhenTheClientHasGone) {
  EXPECT_TRUE(absl::IsCancelled(DescribeObjects(ThreeBoxes({}), [] { return true; }).status()));
}

TEST(DescribeObjects, ListsEachOnItsOwnThatIsPartOfNothing) {
  const ObjectList dut = *DescribeObjects(ThreeBoxes({}), kNever);
  ASSERT_EQ(dut.objects.size(), 3u);
  for (const ObjectInfo& object : dut.objects) {
    EXPECT_TRUE(object.parts.empty());
    EXPECT_EQ(object.part_of, kStaticLabel);
    EXPECT_NEAR(object.extent.size_m.x(), 1.9, 0.11);
  }
}

TEST(DescribeObjects, ListsPartsWithTheirWhole) {
  const ObjectList dut = *DescribeObjects(ThreeBoxes({{5, 3}}), kNever);
  ASSERT_EQ(dut.objects.size(), 2u);
  const ObjectInfo& whole = dut.objects[0];
  EXPECT_EQ(whole.id, 3);
  EXPECT_EQ(whole.last_seen, At(0.1));  // its part was
  EXPECT_NEAR(whole.extent.size_m.x(), 3.9, 0.11);
  EXPECT_NEAR(whole.extent.size_m.y(), 1.9, 0.11);
  EXPECT_NEAR(whole.box_W.min.x(), 4, 0.15);
  EXPECT_NEAR(whole.box_W.max.x(), 8, 0.15);
  ASSERT_EQ(whole.parts.size(), 1u);
  EXPECT_EQ(whole.parts[0].id, 5);
  EXPECT_EQ(whole.parts[0].part_of, 3);
  EXPECT_NEAR(whole.parts[0].extent.size_m.x(), 1.9, 0.11);
  EXPECT_EQ(dut.objects[1].id, 6);
}

TEST(DescribeObjects, ListsAPartAloneWhoseWholeIsNotThere) {
  const ObjectList dut = *DescribeObjects(ThreeBoxes({{5, 77}}), kNever);
  ASSERT_EQ(dut.objects.size(), 3u);
  EXPECT_EQ(dut.objects[1].part_of, 77);
}

TEST(DescribeObjects, ComesBackFromTheWire) {
  const ObjectInfo whole = DescribeObjects(ThreeBoxes({{5, 3}}), kNever)->objects[0];
  v1::ObjectInfo proto;
  Write(whole, &proto);
  const auto dut = ReadObject(proto);
  ASSERT_TRUE(dut.ok()) << dut.status();
  ASSERT_EQ(dut->parts.size(), 1u);
  EXPECT_EQ(dut->parts[0].id, 5);
  EXPECT_EQ(dut->parts[0].part_of, 3);
  EXPECT_EQ(dut->parts[0].box_W.min, whole.parts[0].box_W.min);
}

}  // namespace
}  // namespace clearway
