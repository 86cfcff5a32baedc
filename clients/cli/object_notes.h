// What frames and the server's reports say of objects, summed up over a stream.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "clearway/scene/scene_builder.h"
#include "cli/id_notes.h"
#include "cli/json.h"

namespace clearway::cli {

// A plain value.
class ObjectNotes {
 public:
  // A frame, sent or applied.
  void Add(const Frame& frame) { ids_.Add(frame); }
  // The report of the frame of that stamp.
  void Add(const FrameReport& report, Time stamp);

  // "object 5: model restarted at 1.6 s: ...", a line for each object and kind of issue; then how
  // many sightings came without a motion or pose, and whether ids are of other objects than labels.
  std::vector<std::string> Lines() const;
  Json AsJson() const;

 private:
  struct Seen {
    ObjectIssue first;
    Time stamp;
    std::size_t count = 0;
  };
  std::map<std::pair<ObjectId, ObjectIssueKind>, Seen> issues_;
  IdNotes ids_;
  std::size_t implausible_ = 0, conflicting_ = 0;
  std::size_t bridged_ = 0, estimated_ = 0, restarted_ = 0;
  std::size_t unlisted_ = 0;  // issues that the reports or this left out
};

}  // namespace clearway::cli
