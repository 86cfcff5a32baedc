// Names beside what is drawn on a map.
#pragma once

#include <string>
#include <vector>

#include "report/map_view.h"

namespace clearway::report {

struct NamedOutline {
  Polygon pixels;
  std::string name;
};

// Draws the names of those that are in the view, clear of all of them, of each other and of the
// scale where there is room. A line leads from a name to what it names if it is not beside it.
void DrawNames(Canvas& canvas, const MapView& view, const std::vector<NamedOutline>& outlines);

}  // namespace clearway::report
