// What the demo replays: a simulated world or a recording, and the problems that it poses.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/io/frame_source.h"
#include "clearway/report/truth.h"
#include "demo/crossing.h"

namespace clearway::demo {

// A place where a crossing may be tried.
using Candidate = std::function<absl::StatusOr<Crossing>()>;

// A problem with its places to try, best first: where one is void the next is taken.
struct Problem {
  std::string name;
  ObjectId blocker = 0;
  std::vector<Candidate> candidates;
};

// After this frame the replay stops, and these problems are planned.
struct Stop {
  std::size_t frame = 0;
  std::vector<Problem> problems;
};

struct Sequence {
  std::string name;  // short, for titles
  FrameSource frames;
  Truth truth;
  std::map<ObjectId, std::string> object_names;
  std::vector<Stop> stops;  // ascending
};

// A scenario of the simulator, by its tasks. INVALID_ARGUMENT for one without tasks.
absl::StatusOr<Sequence> SimulatedSequence(const std::string& scenario);

// A LiDAR folder: after the frames, ascending, the recorded paths of the first two moving objects
// are crossed. Frames that it does not have are left out; INVALID_ARGUMENT if that leaves none.
// `motions_over` is LidarFolderOptions::motions_over.
absl::StatusOr<Sequence> RecordedSequence(const std::string& folder,
                                          const std::vector<std::size_t>& plan_after,
                                          Duration motions_over);

}  // namespace clearway::demo
