#include "map/window_walk.h"

#include <algorithm>
#include <array>
#include <bit>

namespace clearway {
namespace {

// `value` or 0.
double If(bool condition, double value) {
  return std::bit_cast<double>(std::bit_cast<std::int64_t>(value) & -std::int64_t{condition});
}
std::int32_t If(bool condition, std::int32_t value) { return value & -std::int32_t{condition}; }

// One step; false at the ray's end.
bool Step(WindowRay& ray, std::uint32_t* words) {
  auto& [x, y, z] = ray.t_max;
  words[ray.index >> 5] |= std::uint32_t{1} << (ray.index & 31);
  const bool x_before_y = x < y;
  const bool not_z = (x_before_y ? x : y) < z;
  const bool along_x = x_before_y & not_z, along_y = !x_before_y & not_z, along_z = !not_z;
  x += If(along_x, ray.t_delta[0]);
  y += If(along_y, ray.t_delta[1]);
  z += If(along_z, ray.t_delta[2]);
  ray.index += If(along_x, ray.stride[0]) + If(along_y, ray.stride[1]) + If(along_z, ray.stride[2]);
  return (ray.index != ray.end) & (std::min({x, y, z}) <= ray.length_m);
}

}  // namespace

WindowRay InWindow(const RayStart& start, const BitWindow& window) {
  WindowRay ray;
  for (int axis = 0; axis < 3; ++axis) {
    ray.t_max[axis] = start.t_max[axis];
    ray.t_delta[axis] = start.t_delta[axis];
    ray.stride[axis] = start.step[axis] * window.strides()[axis];
  }
  ray.length_m = start.length_m;
  ray.index = window.IndexOf(start.key);
  ray.end = window.IndexOf(start.end);
  return ray;
}

void WalkWindowPortable(std::span<const WindowRay> rays, std::uint32_t* words) {
  constexpr std::size_t kUnderWay = 4;  // the steps of one hide the latency of the others'
  std::array<WindowRay, kUnderWay> under_way;
  std::size_t next = 0, count = 0;
  while (count < kUnderWay && next < rays.size()) under_way[count++] = rays[next++];
  while (count == kUnderWay) {
    for (WindowRay& ray : under_way) {
      if (Step(ray, words)) continue;
      if (next < rays.size()) {
        ray = rays[next++];
      } else {
        std::swap(ray, under_way[--count]);
        break;
      }
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    while (Step(under_way[i], words)) continue;
  }
}

WindowWalk FastestWindowWalk() { return HasAvx512() ? WalkWindowAvx512 : WalkWindowPortable; }

}  // namespace clearway
