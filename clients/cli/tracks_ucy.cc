#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

#include "absl/strings/str_cat.h"
#include "cli/tracks.h"

namespace clearway::cli {
namespace {

// Lines that are no eight numbers are refused.
absl::StatusOr<std::map<int, Track>> ReadLines(const std::filesystem::path& file,
                                               const Cylinder& shape) {
  constexpr double kFramesPerSecond = 25;
  std::ifstream stream(file);
  if (!stream) return absl::NotFoundError(absl::StrCat(file.string(), ": cannot be read"));
  std::map<int, Track> tracks;  // by id
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    std::istringstream fields(line);
    double frame = 0, id = 0, x = 0, z = 0, y = 0, vx = 0, vz = 0, vy = 0;
    if (!(fields >> frame >> id >> x >> z >> y >> vx >> vz >> vy)) {
      return absl::InvalidArgumentError(
          absl::StrCat(file.string(), ": line ", number, ": expected eight numbers"));
    }
    tracks[static_cast<int>(id)].seen.push_back({frame / kFramesPerSecond,
                                                 Pose::Translation(x, y, shape.length_m / 2),
                                                 Eigen::Vector3d(vx, vy, 0)});
  }
  return tracks;
}

}  // namespace

absl::StatusOr<std::vector<Track>> ReadUcyTracks(const Json& value, const std::string& path) {
  const auto fields = JsonFields::Of(
      value, path, {"format", "file", "from_s", "for_s", "radius_m", "height_m", "origin_m"});
  if (!fields.ok()) return fields.status();
  Cylinder shape;
  for (const auto& [name, number] :
       {std::pair{"radius_m", &shape.radius_m}, {"height_m", &shape.length_m}}) {
    const auto read = fields->Positive(name);
    if (!read.ok()) return read.status();
    *number = *read;
  }
  const auto file = RecordedFile(*fields);
  if (!file.ok()) return file.status();
  auto people = ReadLines(*file, shape);
  if (!people.ok()) return people.status();
  std::vector<Track> tracks;
  for (auto& [id, track] : *people) {
    std::ranges::sort(track.seen, {}, &Sighting::t_s);
    track.shape = shape;
    track.name = absl::StrCat("person ", id);
    tracks.push_back(std::move(track));
  }
  return tracks;
}

}  // namespace clearway::cli
