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

bool IsFar(const Sighting& seen) {
  return seen.T_W_O.translation.cwiseAbs().maxCoeff() > FrameLimits().max_coordinate_m;
}

std::string FarText(const Sighting& seen) {
  return absl::StrCat("at ", OriginText(seen.T_W_O.translation), ", beyond the limit of ",
                      static_cast<int>(FrameLimits().max_coordinate_m), " m from the origin");
}

// A scene takes nothing that is farther away. Such rows of a table are left out, unless most are.
absl::Status LeaveOutFar(const JsonFields& fields, const std::string& file, Tracks& recorded) {
  std::size_t rows = 0, far_rows = 0;
  const Sighting* first_far = nullptr;
  for (const Track& track : recorded.tracks) {
    for (const Sighting& seen : track.seen) {
      rows += seen.line > 0;
      if (!IsFar(seen)) continue;
      const bool is_first = first_far == nullptr || (first_far->line > 0 && seen.line == 0);
      if (is_first) first_far = &seen;
      far_rows += seen.line > 0;
    }
  }
  if (first_far == nullptr) return absl::OkStatus();
  if (first_far->line == 0 || 2 * far_rows > rows) {
    return fields.Error("file", absl::StrCat("has something ", FarText(*first_far),
                                             "; \"origin_m\": \"first\" or [x, y, z] moves it"));
  }
  for (Track& track : recorded.tracks) {
    std::erase_if(track.seen, [&](const Sighting& seen) {
      if (!IsFar(seen)) return false;
      recorded.left_out.AddRow(
          absl::StrCat(file, ", line ", seen.line, ": ", track.name, " is ", FarText(seen)));
      return true;
    });
  }
  std::erase_if(recorded.tracks, [](const Track& track) { return track.seen.empty(); });
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

absl::StatusOr<Tracks> ReadTracks(const JsonFields& fields, const Json& value,
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
  const auto file = fields->Text("file");
  if (!file.ok()) return file.status();
  auto recorded = ReadTracks(*fields, value, path);
  if (!recorded.ok()) return recorded.status();
  if (value.at("format") != "boxes") Move(*origin, recorded->tracks);
  if (auto status = LeaveOutFar(*fields, *file, *recorded); !status.ok()) return status;
  if (recorded->tracks.empty()) {
    return fields->Error("file", absl::StrCat(*file, " holds nothing that could be in the way"));
  }
  const Range range = RangeOf(recorded->tracks);
  const bool any_moves = range.from_s <= range.until_s;
  const std::string lasts = absl::StrFormat("from %.10g to %.10g s", range.from_s, range.until_s);
  if (any_moves && window->from_s >= range.until_s && window->from_s > 0) {
    return fields->Error(
        "from_s", absl::StrFormat("is %.10g; the recording lasts %s", window->from_s, lasts));
  }
  TrackObjects result;
  result.left_out = std::move(recorded->left_out);
  const double ends_s = window->from_s + window->for_s;
  if (any_moves && ends_s > range.until_s) {
    result.note = absl::StrFormat(
        "%s: the recording lasts %s, the scenario until %.10g s of it: after the end everything "
        "goes straight on",
        path, lasts, ends_s);
  }
  if (!any_moves) result.note = absl::StrCat(path, ": nothing moves in ", *file);
  for (const Track& track : recorded->tracks) {
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
