// Recordings of where things were, one reader for each format of a scenario's "tracks".
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/io/left_out.h"
#include "clearway/io/world_origin.h"
#include "clearway/scene/given_object.h"
#include "cli/json.h"
#include "cli/json_fields.h"

namespace clearway::cli {

// What was seen of one thing, in seconds of the recording.
struct Sighting {
  double t_s = 0;
  Pose T_W_O;
  Eigen::Vector3d v_W_mps = Eigen::Vector3d::Zero();
  int line = 0;  // of the recording's table; 0 if it is no row of one
};

// One thing, of one size. A plain value.
struct Track {
  Shape shape;
  std::vector<Sighting> seen;  // ascending times, at least one
  bool moves = true;           // else it is where it was seen first, always
  std::string name = {};       // kind and id in the recording, as in "person 12"
};

struct Tracks {
  std::vector<Track> tracks;
  LeftOut left_out;  // of the recording
};

// From when and for how long a recording counts.
struct TrackWindow {
  double from_s = 0, for_s = 0;
};

// Each reads what the fields of a scenario's "tracks" name; a field that is not of the format is an
// error. The formats are in docs/formats.md.
absl::StatusOr<Tracks> ReadUcyTracks(const Json& value, const std::string& path);
absl::StatusOr<Tracks> ReadBoxTracks(const Json& value, const std::string& path);
absl::StatusOr<Tracks> ReadCommonRoadTracks(const Json& value, const std::string& path);

// The field "file", in the folder that the environment's CLEARWAY_DATA names: NOT_FOUND, saying so,
// if it is not there.
absl::StatusOr<std::filesystem::path> RecordedFile(const JsonFields& fields);

// The field "origin_m": "first" or [x, y, z], to be subtracted from the recording's coordinates. Of
// UCY and CommonRoad, `at_first_pose` is where the first thing is first seen, on the ground.
absl::StatusOr<std::optional<WorldOrigin>> RecordedOrigin(const JsonFields& fields);

// The velocities with which it goes on before the first sighting and after the last, from how far
// it went in the `over_s` next to them; none if it was seen once.
void GuessVelocities(double over_s, Track& track);

// The thing within the window, the begin of which is Time(); none if it is not seen meanwhile.
// Before it is seen first and after it is seen last it goes straight and does not turn.
std::optional<GivenObject> ObjectIn(const TrackWindow& window, const Track& track);

}  // namespace clearway::cli
