#include "map/window_walk.h"

#include <algorithm>
#include <array>
#include <bit>

#include "map/avx512.h"

namespace clearway {
namespace {

// `value` or 0.
double If(bool condition, double value) {
  return std::bit_cast<double>(std::bit_cast<std::int64_t>(value) & -std::int64_t{condition});
}
std::int32_t If(bool condition, std::int32_t value) { return value & -std::int32_t{condition}; }

// One of the rays.
struct LaneRay {
  double t_max[3], t_delta[3], length_m;
  std::int32_t stride[3], index, end;
};

LaneRay RayOf(const WindowRays& rays, int lane) {
  LaneRay ray;
  for (int axis = 0; axis < 3; ++axis) {
    ray.t_max[axis] = rays.t_max[axis][lane];
    ray.t_delta[axis] = rays.t_delta[axis][lane];
    ray.stride[axis] = rays.stride[axis][lane];
  }
  ray.length_m = rays.length_m[lane];
  ray.index = rays.index[lane];
  ray.end = rays.end[lane];
  return ray;
}

// The rays that go somewhere, one after the other.
class Queue {
 public:
  explicit Queue(std::span<const WindowRays> rays) : rays_(rays) {}

  // False after the last one.
  bool Next(LaneRay& ray) {
    for (; next_ < rays_.size() * kLanes; ++next_) {
      const WindowRays& rays = rays_[next_ / kLanes];
      const auto lane = static_cast<int>(next_ % kLanes);
      if (rays.index[lane] == rays.end[lane]) continue;
      ray = RayOf(rays, lane);
      ++next_;
      return true;
    }
    return false;
  }

 private:
  std::span<const WindowRays> rays_;
  std::size_t next_ = 0;
};

// One step; false at the ray's end.
bool Step(LaneRay& ray, std::uint32_t* words) {
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

void WalkWindowPortable(std::span<const WindowRays> rays, std::uint32_t* words) {
  constexpr std::size_t kUnderWay = 4;  // the steps of one hide the latency of the others'
  Queue queue(rays);
  std::array<LaneRay, kUnderWay> under_way;
  std::size_t count = 0;
  while (count < kUnderWay && queue.Next(under_way[count])) ++count;
  while (count == kUnderWay) {
    for (LaneRay& ray : under_way) {
      if (Step(ray, words) || queue.Next(ray)) continue;
      std::swap(ray, under_way[--count]);
      break;
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    while (Step(under_way[i], words)) continue;
  }
}

WindowWalk FastestWindowWalk() { return HasAvx512() ? WalkWindowAvx512 : WalkWindowPortable; }
WindowWalk FastestShortWindowWalk() {
  return HasAvx512() ? WalkWindowAbreastAvx512 : WalkWindowPortable;
}

}  // namespace clearway
