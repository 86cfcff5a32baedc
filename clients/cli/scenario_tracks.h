// What was recorded as the objects of a scenario.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/io/left_out.h"
#include "clearway/scene/given_object.h"
#include "cli/json.h"

namespace clearway::cli {

struct TrackObjects {
  std::vector<GivenObject> objects;
  std::map<ObjectId, std::string> names;  // as in "person 12 of ucy/zara01_obsmat.txt"
  std::string note;                       // if the window ends after the recording
  LeftOut left_out;                       // of the recording
};

// {"format": ..., "file": ..., "from_s": ..., "for_s": ..., and the format's own}: those who are
// seen between from_s and from_s + for_s of the recording, with futures; Time() is from_s, and
// their ids begin at `first_id`. Before they are seen first and after they are seen last they go
// straight. INVALID_ARGUMENT with the recording's range if from_s is not before its end. The file
// is looked for in the folder that the environment's CLEARWAY_DATA names: NOT_FOUND, saying so, if
// it is not there.
absl::StatusOr<TrackObjects> ParseTracks(const Json& value, const std::string& path,
                                         ObjectId first_id);

}  // namespace clearway::cli
