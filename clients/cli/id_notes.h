// Whether the labels of points and the ids of motions and poses are of the same objects.
#pragma once

#include <set>
#include <string>

#include "clearway/scene/frame.h"
#include "cli/json.h"

namespace clearway::cli {

// A plain value.
class IdNotes {
 public:
  void Add(const Frame& frame);

  // That no object with motions or poses has a point in any frame, as where labels and boxes number
  // objects differently; empty if one has.
  std::string Line() const;
  // The objects with motions or poses of which no frame has a point.
  Json WithoutPoints() const;

 private:
  std::set<ObjectId> labels_, placed_;
};

}  // namespace clearway::cli
