#include "cli/scenario_tracks.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "absl/strings/str_cat.h"
#include "cli/json_fields.h"

namespace clearway::cli {
namespace {

struct Sighting {
  double t_s;
  Eigen::Vector2d p_m, v_mps;
};
using Tracks = std::map<int, std::vector<Sighting>>;  // by id

struct Window {
  double from_s, for_s;
};

// Lines that are no eight numbers are refused.
absl::StatusOr<Tracks> ReadUcy(const std::filesystem::path& file) {
  constexpr double kFramesPerSecond = 25;
  std::ifstream stream(file);
  if (!stream) return absl::NotFoundError(absl::StrCat(file.string(), ": cannot be read"));
  Tracks tracks;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    std::istringstream fields(line);
    double frame = 0, id = 0, x = 0, z = 0, y = 0, vx = 0, vz = 0, vy = 0;
    if (!(fields >> frame >> id >> x >> z >> y >> vx >> vz >> vy)) {
      return absl::InvalidArgumentError(
          absl::StrCat(file.string(), ": line ", number, ": expected eight numbers"));
    }
    tracks[static_cast<int>(id)].push_back({frame / kFramesPerSecond, {x, y}, {vx, vy}});
  }
  for (auto& [id, track] : tracks) std::ranges::sort(track, {}, &Sighting::t_s);
  return tracks;
}

// On from a sighting with its velocity.
Sighting GoneOn(const Sighting& seen, double t_s) {
  return {t_s, seen.p_m + (t_s - seen.t_s) * seen.v_mps, seen.v_mps};
}

GivenObject PersonOf(const std::vector<Sighting>& track, const Window& window,
                     const Cylinder& shape) {
  const auto pose_of = [&](const Sighting& seen) {
    return StampedPose{Time() + FromSeconds(seen.t_s - window.from_s),
                       Pose::Translation(seen.p_m.x(), seen.p_m.y(), shape.length_m / 2)};
  };
  const double end_s = window.from_s + window.for_s;
  std::vector<Sighting> way;
  if (track.front().t_s > window.from_s) way.push_back(GoneOn(track.front(), window.from_s));
  way.insert(way.end(), track.begin(), track.end());
  if (track.back().t_s < end_s) way.push_back(GoneOn(track.back(), end_s));
  GivenObject person;
  person.shape = shape;
  // The first sighting is at the window's begin or before it.
  for (const Sighting& seen : way) {
    const StampedPose pose = pose_of(seen);
    if (pose.stamp <= Time()) {
      person.pose = pose;
    } else {
      person.future.push_back(pose);
    }
  }
  return person;
}

absl::StatusOr<std::filesystem::path> PathIn(const JsonFields& fields) {
  const auto name = fields.Text("file");
  if (!name.ok()) return name.status();
  const char* const folder = std::getenv("CLEARWAY_DATA");
  const std::filesystem::path file = std::filesystem::path(folder == nullptr ? "" : folder) / *name;
  if (folder != nullptr && std::filesystem::exists(file)) return file;
  return absl::NotFoundError(absl::StrCat(fields.PathOf("file"), ": no ", *name,
                                          " in the folder that CLEARWAY_DATA names (",
                                          folder == nullptr ? "it is not set" : folder, ")"));
}

}  // namespace

absl::StatusOr<std::vector<GivenObject>> ParseTracks(const Json& value, const std::string& path,
                                                     ObjectId first_id) {
  const auto fields =
      JsonFields::Of(value, path, {"format", "file", "from_s", "for_s", "radius_m", "height_m"});
  if (!fields.ok()) return fields.status();
  const auto format = fields->Text("format");
  if (!format.ok()) return format.status();
  if (*format != "ucy") return fields->Error("format", "expected ucy");
  Window window{};
  Cylinder shape;
  for (const auto& [name, number] : {std::pair{"from_s", &window.from_s},
                                     {"for_s", &window.for_s},
                                     {"radius_m", &shape.radius_m},
                                     {"height_m", &shape.length_m}}) {
    const auto read = fields->Positive(name);
    if (!read.ok()) return read.status();
    *number = *read;
  }
  const auto file = PathIn(*fields);
  if (!file.ok()) return file.status();
  const auto tracks = ReadUcy(*file);
  if (!tracks.ok()) return tracks.status();
  std::vector<GivenObject> people;
  for (const auto& [id, track] : *tracks) {
    const bool meanwhile =
        track.back().t_s > window.from_s && track.front().t_s < window.from_s + window.for_s;
    if (!meanwhile) continue;
    people.push_back(PersonOf(track, window, shape));
    people.back().id = first_id++;
  }
  return people;
}

}  // namespace clearway::cli
