// What the server's reports say of points, summed up over a stream of frames.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "clearway/scene/scene_builder.h"
#include "cli/json.h"

namespace clearway::cli {

// A plain value.
class PointNotes {
 public:
  void Add(const FrameReport& report);

  // "left out 12 points: 10 labelled -1, 2 out of the scene's bounds", and whether that is all of
  // them; none if nothing was.
  std::vector<std::string> Lines() const;
  Json AsJson() const;

 private:
  std::size_t used_ = 0, ignored_ = 0, not_finite_ = 0, self_ = 0, out_of_bounds_ = 0, given_ = 0;
};

}  // namespace clearway::cli
