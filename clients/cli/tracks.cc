#include "cli/tracks.h"

#include <algorithm>
#include <cstdlib>

#include "absl/strings/str_cat.h"

namespace clearway::cli {
namespace {

// On from a sighting with its velocity.
Sighting GoneOn(const Sighting& seen, double t_s) {
  Sighting gone = seen;
  gone.t_s = t_s;
  gone.T_W_O.translation += (t_s - seen.t_s) * seen.v_W_mps;
  return gone;
}

Eigen::Vector3d Velocity(const Sighting& from, const Sighting& to) {
  if (to.t_s <= from.t_s) return Eigen::Vector3d::Zero();
  return (to.T_W_O.translation - from.T_W_O.translation) / (to.t_s - from.t_s);
}

}  // namespace

absl::StatusOr<std::filesystem::path> RecordedFile(const JsonFields& fields) {
  const auto name = fields.Text("file");
  if (!name.ok()) return name.status();
  const char* const folder = std::getenv("CLEARWAY_DATA");
  const std::filesystem::path file = std::filesystem::path(folder == nullptr ? "" : folder) / *name;
  std::error_code error;
  if (folder != nullptr && std::filesystem::exists(file, error)) return file;
  return absl::NotFoundError(absl::StrCat(fields.PathOf("file"), ": no ", *name,
                                          " in the folder that CLEARWAY_DATA names (",
                                          folder == nullptr ? "it is not set" : folder, ")"));
}

absl::StatusOr<std::optional<WorldOrigin>> RecordedOrigin(const JsonFields& fields) {
  constexpr char kField[] = "origin_m";
  if (!fields.Has(kField)) return std::nullopt;
  if (const auto text = fields.Text(kField); text.ok()) {
    if (*text == "first") return WorldOrigin{.at_first_pose = true};
    return fields.Error(kField, "expected \"first\" or [x, y, z]");
  }
  const auto position_m = fields.Vector(kField);
  if (!position_m.ok()) return position_m.status();
  if (position_m->cwiseAbs().maxCoeff() > kMaxFileCoordinate_m) {
    return fields.Error(kField,
                        absl::StrCat("is ", OriginText(*position_m), "; it must lie within ",
                                     kMaxFileCoordinate_m, " m along each axis"));
  }
  return WorldOrigin{.position_m = *position_m};
}

void GuessVelocities(double over_s, Track& track) {
  const Sighting first = track.seen.front(), last = track.seen.back();
  constexpr double kRounding_s = 1e-6;
  const auto later = std::ranges::find_if(track.seen, [&](const Sighting& seen) {
    return seen.t_s > first.t_s + over_s - kRounding_s;
  });
  const auto earlier = std::find_if(track.seen.rbegin(), track.seen.rend(), [&](const auto& seen) {
    return seen.t_s < last.t_s - over_s + kRounding_s;
  });
  track.seen.front().v_W_mps = Velocity(first, later == track.seen.end() ? last : *later);
  track.seen.back().v_W_mps = Velocity(earlier == track.seen.rend() ? first : *earlier, last);
}

std::optional<GivenObject> ObjectIn(const TrackWindow& window, const Track& track) {
  GivenObject object;
  object.shape = track.shape;
  object.pose = {Time(), track.seen.front().T_W_O};
  if (!track.moves) return object;
  const double end_s = window.from_s + window.for_s;
  const Sighting &first = track.seen.front(), &last = track.seen.back();
  if (last.t_s <= window.from_s || first.t_s >= end_s) return std::nullopt;
  std::vector<Sighting> way;
  if (first.t_s > window.from_s) way.push_back(GoneOn(first, window.from_s));
  way.insert(way.end(), track.seen.begin(), track.seen.end());
  if (last.t_s < end_s) way.push_back(GoneOn(last, end_s));
  // The first sighting is at the window's begin or before it.
  for (const Sighting& seen : way) {
    const StampedPose pose{Time() + FromSeconds(seen.t_s - window.from_s), seen.T_W_O};
    if (pose.stamp <= Time()) {
      object.pose = pose;
    } else {
      object.future.push_back(pose);
    }
  }
  return object;
}

}  // namespace clearway::cli
