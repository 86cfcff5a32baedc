// The column of explanations beside a picture.
#pragma once

#include <Eigen/Core>
#include <string>

#include "report/canvas.h"

namespace clearway::report {

// Writes entries from top to bottom. Used by one thread.
class Legend {
 public:
  Legend(Canvas& canvas, const Eigen::Vector2d& top_left, double width_px)
      : canvas_(canvas), at_(top_left), width_px_(width_px) {}

  void Heading(const std::string& text);
  void Swatch(const Color& fill, const Stroke& outline, const std::string& text);
  void LineSample(const Stroke& stroke, const std::string& text);
  // A bar of the time colours from 0 to `last_s`, and of the heights up to `max_m`.
  void TimeBar(double last_s);
  void HeightBar(double max_m);

 private:
  template <class ColorOf>
  void Bar(double last, const std::string& unit, ColorOf&& color_of);

  Canvas& canvas_;
  Eigen::Vector2d at_;
  double width_px_;
};

}  // namespace clearway::report
