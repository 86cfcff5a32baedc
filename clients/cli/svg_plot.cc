#include "cli/svg_plot.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_replace.h"

namespace clearway::cli {
namespace {

constexpr double kWidth = 560, kHeight = 300;  // of the whole
constexpr double kLeft = 64, kTop = 30, kPlotWidth = 360, kPlotHeight = 220;
constexpr std::array kColors = {"#1f77b4", "#d62728", "#2ca02c", "#9467bd", "#ff7f0e",
                                "#17becf", "#8c564b", "#e377c2", "#7f7f7f", "#bcbd22"};

// A round number of which a few make up `most`.
double TickStep(double most) {
  constexpr double kTicks = 5;
  const double wanted = most / kTicks;
  const double decade = std::pow(10, std::floor(std::log10(wanted)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (step * decade >= wanted) return step * decade;
  }
  return 10 * decade;
}

class Axes {
 public:
  explicit Axes(const Plot& plot) {
    double x = 0, y = plot.least_y;
    for (const PlotLine& line : plot.lines) {
      for (const Eigen::Vector2d& p : line.points) {
        x = std::max(x, p.x());
        y = std::max(y, p.y());
      }
    }
    most_x_ = x > 0 ? x : 1;
    step_y_ = TickStep(y > 0 ? y : 1);
    most_y_ = step_y_ * std::ceil((y > 0 ? y : 1) / step_y_);
  }

  double X(double x) const { return kLeft + kPlotWidth * x / most_x_; }
  double Y(double y) const { return kTop + kPlotHeight * (1 - y / most_y_); }

  // Lines across at round numbers, with these.
  std::string Ticks() const {
    std::string svg;
    for (int i = 0; i * step_y_ <= most_y_ * 1.001; ++i) {
      const double y = Y(i * step_y_);
      absl::StrAppendFormat(&svg, "<line x1='%.0f' x2='%.0f' y1='%.1f' y2='%.1f' stroke='#ddd'/>",
                            kLeft, kLeft + kPlotWidth, y, y);
      absl::StrAppendFormat(&svg, "<text x='%.0f' y='%.1f' text-anchor='end'>%g</text>", kLeft - 6,
                            y + 4, i * step_y_);
    }
    const double step_x = TickStep(most_x_);
    for (int i = 0; i * step_x <= most_x_ * 1.001; ++i) {
      absl::StrAppendFormat(&svg, "<text x='%.1f' y='%.0f' text-anchor='middle'>%g</text>",
                            X(i * step_x), kTop + kPlotHeight + 16, i * step_x);
    }
    return svg;
  }

 private:
  double most_x_, most_y_, step_y_;
};

std::string LineOf(const PlotLine& line, std::size_t index, const Axes& axes) {
  const char* color = kColors[index % kColors.size()];
  std::string svg = absl::StrCat("<polyline fill='none' stroke='", color, "' points='");
  for (const Eigen::Vector2d& p : line.points) {
    absl::StrAppendFormat(&svg, "%.1f,%.1f ", axes.X(p.x()), axes.Y(p.y()));
  }
  const double y = kTop + 12 + 16 * static_cast<double>(index);
  absl::StrAppendFormat(&svg, "'/><text x='%.0f' y='%.0f' fill='%s'>%s</text>",
                        kLeft + kPlotWidth + 10, y, color, Escaped(line.name));
  return svg;
}

}  // namespace

std::string SvgOf(const Plot& plot) {
  const Axes axes(plot);
  const double height = std::max(kHeight, kTop + 24 + 16 * static_cast<double>(plot.lines.size()));
  std::string svg = absl::StrFormat(
      "<svg xmlns='http://www.w3.org/2000/svg' width='%.0f' height='%.0f' font-size='12' "
      "font-family='sans-serif'>",
      kWidth, height);
  absl::StrAppendFormat(&svg, "<text x='%.0f' y='18' font-size='14' font-weight='bold'>%s</text>",
                        kLeft, Escaped(plot.title));
  absl::StrAppend(&svg, axes.Ticks());
  absl::StrAppendFormat(&svg, "<text x='%.0f' y='%.0f' text-anchor='middle'>%s</text>",
                        kLeft + kPlotWidth / 2, kTop + kPlotHeight + 36, Escaped(plot.x_label));
  absl::StrAppendFormat(
      &svg, "<text transform='translate(14 %.0f) rotate(-90)' text-anchor='middle'>%s</text>",
      kTop + kPlotHeight / 2, Escaped(plot.y_label));
  for (std::size_t i = 0; i < plot.lines.size(); ++i) {
    absl::StrAppend(&svg, LineOf(plot.lines[i], i, axes));
  }
  return absl::StrCat(svg, "</svg>\n");
}

std::string Escaped(const std::string& text) {
  return absl::StrReplaceAll(
      text, {{"&", "&amp;"}, {"<", "&lt;"}, {">", "&gt;"}, {"'", "&#39;"}, {"\"", "&quot;"}});
}

}  // namespace clearway::cli
