#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "clearway/base/number_text.h"
#include "cli/json_file.h"
#include "cli/tracks.h"
#include "cli/values.h"

namespace clearway::cli {
namespace {

// Eight finite numbers between blanks.
absl::StatusOr<std::array<double, 8>> NumbersOf(const std::string& where, std::string_view line) {
  std::array<double, 8> numbers;
  const std::vector<std::string> words = absl::StrSplit(
      absl::string_view(line.data(), line.size()), absl::ByAnyChar(" \t\r"), absl::SkipEmpty());
  if (words.size() != numbers.size()) {
    return absl::InvalidArgumentError(
        absl::StrCat(where, ": ", words.size(), " words, expected eight numbers"));
  }
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto number = ParseFinite(words[i]);
    if (!number.ok()) {
      return absl::InvalidArgumentError(
          absl::StrCat(where, ", word ", i + 1, ": ", number.status().message()));
    }
    numbers[i] = *number;
  }
  return numbers;
}

// A scenario is refused if a line is bad: nobody would see that a track of it is incomplete.
absl::StatusOr<std::map<int, Track>> ReadLines(const std::filesystem::path& file,
                                               const Cylinder& shape) {
  constexpr double kFramesPerSecond = 25, kMaxId = 1e9;
  const auto text = ReadTextFile(file, "table of tracks");
  if (!text.ok()) return text.status();
  std::map<int, Track> tracks;  // by id
  int line_number = 0;
  for (const absl::string_view line : absl::StrSplit(*text, '\n')) {
    ++line_number;
    if (absl::StripAsciiWhitespace(line).empty()) continue;
    const std::string where = absl::StrCat(file.string(), ": line ", line_number);
    const auto numbers = NumbersOf(where, {line.data(), line.size()});
    if (!numbers.ok()) return numbers.status();
    const auto& [frame, id, x, z, y, vx, vz, vy] = *numbers;
    if (!(std::abs(id) <= kMaxId) || id != std::floor(id)) {
      return absl::InvalidArgumentError(
          absl::StrCat(where, ", word 2: expected a track's number, not ", NumberText(id)));
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
