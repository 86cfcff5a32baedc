// Scans of a wall and of what stands before it.
#pragma once

#include <optional>

#include "support/frames.h"

namespace clearway::testing_support {

inline constexpr double kWall_m = 10;

// A square across the x axis that hides the wall behind it.
struct Panel {
  double x_m, y_m;  // of its middle; at the sensor's height
  double half_m = 0.3;

  Eigen::Vector3d Middle() const { return {x_m + 0.05, y_m + 0.01, 0.01}; }
};

// What a sensor at the origin sees of a wall across the x axis and of what stands before it.
inline Frame ScanOfWall(double t, std::optional<Panel> panel = std::nullopt) {
  Frame frame = FrameAt(t);
  for (double y_m = -2; y_m <= 2; y_m += 0.07) {
    for (double z_m = -1; z_m <= 1; z_m += 0.07) {
      Eigen::Vector3d p(kWall_m + 0.05, y_m, z_m);
      if (panel) {
        const Eigen::Vector3d on_panel = (panel->x_m + 0.05) / p.x() * p;
        const double off_m = std::max(std::abs(on_panel.y() - panel->y_m), std::abs(on_panel.z()));
        if (off_m <= panel->half_m) p = on_panel;
      }
      AddPoint(frame, kStaticLabel, p);
    }
  }
  return frame;
}

}  // namespace clearway::testing_support
