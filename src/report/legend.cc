#include "report/legend.h"

#include <array>
#include <cmath>

#include "absl/strings/str_cat.h"

namespace clearway::report {
namespace {

constexpr double kRowPx = 32;
constexpr double kSamplePx = 36;
constexpr double kTextPx = 17;

// The least of 0.5, 1, 2, 5, ... that cuts `last` into at most six steps.
double TickStep(double last) {
  for (double power = 0.1;; power *= 10) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      if (last / (factor * power) <= 6) return factor * power;
    }
  }
}

}  // namespace

void Legend::Heading(const std::string& text) {
  at_.y() += 18;
  canvas_.Text(at_ + Eigen::Vector2d(0, 6), text, {.size_px = kTextPx, .bold = true});
  at_.y() += 26;
}

void Legend::Swatch(const Color& fill, const Stroke& outline, const std::string& text) {
  const double x = at_.x() + 1, y = at_.y() - 9, height = 19;
  const std::array<Eigen::Vector2d, 4> box{
      {{x, y}, {x + kSamplePx, y}, {x + kSamplePx, y + height}, {x, y + height}}};
  canvas_.Fill(box, fill);
  canvas_.Outline(box, outline);
  canvas_.Text(at_ + Eigen::Vector2d(kSamplePx + 14, 6), text, {.size_px = kTextPx});
  at_.y() += kRowPx;
}

void Legend::LineSample(const Stroke& stroke, const std::string& text) {
  canvas_.Line(std::array<Eigen::Vector2d, 2>{at_ + Eigen::Vector2d(2, 0),
                                              at_ + Eigen::Vector2d(kSamplePx, 0)},
               stroke);
  canvas_.Text(at_ + Eigen::Vector2d(kSamplePx + 14, 6), text, {.size_px = kTextPx});
  at_.y() += kRowPx;
}

template <class ColorOf>
void Legend::Bar(double last, const std::string& unit, ColorOf&& color_of) {
  constexpr double kHeight = 18, kStep = 2;
  const double y = at_.y() - 8;
  for (double x = 0; x < width_px_; x += kStep) {
    canvas_.FillRect(at_.x() + x, y, std::min(kStep + 0.5, width_px_ - x), kHeight,
                     color_of(x / width_px_));
  }
  const double step = TickStep(last);
  for (int i = 0; i * step <= last * (1 + 1e-9); ++i) {
    const double x = at_.x() + i * step / last * width_px_;
    canvas_.Line(std::array<Eigen::Vector2d, 2>{{{x, y + kHeight}, {x, y + kHeight + 5}}},
                 {palette::kMuted, 1.5});
    canvas_.Text({x, y + kHeight + 22}, absl::StrCat(std::round(i * step * 10) / 10),
                 {.size_px = 15, .color = palette::kMuted, .align = Align::kCenter});
  }
  canvas_.Text({at_.x() + width_px_, y - 8}, unit,
               {.size_px = 15, .color = palette::kMuted, .align = Align::kRight});
  at_.y() += kHeight + 34;
}

void Legend::TimeBar(double last_s) {
  Bar(last_s, "s", [](double fraction) { return TimeColor(fraction); });
}

void Legend::HeightBar(double max_m) {
  Bar(max_m, "m", [max_m](double fraction) { return HeightColor(fraction * max_m, max_m); });
}

}  // namespace clearway::report
