// People of UCY and ETH recordings.
#include <algorithm>
#include <map>

#include "absl/strings/str_cat.h"
#include "clearway/io/ucy_people.h"
#include "cli/tracks.h"

namespace clearway::cli {
namespace {

std::map<int, Track> TracksById(const std::vector<UcyPerson>& people, const Cylinder& shape) {
  constexpr double kFramesPerSecond = 25;
  std::map<int, Track> tracks;
  for (const UcyPerson& person : people) {
    const Eigen::Vector2d &p_m = person.p_W_m, &v_mps = person.v_W_mps;
    tracks[person.id].seen.push_back({person.frame / kFramesPerSecond,
                                      Pose::Translation(p_m.x(), p_m.y(), shape.length_m / 2),
                                      {v_mps.x(), v_mps.y(), 0},
                                      person.line});
  }
  return tracks;
}

}  // namespace

absl::StatusOr<Tracks> ReadUcyTracks(const Json& value, const std::string& path) {
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
  Tracks result;
  const auto people = ReadUcyPeople(*file, result.left_out);
  if (!people.ok()) return people.status();
  auto tracks = TracksById(*people, shape);
  for (auto& [id, track] : tracks) {
    std::ranges::sort(track.seen, {}, &Sighting::t_s);
    track.shape = shape;
    track.name = absl::StrCat("person ", id);
    result.tracks.push_back(std::move(track));
  }
  return result;
}

}  // namespace clearway::cli
