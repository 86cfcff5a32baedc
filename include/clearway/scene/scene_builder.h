// Makes scene versions of frames.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "absl/status/statusor.h"
#include "clearway/base/thread_pool.h"
#include "clearway/map/ray_caster.h"
#include "clearway/scene/frame.h"
#include "clearway/scene/given_object.h"
#include "clearway/scene/object_issue.h"
#include "clearway/scene/scene_snapshot.h"
#include "clearway/scene/world_corrections.h"

namespace clearway {

class EarlierViews;
struct LabelledCloud;

// What became of a frame.
struct FrameReport {
  std::size_t points_used = 0;
  std::size_t points_ignored = 0;     // label -1
  std::size_t points_not_finite = 0;  // or at the sensor, as lost returns are written
  std::size_t points_self = 0;        // on the robot's own body
  std::size_t points_out_of_bounds = 0;
  std::size_t motions_ignored = 0;  // for objects whose place is not known
  // Motions and poses left out as if the frame did not have them: implausible ones (kTurnTooLarge,
  // kMotionTooFar, kMotionTooFast, kContradicted, kJumped, kStartsTooEarly), and those besides
  // another one of the same object (kMotionConflict).
  std::size_t motions_implausible = 0;
  std::size_t motions_conflicting = 0;
  std::size_t objects_created = 0;
  std::size_t objects_dropped = 0;  // one that begins anew is dropped and created
  // Of those seen without a motion or pose: where they are predicted, where their points put them
  // (SceneParams::motion_from_points), and with a new model (kRestarted, kBridgedTooLong).
  std::size_t objects_bridged = 0;
  std::size_t objects_estimated = 0;
  std::size_t objects_restarted = 0;
  // Known again under another id (SceneParams::reidentify).
  std::size_t objects_reidentified = 0;
  // Of those used, the ones of given objects: their rays clear, and they hit nothing.
  std::size_t points_given = 0;
  // Of those used, the ones whose label is doubted (SceneParams::filter_labels): likewise.
  std::size_t points_doubted = 0;
  // In the scene after the frame (SceneParams::dynamic_life).
  std::size_t voxels_dynamic = 0;
  // What was left out of motions, and which objects were restarted: the first kMaxObjectIssues.
  std::vector<ObjectIssue> issues;
  // Where the sensor is in the scene's world, once applied: as the frame says, unless its pose was
  // mended (SceneParams::sensor_pose_error_m). Where this times the inverse of the frame's leads is
  // where the source's world lies in the scene's. An older server does not tell.
  std::optional<Pose> T_W_S = {};
  // By how much the frame's stamp lies before the scene's newest; 0 for a frame on time.
  Duration late_by{};
};

struct ApplyOptions {
  bool allow_stamp_jump = false;  // beyond FrameLimits::max_stamp_jump
};

// The only mutable scene: applies frames (II-B to II-D). One thread at a time; what Publish
// returned may be read by any thread meanwhile. The result depends on the frames and their order
// alone, not on the number of threads.
//
// Stamps of one sensor never go back. A frame of another sensor may be late by at most
// FrameLimits::late_window. It is applied when it arrives, and changes nothing that is newer: the
// scene's stamp stays. Its rays and static points count as those of any frame. Points of an object
// with a newer pose go into the object's map at the object's pose at the frame's stamp; a motion or
// pose of such an object is ignored and counted in FrameReport::motions_ignored.
class SceneBuilder {
 public:
  // `params` must pass Validate. `pool` must outlive the builder.
  SceneBuilder(const SceneParams& params, const FrameLimits& limits, ThreadPool& pool);

  // Applies the frame whole, or refuses it whole and changes nothing: what Validate(frame) refuses;
  // FAILED_PRECONDITION for a stamp that goes back, is late by more than the window, or jumps ahead
  // (the first frame after construction or Reset may have any), and for parts of parts;
  // RESOURCE_EXHAUSTED for more objects, blocks or voxels along rays than FrameLimits allows, and
  // for rays that touch more than kMaxScanBlocks blocks; INVALID_ARGUMENT for poses outside the
  // addressable space.
  absl::StatusOr<FrameReport> Apply(const Frame& frame, const ApplyOptions& options = {});

  // The scene so far as an immutable version. Versions count from 1; without a change since, the
  // same version again.
  ScenePtr Publish();

