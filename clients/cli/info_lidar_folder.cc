#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "absl/strings/str_cat.h"
#include "clearway/io/lidar_folder.h"
#include "clearway/report/table.h"
#include "cli/file_info.h"
#include "cli/frame_reader.h"
#include "cli/left_out_text.h"
#include "cli/text.h"

namespace clearway::cli {
namespace {

struct Track {
  std::string type;
  std::size_t frames = 0;
  std::optional<std::uint64_t> points;               // if the source says how many
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  // mean; 0 if not said
  double path_m = 0;                                 // of the box's centre
  Eigen::Vector3d last_W = Eigen::Vector3d::Zero();
};

bool HasSize(const Track& track) { return !track.size_m.isZero(); }

std::map<ObjectId, Track> TracksOf(const std::vector<RecordedBox>& boxes) {
  std::map<ObjectId, Track> tracks;
  for (const RecordedBox& box : boxes) {
    Track& track = tracks[box.id];
    if (track.frames > 0) track.path_m += (box.T_W_B.translation - track.last_W).norm();
    track.type = box.type;
    track.last_W = box.T_W_B.translation;
    ++track.frames;
    if (box.n_points >= 0) track.points = track.points.value_or(0) + box.n_points;
    track.size_m += (box.size_m - track.size_m) / static_cast<double>(track.frames);
  }
  return tracks;
}

struct PointCount {
  std::size_t frames = 0;  // that can be read
  std::size_t scans = 0;   // of them, those with points
  std::uint64_t points = 0;
  std::uint64_t not_finite = 0;  // of these
  std::set<ObjectId> labels;     // of objects
};

absl::StatusOr<PointCount> CountPoints(const FrameSource& frames) {
  PointCount count;
  FrameReader reader(frames, /*keep_going=*/true);
  for (std::size_t i = 0; i < frames.frame_count; ++i) {
    const std::optional<Frame> frame = reader.Read(i);
    if (!frame) continue;
    ++count.frames;
    count.scans += frame->points_S.empty() ? 0 : 1;
    count.points += frame->points_S.size();
    count.labels.insert(frame->labels.begin(), frame->labels.end());
    count.not_finite += static_cast<std::uint64_t>(std::ranges::count_if(
        frame->points_S, [](const Eigen::Vector3f& p) { return !p.allFinite(); }));
  }
  if (count.frames == 0 && frames.frame_count > 0) return reader.Result();
  count.labels.erase(count.labels.begin(), count.labels.upper_bound(kStaticLabel));
  return count;
}

double SensorPath(const std::vector<RecordedPose>& poses) {
  double length_m = 0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    length_m += (poses[i].T_W_S.translation - poses[i - 1].T_W_S.translation).norm();
  }
  return length_m;
}

std::string TableOf(const std::map<ObjectId, Track>& tracks) {
  Table table({"id", "type", "frames", "points", "size", "path m"});
  for (const auto& [id, track] : tracks) {
    table.AddRow({absl::StrCat(id), track.type, Grouped(track.frames),
                  track.points ? Grouped(*track.points) : "-",
                  HasSize(track) ? Size(track.size_m) : "-", Fixed(track.path_m, 1)});
  }
  return table.ToString();
}

Json JsonOf(const std::map<ObjectId, Track>& tracks) {
  Json objects = Json::array();
  for (const auto& [id, track] : tracks) {
    objects.push_back({{"id", id},
                       {"type", track.type},
                       {"frames", track.frames},
                       {"points", track.points ? Json(*track.points) : Json()},
                       {"size_m", HasSize(track) ? ToJson(track.size_m) : Json()},
                       {"path_m", track.path_m}});
  }
  return objects;
}

std::string DriftOf(const FrameSource& source) {
  if (source.sensor_pose_error_m == 0) return "";
  return absl::StrCat(" (its poses drift: off by about ", source.sensor_pose_error_m, " m)");
}

std::string NotFinite(const PointCount& count) {
  if (count.not_finite == 0) return "";
  return absl::StrCat(", of which ", Grouped(count.not_finite),
                      " are not finite (lost returns, left out)");
}

std::string OriginOf(const FrameSource& source) {
  if (source.origin_m.isZero(0)) return "";
  return absl::StrCat("origin      ", OriginText(source.origin_m), ", subtracted\n");
}

constexpr std::size_t kMaxMissing = 5;  // named

std::string MissingText(const LidarFolder& folder) {
  const auto& missing = folder.missing_points;
  if (missing.empty()) return "";
  std::string text = absl::StrCat("missing     ", Plural(missing.size(), "file"), " of points:\n");
  for (std::size_t i = 0; i < std::min(missing.size(), kMaxMissing); ++i) {
    absl::StrAppend(&text, "            frame ", missing[i].first, ": ", missing[i].second.string(),
                    "\n");
  }
  if (missing.size() > kMaxMissing) {
    absl::StrAppend(&text, "            and ", Grouped(missing.size() - kMaxMissing), " more\n");
  }
  return text;
}

Json MissingJson(const LidarFolder& folder) {
  Json files = Json::array();
  for (const auto& [frame, path] : folder.missing_points) {
    if (files.size() < kMaxMissing) files.push_back({{"frame", frame}, {"file", path.string()}});
  }
  return {{"count", folder.missing_points.size()}, {"first", files}};
}

}  // namespace

absl::StatusOr<FileInfo> InfoOfLidarFolder(const std::string& path, const SourceFlags& flags) {
  const auto folder = OpenFolder(path, flags, /*allow_missing_points=*/true);
  if (!folder.ok()) return folder.status();
  const auto count = CountPoints(folder->frames);
  if (!count.ok()) return count.status();
  const auto tracks = TracksOf(folder->boxes);
  const bool empty = folder->poses.empty();
  const Time first = empty ? Time() : folder->poses.front().stamp;
  const Time last = empty ? Time() : folder->poses.back().stamp;

  FileInfo info;
  info.text =
      absl::StrCat("source      ", folder->frames.description, "\n", "frames      ",
                   Grouped(folder->frames.frame_count), " over ", Seconds(last - first), ", ",
                   Grouped(count->scans), " with points\n", "points      ", Grouped(count->points),
                   NotFinite(*count), "\n", MissingText(*folder), "sensor      moves ",
                   Fixed(SensorPath(folder->poses), 1), " m", DriftOf(folder->frames), "\n",
                   OriginOf(folder->frames), "labels      ", Plural(count->labels.size(), "object"),
                   "\nobjects     ", tracks.size(), "\n", tracks.empty() ? "" : TableOf(tracks));
  if (!folder->frames.left_out->Empty()) {
    absl::StrAppend(&info.text, "left out    ",
                    LeftOutText(*folder->frames.left_out, "            "));
  }
  info.json = {{"kind", "lidar_folder"},
               {"path", path},
               {"description", folder->frames.description},
               {"frames", folder->frames.frame_count},
               {"frames_with_points", count->scans},
               {"points", count->points},
               {"labelled_objects", count->labels.size()},
               {"points_not_finite", count->not_finite},
               {"first_stamp_ns", ToNanoseconds(first)},
               {"last_stamp_ns", ToNanoseconds(last)},
               {"origin_m", ToJson(folder->frames.origin_m)},
               {"sensor_pose_error_m", folder->frames.sensor_pose_error_m},
               {"sensor_pose_error_rad", folder->frames.sensor_pose_error_rad},
               {"missing_points", MissingJson(*folder)},
               {"left_out", ToJson(*folder->frames.left_out)},
               {"objects", JsonOf(tracks)}};
  return info;
}

}  // namespace clearway::cli
