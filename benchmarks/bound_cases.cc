#include "bound_cases.h"

#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <utility>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "box_corners.h"
#include "clearway/io/lidar_folder.h"
#include "clearway/report/prediction_score.h"
#include "clearway/scene/scene_builder.h"
#include "clearway/sim/scenarios.h"
#include "recorded_boxes.h"
#include "scene/object_motion.h"
#include "support/data_folder.h"

namespace clearway::bench {
namespace {

using Classes = std::map<ObjectId, std::string>;

// Misses of nearly the same time ahead, added up: there are few of these.
std::vector<Misses> AddedUp(const std::vector<Misses>& soon) {
  std::map<std::int64_t, Misses> by_ms;
  for (const Misses& misses : soon) {
    Misses& sum = by_ms.try_emplace(std::llround(100 * misses.ahead_s)).first->second;
    sum.ahead_s = misses.ahead_s;
    sum.sum_m2 += misses.sum_m2;
    sum.count += misses.count;
  }
  std::vector<Misses> result;
  for (const auto& [ms, sum] : by_ms) result.push_back(sum);
  return result;
}

BoundCase CaseOf(const MovingObject& object, const SceneParams& params) {
  BoundCase result;
  const bool has_motion = object.history.size() > 1;
  const Twist last_O = has_motion ? LastMotionOf(object.history) : Twist{};
  result.evidence = EvidenceOf(object.history, object.tracked_since, last_O, *object.solid, params);
  result.evidence.velocity_O = object.velocity_O.value_or(Twist{});
  result.evidence.has_motion &= object.velocity_O.has_value();
  result.evidence.misses.soon = AddedUp(result.evidence.misses.soon);
  const Twist& velocity_O = result.evidence.velocity_O;
  result.speed_mps = (velocity_O.linear + velocity_O.angular.cross(CenterOf(*object.solid))).norm();
  result.age_s = ToSeconds(object.t_k() - object.tracked_since);
  result.errors_m.fill(std::numeric_limits<double>::quiet_NaN());
  return result;
}

void AddCases(const SceneSnapshot& scene, const Truth& truth, const Classes& classes,
              std::size_t setting, std::vector<BoundCase>& cases) {
  const MovingObject* last = nullptr;
  ForEachPrediction(scene, truth, {kBoundAhead.begin(), kBoundAhead.end()},
                    [&](const ScoredPrediction& prediction) {
                      if (last != &prediction.object) {
                        last = &prediction.object;
                        cases.push_back(CaseOf(*last, scene.params));
                        cases.back().setting = setting;
                        cases.back().object_class = classes.at(last->id);
                      }
                      cases.back().errors_m[prediction.ahead] = prediction.error_m;
                    });
}

using Read = std::function<absl::StatusOr<Frame>(std::size_t)>;

absl::Status Run(std::size_t frames, const Read& read, const SceneParams& params,
                 const Truth& truth, const Classes& classes, std::size_t setting,
                 std::vector<BoundCase>& cases) {
  ThreadPool pool(1);
  SceneBuilder builder(params, {}, pool);
  for (std::size_t k = 0; k < frames; ++k) {
    const auto frame = read(k);
    if (!frame.ok()) return frame.status();
    if (const auto report = builder.Apply(*frame); !report.ok()) return report.status();
    AddCases(*builder.Publish(), truth, classes, setting, cases);
  }
  return absl::OkStatus();
}

// Boxes are seen as their corners unless the scans are there.
absl::StatusOr<BoundRecording> OfBoxes(const std::string& name, const std::string& group,
                                       const LidarFolder& folder, bool has_scans) {
  BoundRecording recording{name, group, false, {}};
  Classes classes;
  for (const RecordedBox& box : folder.boxes) classes[box.id] = box.type;
  const auto read = [&](std::size_t k) {
    auto frame = folder.frames.read(k);
    if (frame.ok() && !has_scans) SeeBoxes(folder, *frame);
    return frame;
  };
  const auto settings = BoundSettings();
  for (std::size_t i = 0; i < settings.size(); ++i) {
    SceneParams params = settings[i].params;
    if (!has_scans) params.rays.max_range_m = -1;
    params.resolution_m = 1;  // the static map does not matter
    const absl::Status status =
        Run(folder.frames.frame_count, read, params, TruthOf(folder), classes, i, recording.cases);
    if (!status.ok()) return status;
  }
  return recording;
}

// Static points are left out: the static map does not matter.
Frame ObjectsAlone(Frame frame) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < frame.points_S.size(); ++i) {
    if (frame.labels[i] <= kStaticLabel) continue;
    frame.points_S[kept] = frame.points_S[i];
    frame.labels[kept++] = frame.labels[i];
  }
  frame.points_S.resize(kept);
  frame.labels.resize(kept);
  frame.no_return.clear();
  return frame;
}

