// A path with its robot, coloured by time.
#pragma once

#include "clearway/report/top_view.h"
#include "report/map_view.h"

namespace clearway::report {

// The colours of the times from `start` on.
struct TimeScale {
  Time start;
  double last_s = 1;

  Color At(Time time) const { return TimeColor(ToSeconds(time - start) / last_s); }
};

// Draws the path: its line, footprints at steps, start and goal; or a dashed line for a reference.
void DrawPath(Canvas& canvas, const MapView& view, const TimeScale& times,
              const TopViewOptions& options, const TopViewPath& path);

}  // namespace clearway::report
