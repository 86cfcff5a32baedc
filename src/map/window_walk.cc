#include "map/window_walk.h"

#include <algorithm>
#include <bit>

namespace clearway {
namespace {

// `value` or 0.
double If(bool condition, double value) {
  return std::bit_cast<double>(std::bit_cast<std::int64_t>(value) & -std::int64_t{condition});
}
std::int32_t If(bool condition, std::int32_t value) { return value & -std::int32_t{condition}; }

void Walk(const WindowRay& ray, std::uint32_t* words) {
  double x = ray.t_max[0], y = ray.t_max[1], z = ray.t_max[2];
  std::int32_t index = ray.index;
  do {
    words[index >> 5] |= std::uint32_t{1} << (index & 31);
    const bool x_before_y = x < y;
    const bool not_z = (x_before_y ? x : y) < z;
    const bool along_x = x_before_y & not_z, along_y = !x_before_y & not_z, along_z = !not_z;
    x += If(along_x, ray.t_delta[0]);
    y += If(along_y, ray.t_delta[1]);
    z += If(along_z, ray.t_delta[2]);
    index += If(along_x, ray.stride[0]) + If(along_y, ray.stride[1]) + If(along_z, ray.stride[2]);
  } while (index != ray.end && std::min({x, y, z}) <= ray.length_m);
}

}  // namespace

void WalkWindowPortable(std::span<const WindowRay> rays, std::uint32_t* words) {
  for (const WindowRay& ray : rays) Walk(ray, words);
}

WindowWalk FastestWindowWalk() { return HasAvx512() ? WalkWindowAvx512 : WalkWindowPortable; }

}  // namespace clearway