absl::StatusOr<BoundRecording> Simulated(const std::string& world, bool exact) {
  const auto simulation =
      MakeScenario(world, {.noise = exact ? SlamNoise{} : SlamNoise::TableOne()});
  if (!simulation.ok()) return simulation.status();
  const std::string name = absl::StrCat("sim:", world, exact ? "" : ", Table I");
  BoundRecording recording{name, name, true, {}};
  const std::size_t frames = simulation->frame_count();
  const auto shared = std::make_shared<const World>(simulation->world());
  const Truth truth = TruthOf(shared, simulation->StampOf(frames - 1));
  Classes classes;
  for (const ObjectId id : shared->ObjectIds()) classes[id] = "simulated";
  const auto read = [&](std::size_t k) -> absl::StatusOr<Frame> {
    return ObjectsAlone(simulation->MakeFrame(k));
  };
  const auto settings = BoundSettings();
  for (std::size_t i = 0; i < settings.size(); ++i) {
    SceneParams params = settings[i].params;
    if (params.rest_distance_m > 0) continue;  // nothing is parked there
    params.resolution_m = 1;
    params.object_resolution_m = simulation->Frames().resolution_m;
    const absl::Status status = Run(frames, read, params, truth, classes, i, recording.cases);
    if (!status.ok()) return status;
  }
  return recording;
}

// Adds recordings until one fails.
class Recordings {
 public:
  void Add(absl::StatusOr<BoundRecording> recording) {
    if (!status_.ok()) return;
    status_ = recording.status();
    if (status_.ok()) all_.push_back(*std::move(recording));
  }
  void AddFolder(const std::string& name, const std::string& group, const std::string& path,
                 LidarPoses poses, bool has_scans) {
    const auto found = DataPath(path);
    if (!found) return;
    const auto folder =
        OpenLidarFolder(*found, {.poses = poses, .allow_missing_points = !has_scans});
    if (!folder.ok()) return Add(folder.status());
    Add(OfBoxes(name, group, *folder, has_scans));
  }
  void AddTracks(const std::string& name, const std::string& type,
                 const absl::StatusOr<cli::Tracks>& recorded) {
    if (!recorded.ok()) return Add(recorded.status());
    Add(OfBoxes(name, name, FolderOf(recorded->tracks, type), false));
  }
  absl::StatusOr<std::vector<BoundRecording>> Take() && {
    if (!status_.ok()) return status_;
    return std::move(all_);
  }

 private:
  absl::Status status_;
  std::vector<BoundRecording> all_;
};

void AddTrackFiles(Recordings& recordings) {
  using cli::Json;
  if (DataPath("ucy/zara01_obsmat.txt")) {
    const Json tracks = {{"format", "ucy"}, {"file", "ucy/zara01_obsmat.txt"},
                         {"from_s", 0},     {"for_s", 1},
                         {"radius_m", 0.3}, {"height_m", 1.7}};
    recordings.AddTracks("UCY zara01", "pedestrian, UCY", cli::ReadUcyTracks(tracks, "tracks"));
  }
  for (const char* name : {"USA_US101-4_1", "USA_Lanker-1_1", "USA_Peach-4_8"}) {
    const std::string file = absl::StrCat("commonroad/", name, "_T-1.xml");
    if (!DataPath(file)) continue;
    const Json tracks = {
        {"format", "commonroad"}, {"file", file}, {"from_s", 0}, {"for_s", 1}, {"height_m", 1.6}};
    recordings.AddTracks(name, "car, NGSIM", cli::ReadCommonRoadTracks(tracks, "tracks"));
  }
}

}  // namespace

std::vector<BoundSetting> BoundSettings() {
  std::vector<BoundSetting> settings;
  for (const auto& [name, model] :
       {std::pair{"track", MotionModel::kTrack}, {"last_motion", MotionModel::kLastMotion}}) {
    for (const double rest_distance_m : {0.6, 0.0}) {
      SceneParams params;
      params.rays.max_range_m = 50;
      params.motion = model;
      params.rest_distance_m = rest_distance_m;
      settings.push_back({absl::StrCat(name, rest_distance_m > 0 ? "_rest" : ""), params});
    }
  }
  return settings;
}

absl::StatusOr<std::vector<BoundRecording>> ReadBoundRecordings() {
  Recordings recordings;
  for (int sequence = 1; sequence <= 13; ++sequence) {
    const std::string number = absl::StrFormat("%04d", sequence);
    recordings.AddFolder("KITTI " + number, "KITTI " + number, "kitti_tracks/" + number,
                         LidarPoses::kAny, false);
  }
  for (const auto& [name, poses] :
       {std::pair{"KITTI 0000 icp", LidarPoses::kIcp}, {"KITTI 0000 oxts", LidarPoses::kOxts}}) {
    recordings.AddFolder(name, "KITTI 0000", "kitti0000_fov", poses, true);
  }
  recordings.AddFolder("Argoverse 2", "Argoverse 2", "av2_adcf7d18", LidarPoses::kAny, false);
  AddTrackFiles(recordings);
  for (const char* world : {"street", "crossing", "lab", "articulated"}) {
    recordings.Add(Simulated(world, true));
  }
  recordings.Add(Simulated("street", false));
  return std::move(recordings).Take();
}

}  // namespace clearway::bench
