// Colours and colour ramps.
#pragma once

#include <cstdint>
#include <span>

namespace clearway::report {

// sRGB and opacity, each 0 to 1.
struct Color {
  double r = 0, g = 0, b = 0, a = 1;

  static constexpr Color Hex(std::uint32_t rgb, double alpha = 1) {
    return {(rgb >> 16 & 255) / 255.0, (rgb >> 8 & 255) / 255.0, (rgb & 255) / 255.0, alpha};
  }
  constexpr Color WithAlpha(double alpha) const { return {r, g, b, alpha}; }
  // 0xAARRGGBB, opaque.
  std::uint32_t Rgb24() const;
};

// Between two colours: 0 gives `from`, 1 gives `to`.
Color Mix(const Color& from, const Color& to, double fraction);

// Piecewise linear through evenly spaced colours; `fraction` is clamped to [0, 1].
Color Ramp(std::span<const Color> stops, double fraction);

// The colour of a time, 0 (now) to 1 (the last time shown). The stops are those of matplotlib's
// `plasma` up to 0.85: beyond that it is too light for a white ground.
Color TimeColor(double fraction);

// The colour of an occupied voxel by its height over the ground.
Color HeightColor(double height_m, double max_height_m);

namespace palette {
inline constexpr Color kInk = Color::Hex(0x22262b);
inline constexpr Color kMuted = Color::Hex(0x6b7280);
inline constexpr Color kRule = Color::Hex(0xc8ccd2);
inline constexpr Color kPaper = Color::Hex(0xffffff);
inline constexpr Color kFree = Color::Hex(0xffffff);
inline constexpr Color kUnknown = Color::Hex(0xd9dce1);
inline constexpr Color kMoving = Color::Hex(0x0b7a75);
inline constexpr Color kResting = Color::Hex(0x8fc1bd);
inline constexpr Color kDynamic = Color::Hex(0xc2255c);
}  // namespace palette

}  // namespace clearway::report
