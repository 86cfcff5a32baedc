#include "clearway/scene/scene_builder.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"
#include "scene/dynamic_hits.h"
#include "scene/earlier_views.h"
#include "scene/frame_objects.h"
#include "scene/frame_stamps.h"
#include "scene/label_filter.h"
#include "scene/labelled_cloud.h"
#include "scene/normalized_frame.h"
#include "scene/object_groups.h"
#include "scene/other_ids.h"
#include "scene/points_of_given.h"
#include "scene/scene_size.h"
#include "scene/second_look.h"
#include "scene/sensor_registration.h"

namespace clearway {
namespace {

// What of the frame says where the object is.
std::string FieldThatPlaces(const Frame& frame, const MovingObject& object) {
  for (std::size_t i = 0; i < frame.motions.size(); ++i) {
    if (object.IsCalled(frame.motions[i].id)) {
      return absl::StrCat("motions[", i, "].world_motion");
    }
  }
  for (std::size_t i = 0; i < frame.poses.size(); ++i) {
    if (object.IsCalled(frame.poses[i].id)) return absl::StrCat("poses[", i, "].world_from_box");
  }
  return "labels";
}

void ForgetFarBlocks(const Eigen::Vector3d& sensor_W, const SceneParams& params,
                     VoxelMap& static_map_W) {
  if (params.keep_distance_m == 0) return;
  static_map_W.ForgetBlocksOutside(
      {sensor_W.array() - params.keep_distance_m, sensor_W.array() + params.keep_distance_m});
}

// Positions beyond the limit are as if out of bounds: of one object or point, not of its frame.
SceneParams WithinLimits(SceneParams params, const FrameLimits& limits) {
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(limits.max_coordinate_m);
  params.bounds_W = Intersection(params.bounds_W, {-reach, reach});
  return params;
}

absl::Status CheckObjects(const ObjectMap& objects, const Frame& frame, const FrameLimits& limits) {
  if (objects.size() > limits.max_objects) {
    return absl::ResourceExhaustedError(absl::StrCat("labels: the scene would hold ",
                                                     objects.size(), " objects; the limit is ",
                                                     limits.max_objects));
  }
  for (const auto& [id, object] : objects) {
    const double reach_m = object->history.back().T_W_O.translation.cwiseAbs().maxCoeff();
    if (reach_m <= limits.max_coordinate_m) continue;
    return absl::InvalidArgumentError(absl::StrCat(
        FieldThatPlaces(frame, *object), ": object ", id, " would be at ", NumberText(reach_m),
        " m; the limit is ", NumberText(limits.max_coordinate_m), " m"));
  }
  return absl::OkStatus();
}

}  // namespace

SceneBuilder::SceneBuilder(const SceneParams& params, const FrameLimits& limits, ThreadPool& pool)
    : scene_(SceneSnapshot::Empty(WithinLimits(params, limits))),
      earlier_views_(std::make_shared<const EarlierViews>()),
      corrections_(params.history),
      limits_(limits),
      pool_(&pool),
      caster_(pool) {}

absl::StatusOr<FrameReport> SceneBuilder::Apply(const Frame& frame, const ApplyOptions& options) {
  if (absl::Status status = Validate(frame, limits_); !status.ok()) return status;
  if (has_frames_) {
    absl::Status status = CheckStamp(frame, scene_.stamp, sensor_stamps_, limits_, options);
    if (!status.ok()) return status;
  }
  if (const auto renormalized = Renormalized(frame)) return Apply(*renormalized, options);
  if (absl::Status status = CheckFits(frame); !status.ok()) return status;
  if (!scene_.params.MendsSensorPoses()) return ApplyInScene(frame);

  WorldCorrections corrections = corrections_;
  // Of a late frame the correction lies between those of the frames about it.
  const bool is_known =
      IsLate(frame.stamp) || (!corrections.Empty() && corrections.NewestStamp() == frame.stamp);
  if (!is_known) {  // else by another sensor's scan, and objects are placed by it
    corrections.Add(frame.stamp,
                    RegisterWorld(frame, scene_.LastingMap(), corrections_, scene_.params));
  }
  absl::StatusOr<FrameReport> report = ApplyInScene(CarriedBy(corrections, frame));
  if (report.ok()) corrections_ = std::move(corrections);
  return report;
}

absl::StatusOr<FrameReport> SceneBuilder::ApplyInScene(const Frame& frame) {
  if (absl::Status status = CheckFits(frame); !status.ok()) return status;
  if (absl::Status status = CheckParts(frame, scene_.objects); !status.ok()) return status;

  const bool late = IsLate(frame.stamp);
  const Time now = late ? scene_.stamp : frame.stamp;
  FrameReport report;
  report.T_W_S = frame.T_W_S;
  report.late_by = now - frame.stamp;
  LabelledCloud cloud = PlaceCloud(frame, scene_.params, report);
  const VoxelGrid& grid = scene_.static_map_W.grid();
  if (auto status = CheckRays(grid, cloud.Rays(), scene_.params.rays, limits_); !status.ok()) {
    return status;
  }
  LabelDoubts doubts;
  if (scene_.params.filter_labels) {
    doubts = LeaveOutDoubtful(scene_.objects, frame.stamp, scene_.params, cloud);
    report.points_doubted = doubts.doubted;
  }
  ClueMap clues = CluesOf(frame, cloud);
  LeaveOutPointsOfGiven(scene_.objects, frame.stamp, scene_.params, cloud, clues, report);
  VoxelMap static_map_W = scene_.LastingMap();
  const auto views = std::make_shared<EarlierViews>(*earlier_views_);
  ObjectMap objects = Continuing(scene_.objects, cloud, frame.stamp, scene_.params, limits_, *views,
                                 clues, static_map_W, report);
  auto cast = CastIntoStatic(cloud, frame.stamp, static_map_W);  // II-B, II-C
  if (!cast.ok()) return cast.status();
  if (!late) ForgetFarBlocks(frame.T_W_S.translation, scene_.params, static_map_W);
  UpdateObjects(frame, cloud, std::move(clues), scene_.params, *pool_, objects, report);  // II-D
  ForgetFilled(believed_W_, scene_.stamp, objects, static_map_W);
  // What is known of the newest stamp is the second look at a late frame's points.
  if (late) ForgetFilled(doubts.believed_W, frame.stamp, objects, static_map_W, true);
  DynamicSpace dynamic_W = StillIn(static_map_W, *cast);
  report.voxels_dynamic = dynamic_W.voxels().size();
  SceneObjects dropped_lately;
  Surroundings around_objects;
  if (scene_.params.reidentify) {
    dropped_lately = DroppedLately(dropped_lately_, scene_.objects, objects, now, scene_.params);
    around_objects =
        SeenAround(around_objects_, objects, cloud, frame.stamp, scene_.params, *pool_);
    if (!late) {  // else the next frame on time does
      report.objects_reidentified = JoinSeenAgain(objects, dropped_lately, cloud, frame.stamp,
                                                  around_objects, scene_.params, *pool_);
    }
    std::erase_if(around_objects,
                  [&](const auto& entry) { return !objects.contains(entry.first); });
  }
  if (absl::Status status = CheckObjects(objects, frame, limits_); !status.ok()) return status;
  SceneObjects next_objects;
  for (auto& [id, object] : objects) next_objects.push_back(std::move(object));
  const std::size_t blocks =
      static_map_W.blocks().size() + BlocksOf(next_objects, dropped_lately, around_objects);
  if (absl::Status status = CheckBlocks("points_m", blocks, limits_); !status.ok()) return status;

  // Whatever takes memory comes before the first change.
  views->Keep(std::move(cloud), frame.stamp, next_objects);
  SensorStamps sensor_stamps = WithStampOf(frame, now, sensor_stamps_, limits_);
  if (late) {
    doubts.believed_W = believed_W_;
  } else if (frame.stamp == scene_.stamp) {
    doubts.believed_W.insert(doubts.believed_W.begin(), believed_W_.begin(), believed_W_.end());
  }

  scene_.static_map_W = std::move(static_map_W);
  scene_.dynamic_W = std::move(dynamic_W);
  earlier_views_ = views;
  believed_W_ = std::move(doubts.believed_W);
  dropped_lately_ = std::move(dropped_lately);
  around_objects_ = std::move(around_objects);
  scene_.objects = std::move(next_objects);
  sensor_stamps_ = std::move(sensor_stamps);
  scene_.stamp = now;
  has_frames_ = changed_ = true;
  return report;
}

absl::StatusOr<DynamicSpace> SceneBuilder::CastIntoStatic(const LabelledCloud& cloud, Time stamp,
                                                          VoxelMap& static_map_W) {
  const SceneParams& params = scene_.params;
  std::optional<ScanUpdate> update = caster_.Cast(static_map_W, cloud.Rays(), params.rays);
  const std::size_t most_blocks = std::min(kMaxScanBlocks, limits_.max_blocks);
  if (!update || update->keys().size() > most_blocks) {
    return absl::ResourceExhaustedError(absl::StrCat(
        "points_m: the rays touch more than ", most_blocks, " blocks of ", kBlockSize,
        " voxels cubed, which is the limit; give the scene a max_range_m, or larger voxels"));
  }
  if (params.dynamic_life == Duration::zero()) {
    static_map_W.Update(*update, *pool_);
    return DynamicSpace();
  }
  DynamicChange change = TakeDynamicHits(static_map_W, scene_.dynamic_W, stamp, params, *update);
  static_map_W.Update(*update, *pool_);
  return PutDynamic(std::move(change), static_map_W);
}

absl::Status SceneBuilder::CheckFits(const Frame& frame) const {
  const VoxelGrid& grid = scene_.static_map_W.grid();
  if (!grid.Addressable(frame.T_W_S.translation)) {
    return absl::InvalidArgumentError(
        absl::StrCat("world_from_sensor.translation_m: outside the addressable space of ",
                     grid.limit_m(), " m about the origin"));
  }
  return absl::OkStatus();
}

ScenePtr SceneBuilder::Publish() {
  if (changed_) {
    const auto next = std::make_shared<SceneSnapshot>(scene_);
    next->version = ++scene_.version;
    published_ = next;
    changed_ = false;
  }
  return published_;
}

void SceneBuilder::Reset() {
  const std::uint64_t version = scene_.version;
  scene_ = SceneSnapshot::Empty(scene_.params);
  scene_.version = version;
  believed_W_.clear();
  earlier_views_ = std::make_shared<const EarlierViews>();
  dropped_lately_.clear();
  around_objects_.clear();
  corrections_ = WorldCorrections(scene_.params.history);
  sensor_stamps_.clear();
  has_frames_ = false;
  changed_ = true;
}

}  // namespace clearway
