#include "clearway/io/carla.h"

#include <limits>
#include <memory>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "io/carla_tables.h"
#include "io/lidar_frames.h"
#include "io/numbered_scans.h"
#include "io/ply_vertices.h"

namespace clearway {
namespace {

using Path = std::filesystem::path;

constexpr char kSensorTable[] = "carla_sensor.csv", kActorTable[] = "carla_actors.csv";

// What points are read with. Shared by the copies of a FrameSource.
struct Scans {
  NumberedScans files;
  std::set<ObjectId> objects, ego;

  ObjectId LabelOf(double index) const {
    // Ids that no label can be have no row either.
    if (index > std::numeric_limits<ObjectId>::max()) return kStaticLabel;
    const auto id = static_cast<ObjectId>(index);
    if (ego.contains(id)) return kIgnoreLabel;
    return objects.contains(id) ? id : kStaticLabel;
  }
};

absl::Status ReadPoints(const Scans& scans, const Path& path, Frame& frame) {
  constexpr bool kNoIndex = false, kIndex = true, kMayBeNan = true;  // a lost return
  constexpr PlyProperty kProperties[] = {{"x", kNoIndex, kMayBeNan},
                                         {"y", kNoIndex, kMayBeNan},
                                         {"z", kNoIndex, kMayBeNan},
                                         {"ObjIdx", kIndex}};
  constexpr std::size_t kWidth = std::size(kProperties);
  const auto values = ReadPlyVertices(path, kProperties);
  if (!values.ok()) return values.status();
  const std::size_t count = values->size() / kWidth;
  frame.points_S.reserve(count);
  frame.labels.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double* const row = values->data() + i * kWidth;
    frame.points_S.push_back(Eigen::Vector3d(row[0], -row[1], row[2]).cast<float>());
    frame.labels.push_back(scans.LabelOf(row[3]));
  }
  return absl::OkStatus();
}

std::string Described(const std::string& name, std::size_t unposed, const CarlaActors& actors,
                      bool has_actors) {
  std::vector<std::string> parts = {name};
  const auto add = [&parts](std::size_t count, const char* what) {
    if (count > 0) parts.push_back(absl::StrCat(count, " ", what));
  };
  add(unposed, "scans without a row in carla_sensor.csv are left out");
  add(actors.without_pose, "rows of actors at frames without a row in carla_sensor.csv, too");
  if (!has_actors) parts.push_back("no carla_actors.csv: all points are static");
  return absl::StrJoin(parts, "; ");
}

}  // namespace

bool IsCarla(const Path& folder) {
  std::error_code error;
  return std::filesystem::is_regular_file(folder / kSensorTable, error);
}

absl::StatusOr<LidarFolder> OpenCarla(const Path& given, const LidarFolderOptions& options) {
  std::error_code error;
  const Path folder = std::filesystem::absolute(given, error).lexically_normal();
  LidarScans scans;
  scans.name = absl::StrCat("CARLA scans ", folder.string());
  scans.options = options;
  auto poses = ReadCarlaSensor(folder / kSensorTable, *scans.left_out);
  if (!poses.ok()) return poses.status();
  scans.poses = *std::move(poses);
  const bool has_actors = std::filesystem::exists(folder / kActorTable, error);
  auto actors = has_actors ? ReadCarlaActors(folder / kActorTable, scans.poses, *scans.left_out)
                           : CarlaActors();
  if (!actors.ok()) return actors.status();
  scans.boxes = std::move(actors->boxes);
  auto files = NumberedScans::In(folder, ".ply", 6);  // as CARLA's examples save them
  if (!files.ok()) return files.status();
  const std::size_t unposed =
      files->LeaveOutUnposed(scans.poses, folder / kSensorTable, *scans.left_out);
  const auto shared =
      std::make_shared<const Scans>(Scans{*std::move(files), actors->objects, actors->ego});
  scans.points_of = [shared](int frame) { return shared->files.FileOf(frame); };
  scans.read = [shared](const Path& path, std::span<const RecordedBox>, Frame& frame) {
    return ReadPoints(*shared, path, frame);
  };
  const std::string description = Described(scans.name, unposed, *actors, has_actors);
  absl::StatusOr<LidarFolder> result = FramesOf(std::move(scans));
  if (result.ok()) result->frames.description = description;
  return result;
}

}  // namespace clearway