  // A known static map; it must have the scene's resolution. Voxels it has observed replace those
  // of the scene. With SceneParams::keep_distance_m, those far away are forgotten with the next
  // frame. Applied whole or refused whole: INVALID_ARGUMENT for another resolution,
  // RESOURCE_EXHAUSTED for more blocks than FrameLimits allows.
  absl::Status LoadPrior(const VoxelMap& prior_W);
  // Makes the static map's voxels whose centre lies in the box (VoxelGrid::CentersIn) unknown
  // again. Returns how many of them were not before.
  std::int64_t ClearRegion(const Aabb& box_W);
  void SetKeepOut(std::vector<Aabb> boxes_W);

  // Objects that are told, not seen. Frames move them as they move others, but give them no points
  // and never drop them. An error names the field and changes nothing; of many, all or none are
  // applied, and it names the item ("objects[3].world_from_object").
  // INVALID_ARGUMENT for ids below 1, shapes that Validate refuses, meshes that are not convex,
  // poses, stamps and velocities that are not finite or beyond their limits, and futures as below;
  // ALREADY_EXISTS for an id of the scene; RESOURCE_EXHAUSTED for more than FrameLimits allows, or
  // meshes of more than kMaxGivenTriangles; FAILED_PRECONDITION for a pose, or the first of a
  // future, that lies after the scene's newest frame by more than FrameLimits::max_stamp_jump.
  absl::Status AddObject(const GivenObject& object);
  absl::Status AddObjects(std::span<const GivenObject> objects);
  // Leaves nothing behind; given parts of the object go with it. NOT_FOUND for ids that are of no
  // given object.
  absl::Status RemoveObject(ObjectId id);
  absl::Status RemoveObjects(std::span<const ObjectId> ids);
  // Of any object. Poses whose time has come are forgotten, and with the last of them the object's
  // last motion counts again. NOT_FOUND for an unknown id; INVALID_ARGUMENT for stamps that do not
  // ascend or are not after the object's t_k; RESOURCE_EXHAUSTED for more than kMaxFuturePoses;
  // FAILED_PRECONDITION as AddObjects.
  absl::Status SetFuture(ObjectId id, const std::vector<StampedPose>& poses);
  absl::Status SetFutures(std::span<const ObjectFuture> futures);

  // The empty scene again, without given objects; versions go on counting, and parameters,
  // keep-out zones among them, stay.
  void Reset();

 private:
  absl::Status CheckFits(const Frame& frame) const;
  bool IsLate(Time stamp) const { return has_frames_ && stamp < scene_.stamp; }
  // Applies a valid frame of the scene's own world W.
  absl::StatusOr<FrameReport> ApplyInScene(const Frame& frame);
  // Updates the lasting map by a scan to the static map. Returns what is dynamic in that, or
  // RESOURCE_EXHAUSTED as Apply does.
  absl::StatusOr<DynamicSpace> CastIntoStatic(const LabelledCloud& cloud, Time stamp,
                                              VoxelMap& static_map_W);
  // FAILED_PRECONDITION for a stamp of a given object or a future too far ahead of the frames.
  absl::Status CheckStart(const std::string& field, Time stamp) const;
  absl::Status CheckStarts(const GivenObject& given) const;
  absl::Status SetOneFuture(const ObjectFuture& future,
                            std::vector<std::shared_ptr<const MovingObject>>& objects) const;
  // Takes over what `change` made of the scene's objects, unless it failed.
  absl::Status ChangeObjects(
      const std::function<absl::Status(std::vector<std::shared_ptr<const MovingObject>>&)>& change);

  SceneSnapshot scene_;  // its version is the one published last
  // With SceneParams::filter_labels: static points of the newest stamp that may be an object's.
  std::vector<Eigen::Vector3f> believed_W_;
  // With SceneParams::reidentify: they could be seen again; and what rays show around objects, by
  // their id and in their O.
  std::vector<std::shared_ptr<const MovingObject>> dropped_lately_;
  std::map<ObjectId, VoxelMap> around_objects_;
  std::shared_ptr<const EarlierViews> earlier_views_;  // never null
  WorldCorrections corrections_;
  std::map<std::string, Time> sensor_stamps_;  // newest of each sensor, within the late window
  FrameLimits limits_;
  ThreadPool* pool_;
  RayCaster caster_;
  ScenePtr published_;
  bool has_frames_ = false;
  bool changed_ = true;  // since published_
};

}  // namespace clearway
