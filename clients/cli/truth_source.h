// Frames together with what really happened.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "clearway/report/truth.h"
#include "clearway/sim/simulation.h"
#include "cli/open_source.h"

namespace clearway::cli {

struct TrueSource {
  FrameSource frames;
  Truth truth;
  std::map<ObjectId, std::string> names;        // what kinds of objects they are
  std::map<ObjectId, Eigen::Vector3d> sizes_m;  // of recorded boxes
  std::optional<Simulation> simulation;         // that the frames are of, if they are of one
};

// A folder as OpenFolder takes it, whose recorded boxes are the truth, a recording whose frames
// give poses of objects, or "sim:<scenario>". INVALID_ARGUMENT for what tells no truth; else errors
// as the readers'.
absl::StatusOr<TrueSource> OpenTrueSource(const std::string& spec, const SourceFlags& flags);

}  // namespace clearway::cli
