// What pictures are drawn on.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "absl/status/status.h"
#include "report/color.h"

struct _cairo;

namespace clearway::report {

enum class Align { kLeft, kCenter, kRight };

// How text is set. A plain value.
struct TextStyle {
  double size_px = 18;
  Color color = palette::kInk;
  Align align = Align::kLeft;
  bool bold = false;
  double halo_px = 0;  // white outline, for text on a map
};

// How a line is drawn. A plain value.
struct Stroke {
  Color color = palette::kInk;
  double width_px = 1;
  double dash_px = 0;  // 0: solid
};

// An image of pixels, x to the right and y down; antialiased. Used by one thread. Drawing on it
// cannot fail; WritePng tells of anything that went wrong.
class Canvas {
 public:
  Canvas(int width_px, int height_px);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  void Line(std::span<const Eigen::Vector2d> points, const Stroke& stroke);
  void Fill(std::span<const Eigen::Vector2d> polygon, const Color& color);
  void Outline(std::span<const Eigen::Vector2d> polygon, const Stroke& stroke);
  void FillRect(double x, double y, double width, double height, const Color& color);
  void Circle(const Eigen::Vector2d& center, double radius_px, const Color& fill,
              const Stroke& stroke);
  // The text's baseline is at `position`.
  void Text(const Eigen::Vector2d& position, const std::string& text, const TextStyle& style);
  double TextWidth(const std::string& text, const TextStyle& style);

  // Pixels 0xAARRGGBB, row-major from the top, each drawn as a square of `scale_px`.
  void Image(const Eigen::Vector2d& top_left, double scale_px, int width, int height,
             std::span<const std::uint32_t> pixels);

  // Nothing is drawn outside the rectangle until ResetClip.
  void Clip(double x, double y, double width, double height);
  void ResetClip();

  absl::Status WritePng(const std::string& file) const;

 private:
  void Path(std::span<const Eigen::Vector2d> points);
  void Apply(const Stroke& stroke);

  std::unique_ptr<_cairo, void (*)(_cairo*)> cairo_;
};

}  // namespace clearway::report
