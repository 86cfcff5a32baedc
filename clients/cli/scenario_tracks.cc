#include "cli/scenario_tracks.h"

#include <algorithm>
#include <limits>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "clearway/base/number_text.h"
#include "cli/tracks.h"

namespace clearway::cli {
namespace {

constexpr double kLongest_s = 1e6;

// Subtracts the origin, unless the reader of the format did.
void Move(const std::optional<WorldOrigin>& origin, std::vector<Track>& tracks) {
  if (!origin || tracks.empty()) return;
  Eigen::Vector3d origin_m = origin->position_m;
  if (origin->at_first_pose) {
    origin_m = tracks.front().seen.front().T_W_O.translation;
    origin_m.z() = 0;  // recordings of a plane have no height of their own
  }
  for (Track& track : tracks) {
    for (Sighting& seen : track.seen) seen.T_W_O.translation -= origin_m;
  }
}

// A scene takes nothing that is farther away.
absl::Status CheckNear(const JsonFields& fields, const std::vector<Track>& tracks) {
  const auto limit_m = static_cast<int>(FrameLimits().max_coordinate_m);
  for (const Track& track : tracks) {
    for (const Sighting& seen : track.seen) {
      const Eigen::Vector3d& p_W = seen.T_W_O.translation;
      if (p_W.cwiseAbs().maxCoeff() <= limit_m) continue;
      return fields.Error(
          "file",
          absl::StrCat("has something at ", OriginText(p_W), ", beyond the limit of ", limit_m,
                       " m from the origin; \"origin_m\": \"first\" or [x, y, z] moves it"));
    }
  }
  return absl::OkStatus();
}

absl::StatusOr<TrackWindow> ParseWindow(const JsonFields& fields) {
  const auto from_s = fields.NumberOr("from_s", 0);
  if (!from_s.ok()) return from_s.status();
  if (*from_s < 0) {
    return fields.Error("from_s",
                        absl::StrCat("is ", NumberText(*from_s), ", must not be below 0"));
  }
  const auto for_s = fields.Positive("for_s");
  if (!for_s.ok()) return for_s.status();
  if (*from_s + *for_s > kLongest_s) {
    return fields.Error("for_s", absl::StrCat("is ", NumberText(*for_s),
                                              " s; from_s and for_s together must be at most ",
                                              NumberText(kLongest_s), " s"));
  }
  return TrackWindow{*from_s, *for_s};
}

absl::StatusOr<std::vector<Track>> ReadTracks(const JsonFields& fields, const Json& value,
                                              const std::string& path) {
  const auto format = fields.Text("format");
  if (!format.ok()) return format.status();
  if (*format == "ucy") return ReadUcyTracks(value, path);
  if (*format == "commonroad") return ReadCommonRoadTracks(value, path);
  if (*format == "boxes") return ReadBoxTracks(value, path);
  return fields.Error("format", "expected ucy, commonroad or boxes");
}

// From when to when anything that moves is seen; none if nothing moves.
struct Range {
  double from_s = std::numeric_limits<double>::infinity();
  double until_s = -std::numeric_limits<double>::infinity();
};

Range RangeOf(const std::vector<Track>& tracks) {
  Range range;
  for (const Track& track : tracks) {
    if (!track.moves) continue;
    range.from_s = std::min(range.from_s, track.seen.front().t_s);
    range.until_s = std::max(range.until_s, track.seen.back().t_s);
  }
  return range;
}

}  // namespace

absl::StatusOr<TrackObjects> ParseTracks(const Json& value, const std::string& path,
                                         ObjectId first_id) {
  // What else there may be, each format knows.
  const auto fields = JsonFields::Of(value, path,
                                     {"format", "file", "from_s", "for_s", "radius_m", "height_m",
                                      "road_edges", "poses", "origin_m"});
  if (!fields.ok()) return fields.status();
  const auto window = ParseWindow(*fields);
  if (!window.ok()) return window.status();
  const auto origin = RecordedOrigin(*fields);
  if (!origin.ok()) return origin.status();
  auto tracks = ReadTracks(*fields, value, path);
  if (!tracks.ok()) return tracks.status();
  if (value.at("format") != "boxes") Move(*origin, *tracks);
  if (auto status = CheckNear(*fields, *tracks); !status.ok()) return status;
  const Range range = RangeOf(*tracks);
  const bool any_moves = range.from_s <= range.until_s;
  const std::string lasts = absl::StrFormat("from %.10g to %.10g s", range.from_s, range.until_s);
  if (any_moves && window->from_s >= range.until_s && window->from_s > 0) {
    return fields->Error(
        "from_s", absl::StrFormat("is %.10g; the recording lasts %s", window->from_s, lasts));
  }
  TrackObjects result;
  const double ends_s = window->from_s + window->for_s;
  if (any_moves && ends_s > range.until_s) {
    result.note = absl::StrFormat(
        "%s: the recording lasts %s, the scenario until %.10g s of it: after the end everything "
        "goes straight on",
        path, lasts, ends_s);
  }
  const auto file = fields->Text("file");
  if (!file.ok()) return file.status();
  for (const Track& track : *tracks) {
    if (std::abs(track.seen.front().t_s) > kLongest_s || track.seen.back().t_s > kLongest_s) {
      return fields->Error("file", absl::StrCat("its times are too long, beyond ",
                                                NumberText(kLongest_s), " s either way"));
    }
    auto object = ObjectIn(*window, track);
    if (!object) continue;
    object->id = first_id++;
    result.names[object->id] = absl::StrCat(track.name, " of ", *file);
    result.objects.push_back(*std::move(object));
  }
  return result;
}

}  // namespace clearway::cli
