// Plots as SVG, for pages that need nothing else.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace clearway::cli {

struct PlotLine {
  std::string name;
  std::vector<Eigen::Vector2d> points;  // by ascending x, finite
};

// Both axes begin at 0. A plain value.
struct Plot {
  std::string title, x_label, y_label;
  std::vector<PlotLine> lines;
  double least_y = 0;  // the axis reaches at least so far
};

// An <svg> element.
std::string SvgOf(const Plot& plot);

// With what means something else in HTML and XML replaced.
std::string Escaped(const std::string& text);

}  // namespace clearway::cli
