// The labelled boxes of LiDAR folders.
#include <algorithm>
#include <map>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "clearway/io/lidar_folder.h"
#include "cli/open_source.h"
#include "cli/tracks.h"

namespace clearway::cli {
namespace {

// Boxes are labelled with an error of their own, which over a second is small.
constexpr double kVelocityOver_s = 1;

absl::StatusOr<LidarFolder> OpenTables(const JsonFields& fields) {
  SourceFlags flags;
  if (fields.Has("poses")) {
    const auto poses = fields.Text("poses");
    if (!poses.ok()) return poses.status();
    if (*poses != "icp" && *poses != "oxts" && *poses != "plain") {
      return fields.Error("poses", "expected icp, oxts or plain");
    }
    flags.poses = *poses;
  }
  const auto origin = RecordedOrigin(fields);
  if (!origin.ok()) return origin.status();
  flags.origin = *origin;
  const auto folder = RecordedFile(fields);
  if (!folder.ok()) return folder.status();
  constexpr bool kAllowMissingPoints = true;
  auto tables = OpenFolder(folder->string(), flags, kAllowMissingPoints);
  if (tables.ok()) return tables;
  // Flags of the command line that the message may advise are fields here.
  const std::string message = absl::StrReplaceAll(
      tables.status().message(), {{"--origin first", "\"origin_m\": \"first\""},
                                  {"--origin x,y,z,", "\"origin_m\": [x, y, z],"}});
  return absl::Status(tables.status().code(), absl::StrCat(fields.PathOf("file"), ": ", message));
}

// When each frame was, in seconds since the first.
std::map<int, double> SecondsOf(const std::vector<RecordedPose>& poses) {
  std::map<int, double> seconds;
  for (const RecordedPose& pose : poses) {
    seconds[pose.frame] = ToSeconds(pose.stamp - poses.front().stamp);
  }
  return seconds;
}

}  // namespace

absl::StatusOr<Tracks> ReadBoxTracks(const Json& value, const std::string& path) {
  const auto fields =
      JsonFields::Of(value, path, {"format", "file", "from_s", "for_s", "poses", "origin_m"});
  if (!fields.ok()) return fields.status();
  const auto folder = OpenTables(*fields);
  if (!folder.ok()) return folder.status();
  const std::map<int, double> seconds = SecondsOf(folder->poses);
  std::map<ObjectId, Track> by_id;
  for (const RecordedBox& box : folder->boxes) {
    Track& track = by_id.try_emplace(box.id, Track{Box{}, {}}).first->second;
    Box& largest = std::get<Box>(track.shape);
    if (box.size_m.isZero()) {
      return fields->Error("file", "its objects come without sizes; boxes are needed");
    }
    largest.size_m = largest.size_m.cwiseMax(box.size_m);
    track.seen.push_back({seconds.at(box.frame), box.T_W_B});
  }
  Tracks result{{}, *folder->frames.left_out};
  for (auto& [id, track] : by_id) {
    GuessVelocities(kVelocityOver_s, track);
    track.name = absl::StrCat("track ", id);
    result.tracks.push_back(std::move(track));
  }
  return result;
}

}  // namespace clearway::cli
