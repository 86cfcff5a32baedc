#include "clearway/report/true_ids.h"

#include <gtest/gtest.h>

#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::At;

std::shared_ptr<const MovingObject> Seen(ObjectId id, double last_s,
                                         std::vector<ObjectId> also = {}) {
  MovingObject object;
  object.id = id;
  object.also = std::move(also);
  object.last_seen = At(last_s);
  return std::make_shared<const MovingObject>(object);
}

TEST(TrueIds, NameTheOneThatWasSeenLast) {
  SceneSnapshot scene = SceneSnapshot::Empty({});
  scene.version = 7;
  scene.objects = {Seen(1, 4), Seen(2, 5, {101}), Seen(100, 3), Seen(102, 6)};
  const ScenePtr dut = WithTrueIds(scene, {{1, 1}, {2, 2}, {101, 2}, {100, 1}, {102, 2}, {103, 3}});
  EXPECT_EQ(dut->version, 7u);
  ASSERT_EQ(dut->objects.size(), 2u);
  EXPECT_EQ(dut->FindObject(1)->last_seen, At(4));
  EXPECT_EQ(dut->FindObject(2)->last_seen, At(6));
  EXPECT_EQ(dut->FindObject(101), nullptr);
}

}  // namespace
}  // namespace clearway
