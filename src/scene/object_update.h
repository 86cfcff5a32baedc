// What one frame does to one moving object (II-D).
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "clearway/scene/moving_object.h"
#include "scene/labelled_cloud.h"

namespace clearway {

// What a frame says of one object; at most one of motion and pose is set.
struct ObjectClue {
  const ObjectMotion* motion = nullptr;
  const ObjectPose* pose = nullptr;
  std::span<const std::uint32_t> points;  // its hits, as indices into the cloud
  std::vector<ObjectId> named_as;         // of an object of several ids: by which of them
  // What its points say where prediction alone places it, or what a motion starts from: its pose,
  // as estimated, or by how much they are off.
  std::optional<Pose> T_W_O_estimated;
  Eigen::Vector3d off_W = Eigen::Vector3d::Zero();

  // Whether it says where the object is.
  bool Places() const { return motion != nullptr || pose != nullptr; }
};

// By id, so that objects are visited in one order.
using ClueMap = std::map<ObjectId, ObjectClue>;
// A scene's objects while a frame is applied to them.
using ObjectMap = std::map<ObjectId, std::shared_ptr<const MovingObject>>;

// First sight: O near the centroid of the object's points (at least one), less than a voxel away,
// where its grid does not depend on which points these are; orientation identity. A motion in the
// same frame gives the first velocity.
MovingObject FirstSight(ObjectId id, const LabelledCloud& cloud, const ObjectClue& clue, Time stamp,
                        const SceneParams& params);

// The object with O carried to the frame's stamp: by the motion (eq. 2), by the source's pose, or,
// if it was seen without either, by prediction, which is marked. With params.object_pose_error_m a
// motion or a pose is mended by how the points fit the object's map. Poses older than
// params.history are forgotten.
MovingObject Moved(MovingObject object, const LabelledCloud& cloud, const ObjectClue& clue,
                   Time stamp, const SceneParams& params);

// Notes that a frame of that stamp used these ids, unless one is the object's newest one.
void NoteIds(MovingObject& object, const std::vector<ObjectId>& named_as, Time stamp);

// T_W_O where the motion starts: known or predicted. A motion that starts before the object was
// first seen counts, as a constant screw, from then on.
Pose StartOf(const ObjectMotion& motion, const MovingObject& object, Time stamp,
             const SceneParams& params);

// T_W_O where the clue's motion or pose puts it at `stamp`; none if it does not say.
std::optional<Pose> StatedPose(const MovingObject& object, const ObjectClue& clue, Time stamp,
                               const SceneParams& params);

// Whether the motion starts from a pose of the object that is known, be it by another prediction:
// not after the newest, and not before the first.
bool StartsAtAPose(const ObjectMotion& motion, const MovingObject& object);

// Whether the object was unplaced for so long that nothing tells where O is in this frame: a motion
// that starts, or a prediction that would have to reach, beyond the horizon. Its model has to be
// begun anew. Nor does a frame from before the pose of a given object tell where that one is.
bool OutOfReach(const MovingObject& object, const ObjectClue& clue, Time stamp,
                const SceneParams& params);

}  // namespace clearway
