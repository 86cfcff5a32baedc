// What was recorded as the objects of a scenario.
#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/scene/given_object.h"
#include "cli/json.h"

namespace clearway::cli {

// {"format": ..., "file": ..., "from_s": ..., "for_s": ..., and the format's own}: those who are
// seen between from_s and from_s + for_s of the recording, with futures; Time() is from_s, and
// their ids begin at `first_id`. Before they are seen first and after they are seen last they go
// straight. The file is looked for in the folder that the environment's CLEARWAY_DATA names:
// NOT_FOUND, saying so, if it is not there.
absl::StatusOr<std::vector<GivenObject>> ParseTracks(const Json& value, const std::string& path,
                                                     ObjectId first_id);

}  // namespace clearway::cli
