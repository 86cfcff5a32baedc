#include "clearway/report/identity_score.h"

#include <gtest/gtest.h>

#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::AddPoint;
using testing_support::FrameAt;

class IdentityScoreTest : public testing::Test {
 protected:
  // Frames that show that id, a tenth of a second apart.
  void Show(ObjectId id, int frames, std::vector<ObjectId> of_object = {}) {
    SceneSnapshot scene = SceneSnapshot::Empty({});
    if (of_object.empty()) of_object = {id};
    MovingObject object;
    object.id = of_object.front();
    object.also.assign(of_object.begin() + 1, of_object.end());
    scene.objects = {std::make_shared<const MovingObject>(object)};
    for (int i = 0; i < frames; ++i) {
      Frame frame = FrameAt(seconds_ += 0.1);
      AddPoint(frame, kStaticLabel, {1, 0, 0});
      AddPoint(frame, id, {2, 0, 0});
      dut_.Add(frame, scene, true_ids_);
    }
  }
  void Wait(double seconds) { seconds_ += seconds; }
  void Expect(std::size_t came_back, std::size_t known_again, std::size_t wrong) {
    const Identities found = dut_.Result();
    EXPECT_EQ(found.came_back, came_back);
    EXPECT_EQ(found.known_again, known_again);
    EXPECT_EQ(found.wrong, wrong);
  }

  IdentityScore dut_;
  const std::map<ObjectId, ObjectId> true_ids_ = {{1, 1}, {2, 2}, {100, 1}, {101, 1}};
  double seconds_ = 0;
};

TEST_F(IdentityScoreTest, CountsWhatIsKnownAgain) {
  Show(1, 10);
  Wait(1);
  Show(100, 10, {1, 100});
  Wait(1);
  Show(101, 10, {101});
  Expect(2, 1, 0);
}

TEST_F(IdentityScoreTest, CountsOnlyWhatCanBeKnown) {
  Show(1, 9);
  Show(100, 30);
  Wait(5.1);
  Show(101, 30);
  Expect(0, 0, 0);
}

TEST_F(IdentityScoreTest, CountsEveryPairOfIdsThatIsWrongOnce) {
  Show(1, 10);
  Show(2, 10, {1, 2});
  Show(100, 10, {2, 100});
  Expect(1, 0, 2);
}

}  // namespace
}  // namespace clearway
