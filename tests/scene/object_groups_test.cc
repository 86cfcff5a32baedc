// Objects of several rigid parts, through the scene that makes them: what belongs together.
#include <gmock/gmock.h>

#include "clearway/scene/scene_delta.h"
#include "scene/truck_scene.h"

namespace clearway {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using testing_support::AddObject;
using testing_support::At;
using testing_support::FrameAt;

class ObjectGroups : public TruckScene {};

TEST_F(ObjectGroups, AreNoneUnlessToldOf) {
  Frame frame = TruckAt(0);
  frame.parts.clear();
  See(frame, kTractor, TractorAt);
  See(frame, kTrailer, TrailerAt);
  Apply(frame);
  EXPECT_EQ(Object(kTrailer).part_of, kStaticLabel);
  EXPECT_TRUE(scene_->PartsOf(kTractor).empty());
}

TEST_F(ObjectGroups, HaveAMapForEachPart) {
  DriveUntil(1);
  EXPECT_EQ(Object(kTrailer).part_of, kTractor);
  EXPECT_EQ(Object(kTractor).part_of, kStaticLabel);
  ASSERT_EQ(scene_->PartsOf(kTractor).size(), 1u);
  EXPECT_EQ(scene_->PartsOf(kTractor)[0], &Object(kTrailer));
  for (const ObjectId id : {kTractor, kTrailer}) {
    const Eigen::Vector3d size_m = Object(id).observed_box_O.Size();
    EXPECT_LT(size_m.x(), 4.0);  // as long as it is wide, turned by the first sight's angle
    EXPECT_GT(Object(id).map_O.occupied_count(), 100);
  }
}

TEST_F(ObjectGroups, AreRememberedWithoutBeingToldAgain) {
  DriveUntil(1);
  Frame frame = TruckAt(1);
  frame.parts.clear();
  Apply(frame);
  EXPECT_EQ(Object(kTrailer).part_of, kTractor);
}

TEST_F(ObjectGroups, EndWhenToldSo) {
  DriveUntil(1);
  Frame frame = TruckAt(1);
  frame.parts = {{kTrailer, kStaticLabel}};
  Apply(frame);
  EXPECT_EQ(Object(kTrailer).part_of, kStaticLabel);
}

TEST_F(ObjectGroups, AreToldOfObjectsThatAreThere) {
  Frame frame = TruckAt(0);
  See(frame, kTractor, TractorAt);
  Apply(frame);
  frame = TruckAt(kPeriod_s);
  frame.parts.clear();
  See(frame, kTrailer, TrailerAt);
  Apply(frame);
  EXPECT_EQ(Object(kTrailer).part_of, kStaticLabel);
}

TEST_F(ObjectGroups, AreKeptWhileAnyPartIsSeenAndDroppedTogether) {
  params_.object_lifetime = std::chrono::seconds(1);
  SetUp();
  DriveUntil(1);
  for (double t = 1; t < 3 - 1e-9; t += kPeriod_s) {
    Frame frame = TruckAt(t);
    See(frame, kTractor, TractorAt);
    Move(frame, kTractor, TractorAt);
    Apply(frame);
  }
  ASSERT_NE(scene_->FindObject(kTrailer), nullptr);
  EXPECT_EQ(Object(kTrailer).last_seen, At(0.9));
  EXPECT_EQ(Apply(FrameAt(3.95)).objects_dropped, 2u);
  EXPECT_TRUE(scene_->objects.empty());
}

TEST_F(ObjectGroups, OfGivenPartsAreRemovedTogether) {
  for (const ObjectId id : {kTractor, kTrailer, ObjectId{7}}) {
    ASSERT_TRUE(
        dut_->AddObject({id, Box{{1, 1, 1}}, {At(0), Pose::Translation(id, 0, 0)}, {}, {}}).ok());
  }
  Apply(TruckAt(0));
  EXPECT_EQ(Object(kTrailer).part_of, kTractor);
  ASSERT_TRUE(dut_->RemoveObject(kTractor).ok());
  scene_ = dut_->Publish();
  ASSERT_EQ(scene_->objects.size(), 1u);
  EXPECT_EQ(scene_->objects[0]->id, 7);
}

TEST_F(ObjectGroups, AreKeptByDifferencesAndPartOfTheHash) {
  DriveUntil(1);
  const ScenePtr before = scene_;
  Frame frame = TruckAt(1);
  frame.parts = {{kTrailer, kStaticLabel}};
  Apply(frame);
  for (const SceneSnapshot* from : {static_cast<const SceneSnapshot*>(nullptr), before.get()}) {
    const auto copy = clearway::Apply(from, Diff(from, *scene_));
    ASSERT_TRUE(copy.ok()) << copy.status();
    EXPECT_TRUE(SameContent(*copy, *scene_));
  }
  SceneSnapshot together = *scene_;
  MovingObject trailer = Object(kTrailer);
  trailer.part_of = kTractor;
  together.objects[1] = std::make_shared<const MovingObject>(trailer);
  EXPECT_FALSE(SameContent(together, *scene_));
  EXPECT_NE(together.Hash(), scene_->Hash());
}

TEST_F(ObjectGroups, OfDifferencesThatAreWrongAreRefused) {
  DriveUntil(0.1);
  for (const ObjectId whole : {ObjectId{-1}, kTrailer}) {
    SceneDelta delta = Diff(nullptr, *scene_);
    delta.objects[1].part_of = whole;
    const auto refused = clearway::Apply(nullptr, delta);
    EXPECT_EQ(refused.status().code(), absl::StatusCode::kInvalidArgument);
    EXPECT_THAT(refused.status().message(), HasSubstr("objects[id=2].part_of_id"));
  }
}

TEST_F(ObjectGroups, OfPartsThatAreWrongAreRefused) {
  const auto refused = [&](std::vector<ObjectPart> parts) {
    Frame frame = TruckAt(1);
    frame.parts = std::move(parts);
    return std::string(Validate(frame, FrameLimits{}).message());
  };
  EXPECT_THAT(refused({{0, 1}}), StartsWith("parts[0].object_id: is 0"));
  EXPECT_THAT(refused({{2, -1}}), StartsWith("parts[0].whole_id: is -1"));
  EXPECT_THAT(refused({{2, 1}, {3, 3}}), StartsWith("parts[1].whole_id: is object 3 itself"));
  EXPECT_THAT(refused({{2, 1}, {2, 3}}), StartsWith("parts[1].object_id: object 2 is told"));
  EXPECT_THAT(refused({{3, 2}, {2, 1}}),
              StartsWith("parts[0].whole_id: object 2 is itself a part, of object 1"));
  FrameLimits limits;
  limits.max_objects = 1;
  Frame frame = TruckAt(1);
  frame.parts = {{2, 1}, {3, 1}};
  EXPECT_EQ(Validate(frame, limits).code(), absl::StatusCode::kResourceExhausted);
}

TEST_F(ObjectGroups, OfPartsOfPartsAreRefused) {
  DriveUntil(0.2);
  const std::string hash = scene_->Hash();
  Frame frame = TruckAt(1);
  frame.parts = {{3, kTrailer}};
  EXPECT_THAT(std::string(dut_->Apply(frame).status().message()),
              StartsWith("parts[0].whole_id: object 2 is itself a part, of object 1"));
  frame.parts = {{kTractor, 3}};
  const absl::Status status = dut_->Apply(frame).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_THAT(std::string(status.message()),
              StartsWith("parts[0].object_id: object 1 has a part itself, object 2"));
  EXPECT_EQ(dut_->Publish()->Hash(), hash);
  frame.parts = {{kTrailer, kStaticLabel}, {kTractor, kTrailer}};  // the other way round
  EXPECT_TRUE(dut_->Apply(frame).ok());
}

TEST_F(ObjectGroups, AreNotTakenForOthersThatWereLost) {
  params_.reidentify = true;
  params_.motion = MotionModel::kTrack;
  const auto drive = [&](ObjectId id, double from_s, bool is_part) {
    for (double t = from_s; t < from_s + 1; t += kPeriod_s) {
      Frame frame = FrameAt(t);
      if (is_part) frame.parts = {{id, 50}};
      const Place straight_at = [](double s) { return Pose::Translation(8 * s, 0, 0); };
      See(frame, id, straight_at);
      if (t > from_s) Move(frame, id, straight_at);
      Apply(frame);
    }
  };
  for (const bool is_part : {false, true}) {
    SetUp();
    drive(5, 0, false);
    drive(9, 2, is_part);
    EXPECT_EQ(scene_->objects.size(), is_part ? 2u : 1u);
  }
}

}  // namespace
}  // namespace clearway
