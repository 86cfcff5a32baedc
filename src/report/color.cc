#include "report/color.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace clearway::report {

std::uint32_t Color::Rgb24() const {
  const auto byte = [](double x) { return static_cast<std::uint32_t>(std::lround(x * 255)); };
  return 0xff000000u | byte(r) << 16 | byte(g) << 8 | byte(b);
}

Color Mix(const Color& from, const Color& to, double fraction) {
  const auto mix = [fraction](double x, double y) { return x + (y - x) * fraction; };
  return {mix(from.r, to.r), mix(from.g, to.g), mix(from.b, to.b), mix(from.a, to.a)};
}

Color Ramp(std::span<const Color> stops, double fraction) {
  const double at = std::clamp(fraction, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(at), stops.size() - 2);
  return Mix(stops[i], stops[i + 1], at - static_cast<double>(i));
}

Color TimeColor(double fraction) {
  static constexpr std::array kStops{
      Color::Hex(0x0d0887), Color::Hex(0x4c02a1), Color::Hex(0x7e03a8), Color::Hex(0xa92395),
      Color::Hex(0xcc4778), Color::Hex(0xe56b5d), Color::Hex(0xf89540), Color::Hex(0xfdb92f)};
  return Ramp(kStops, fraction);
}

Color HeightColor(double height_m, double max_height_m) {
  static constexpr Color kGround = Color::Hex(0xf3efe6);
  static constexpr std::array kStops{Color::Hex(0xcdbfa3), Color::Hex(0x9c8f7c),
                                     Color::Hex(0x6d6a66), Color::Hex(0x454a52),
                                     Color::Hex(0x2b3038)};
  constexpr double kStepM = 0.25;  // lower voxels are the ground's own roughness
  if (height_m < kStepM) return kGround;
  return Ramp(kStops, (height_m - kStepM) / std::max(max_height_m - kStepM, kStepM));
}

}  // namespace clearway::report
