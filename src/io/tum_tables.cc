#include "io/tum_tables.h"

#include <algorithm>
#include <iterator>
#include <system_error>
#include <utility>

#include "absl/strings/str_cat.h"
#include "io/word_table.h"

namespace clearway {
namespace {

using Path = std::filesystem::path;

constexpr Duration kReach = std::chrono::milliseconds(20);  // that of the benchmark's associate.py
constexpr Duration kLongestGap = std::chrono::milliseconds(100);
constexpr int kMostId = 65'535;        // a mask's pixels have 16 bits
constexpr double kDepthFactor = 5000;  // counts per metre

// Those of the colour camera, for which depth images are registered.
struct PublishedCamera {
  const char* name;
  double fx, fy, cx, cy;
};
constexpr PublishedCamera kPublished[] = {{"freiburg1", 517.3, 516.5, 318.6, 255.3},
                                          {"freiburg2", 520.9, 521.0, 325.1, 249.7},
                                          {"freiburg3", 535.4, 539.2, 320.1, 247.6}};

constexpr std::uint32_t kPublishedWidth = 640, kPublishedHeight = 480;

constexpr WordFormat kImageList{LastLine::kMayBeOpen, Comments::kHash, Separators::kCommasToo};
constexpr WordFormat kPoseList{LastLine::kEnds, Comments::kHash, Separators::kCommasToo};

// Sorts by stamps. Of entries with one stamp the first one of the file stays.
template <class Entry>
void SortEntries(const Path& path, std::vector<Entry>& entries, LeftOut& left_out) {
  std::ranges::stable_sort(entries, {}, &Entry::stamp);
  std::vector<Entry> kept;
  kept.reserve(entries.size());
  for (Entry& entry : entries) {
    if (kept.empty() || kept.back().stamp != entry.stamp) {
      kept.push_back(std::move(entry));
      continue;
    }
    left_out.AddRow(absl::StrCat(path.string(), ", line ", entry.line, ": a second row of stamp ",
                                 ToNanoseconds(entry.stamp), " ns; the first: line ",
                                 kept.back().line));
  }
  entries = std::move(kept);
}

DepthImage CameraOf(double fx, double fy, double cx, double cy, double depth_factor) {
  DepthImage camera;
  camera.fx = fx;
  camera.fy = fy;
  camera.cx = cx;
  camera.cy = cy;
  camera.depth_unit_m = 1 / depth_factor;
  return camera;
}

absl::StatusOr<DepthImage> ReadCamera(const Path& path) {
  auto lines = ReadWordRows(path, kImageList);
  if (!lines.ok()) return lines.status();
  if (lines->rows.size() != 1) {
    return absl::InvalidArgumentError(
        absl::StrCat(path.string(), ": ", lines->rows.size(),
                     " lines, expected one: fx fy cx cy [depth_factor]"));
  }
  constexpr double kMost_px = 1e6;
  Row& line = lines->rows.front();
  if (line.size() != 4 && line.size() != 5) {
    return line.WrongCount("fx fy cx cy [depth_factor]");
  }
  const DepthImage camera =
      CameraOf(line.NumberBetween(0, 1, kMost_px), line.NumberBetween(1, 1, kMost_px),
               line.NumberWithin(2, kMost_px), line.NumberWithin(3, kMost_px),
               line.size() == 5 ? line.NumberBetween(4, 1e-3, 1e6) : kDepthFactor);
  if (!line.status().ok()) return line.status();
  return camera;
}

// The entries around t: the last one not after it, and the next.
template <class Entry>
std::pair<const Entry*, const Entry*> Around(const std::vector<Entry>& entries, Time t) {
  const auto next = std::ranges::upper_bound(entries, t, {}, &Entry::stamp);
  return {next == entries.begin() ? nullptr : &*std::prev(next),
          next == entries.end() ? nullptr : &*next};
}

// The nearer one, if it is within reach.
template <class Entry>
const Entry* Nearest(std::pair<const Entry*, const Entry*> around, Time t) {
  const auto [before, after] = around;
  const bool is_after =
      before == nullptr || (after != nullptr && after->stamp - t < t - before->stamp);
  const Entry* const nearest = is_after ? after : before;
  if (nearest == nullptr) return nullptr;
  return std::chrono::abs(nearest->stamp - t) <= kReach ? nearest : nullptr;
}

}  // namespace

void SortByStamp(const Path& path, TumTrack& track, LeftOut& left_out) {
  SortEntries(path, track, left_out);
}

absl::StatusOr<TumImages> ReadTumImages(const Path& path, LeftOut& left_out) {
  TumImages images;
  const auto visit = [&](Row& row) {
    if (row.size() != 2) return row.WrongCount("timestamp filename");
    const Time stamp = row.Stamp(0);
    if (!row.status().ok()) return row.status();
    images.push_back({stamp, path.parent_path() / std::string(row.Text(1)), row.line()});
    return absl::OkStatus();
  };
  if (auto status = VisitWords(path, kImageList, left_out, visit); !status.ok()) return status;
  if (images.empty()) {
    return absl::InvalidArgumentError(absl::StrCat(path.string(), ": lists no image"));
  }
  SortEntries(path, images, left_out);
  return images;
}

absl::StatusOr<TumImages> ReadTumMasks(const Path& list, LeftOut& left_out) {
  absl::StatusOr<TumImages> masks = ReadTumImages(list, left_out);
  if (!masks.ok()) return masks.status();
  TumImages present;
  std::error_code error;
  for (const TumImage& mask : *masks) {
    if (std::filesystem::is_regular_file(mask.path, error)) {
      present.push_back(mask);
    } else {
      left_out.AddRow(absl::StrCat(list.string(), ", line ", mask.line, ": ", mask.path.string(),
                                   ": no such file"));
    }
  }
  if (present.empty()) {
    return absl::NotFoundError(absl::StrCat(list.string(), ": none of its ", masks->size(),
                                            " images is there; the first is ",
                                            masks->front().path.string()));
  }
  return present;
}

absl::StatusOr<TumTrack> ReadTumTrack(const Path& path, LeftOut& left_out) {
  TumTrack track;
  const auto visit = [&](Row& row) {
    if (row.size() != 8) return row.WrongCount("timestamp tx ty tz qx qy qz qw");
    const TumPose pose{row.Stamp(0), row.PoseFrom(1), row.line()};
    if (row.status().ok()) track.push_back(pose);
    return row.status();
  };
  if (auto status = VisitWords(path, kPoseList, left_out, visit); !status.ok()) return status;
  if (track.empty()) {
    return absl::InvalidArgumentError(absl::StrCat(path.string(), ": holds no pose"));
  }
  SortByStamp(path, track, left_out);
  return track;
}

absl::StatusOr<std::map<ObjectId, TumTrack>> ReadTumObjects(const Path& path, LeftOut& left_out) {
  std::map<ObjectId, TumTrack> tracks;
  const auto visit = [&](Row& row) {
    if (row.size() != 9) return row.WrongCount("timestamp id tx ty tz qx qy qz qw");
    const TumPose pose{row.Stamp(0), row.PoseFrom(2), row.line()};
    const auto id = static_cast<ObjectId>(row.Integer(1, 1, kMostId));
    if (row.status().ok()) tracks[id].push_back(pose);
    return row.status();
  };
  if (auto status = VisitWords(path, kPoseList, left_out, visit); !status.ok()) return status;
  for (auto& [id, track] : tracks) SortByStamp(path, track, left_out);
  return tracks;
}

absl::StatusOr<DepthImage> ReadTumCamera(const Path& folder) {
  std::error_code error;
  if (std::filesystem::exists(folder / "camera.txt", error)) {
    return ReadCamera(folder / "camera.txt");
  }
  for (const auto& [name, fx, fy, cx, cy] : kPublished) {
    if (folder.filename().string().find(name) != std::string::npos) {
      DepthImage camera = CameraOf(fx, fy, cx, cy, kDepthFactor);
      camera.width = kPublishedWidth;
      camera.height = kPublishedHeight;
      return camera;
    }
  }
  return absl::NotFoundError(absl::StrCat(
      folder.string(),
      ": which camera this is of the folder's name does not tell (freiburg1, freiburg2 or "
      "freiburg3 "
      "in it would); write its intrinsics, 'fx fy cx cy' in pixels and, unless it is 5000, the "
      "depth's counts per metre, to camera.txt there"));
}

const TumImage* ImageAt(const TumImages& images, Time t) { return Nearest(Around(images, t), t); }

std::optional<Pose> PoseAt(const TumTrack& track, Time t) {
  const auto around = Around(track, t);
  const TumPose* const nearest = Nearest(around, t);
  if (nearest == nullptr) return std::nullopt;
  const auto [before, after] = around;
  if (nearest->stamp == t || before == nullptr || after == nullptr) return nearest->T_W_X;
  const Duration gap = after->stamp - before->stamp;
  if (gap > kLongestGap) return nearest->T_W_X;
  return Interpolate(before->T_W_X, after->T_W_X, ToSeconds(t - before->stamp) / ToSeconds(gap));
}

}  // namespace clearway
