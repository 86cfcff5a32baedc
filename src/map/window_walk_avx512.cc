#include "map/window_walk.h"

#ifdef __x86_64__
// GCC 12 takes the undefined registers of its own header for a fault, https://gcc.gnu.org/PR105593.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <immintrin.h>

#include <cstddef>

// On functions, not on the file: what the linker shares with other files must run everywhere.
#define CLEARWAY_AVX512 __attribute__((target("avx512f,avx512vl")))

namespace clearway {
namespace {

constexpr int kLanes = 8;  // doubles in a register

// Eight rays under way, in registers. A lane without a ray stands still.
struct Group {
  __m512d x, y, z;     // t_max
  __m512d dx, dy, dz;  // t_delta
  __m512d length_m;
  __m256i sx, sy, sz;  // stride
  __m256i index, end;
};

CLEARWAY_AVX512 inline void Put(Group& group, int lane, const WindowRay& ray) {
  const auto at = static_cast<__mmask8>(1 << lane);
  const auto put = [at](__m512d& lanes, double value) CLEARWAY_AVX512 {
    lanes = _mm512_mask_broadcastsd_pd(lanes, at, _mm_set_sd(value));
  };
  const auto put_int = [at](__m256i& lanes, std::int32_t value)
                           CLEARWAY_AVX512 { lanes = _mm256_mask_set1_epi32(lanes, at, value); };
  put(group.x, ray.t_max[0]);
  put(group.y, ray.t_max[1]);
  put(group.z, ray.t_max[2]);
  put(group.dx, ray.t_delta[0]);
  put(group.dy, ray.t_delta[1]);
  put(group.dz, ray.t_delta[2]);
  put(group.length_m, ray.length_m);
  put_int(group.sx, ray.stride[0]);
  put_int(group.sy, ray.stride[1]);
  put_int(group.sz, ray.stride[2]);
  put_int(group.index, ray.index);
  put_int(group.end, ray.end);
}

// The rays that are not yet under way, and how many are.
class Queue {
 public:
  Queue(std::span<const WindowRay> rays, std::uint32_t* words)
      : rays_(rays), words_(words), none_{{0, 0, 0}, {0, 0, 0}, 1, {0, 0, 0}, rays[0].index, -1} {}

  // Starts the next ray in the lane; without one, the lane marks its first voxel for ever.
  CLEARWAY_AVX512 void Start(Group& group, int lane) {
    if (next_ == rays_.size()) return Put(group, lane, none_);
    const WindowRay& ray = rays_[next_++];
    words_[ray.index >> 5] |= std::uint32_t{1} << (ray.index & 31);
    Put(group, lane, ray);
    ++under_way_;
  }
  void End() { --under_way_; }
  bool Empty() const { return under_way_ == 0; }

 private:
  std::span<const WindowRay> rays_;
  std::uint32_t* words_;
  WindowRay none_;
  std::size_t next_ = 0;
  std::size_t under_way_ = 0;
};

// One step of eight rays, as Walk in window_walk.cc. Returns which end with it.
CLEARWAY_AVX512 inline unsigned Step(Group& g, std::uint32_t* words) {
  const __mmask8 x_before_y = _mm512_cmp_pd_mask(g.x, g.y, _CMP_LT_OQ);
  const __mmask8 not_z = _mm512_cmp_pd_mask(_mm512_min_pd(g.x, g.y), g.z, _CMP_LT_OQ);
  const auto along_x = static_cast<__mmask8>(x_before_y & not_z);
  const auto along_y = static_cast<__mmask8>(~x_before_y & not_z);
  const auto along_z = static_cast<__mmask8>(~not_z);
  g.x = _mm512_mask_add_pd(g.x, along_x, g.x, g.dx);
  g.y = _mm512_mask_add_pd(g.y, along_y, g.y, g.dy);
  g.z = _mm512_mask_add_pd(g.z, along_z, g.z, g.dz);
  g.index = _mm256_mask_add_epi32(g.index, along_x, g.index, g.sx);
  g.index = _mm256_mask_add_epi32(g.index, along_y, g.index, g.sy);
  g.index = _mm256_mask_add_epi32(g.index, along_z, g.index, g.sz);

  const __m512d next = _mm512_min_pd(_mm512_min_pd(g.x, g.y), g.z);
  const unsigned ended =
      _mm256_cmpeq_epi32_mask(g.index, g.end) | _mm512_cmp_pd_mask(next, g.length_m, _CMP_GT_OQ);
  alignas(32) std::uint32_t word[kLanes], bit[kLanes];
  _mm256_store_si256(reinterpret_cast<__m256i*>(word), _mm256_srli_epi32(g.index, 5));
  _mm256_store_si256(reinterpret_cast<__m256i*>(bit),
                     _mm256_maskz_sllv_epi32(static_cast<__mmask8>(~ended), _mm256_set1_epi32(1),
                                             _mm256_and_si256(g.index, _mm256_set1_epi32(31))));
  for (int lane = 0; lane < kLanes; ++lane) words[word[lane]] |= bit[lane];
  return ended;
}

// The rays that end make room for others.
CLEARWAY_AVX512 inline void Refill(Group& group, unsigned ended, Queue& queue) {
  for (; __builtin_expect(ended != 0, 0); ended &= ended - 1) {
    queue.End();
    queue.Start(group, __builtin_ctz(ended));
  }
}

// Two groups, for the steps of one hide the latency of the other's.
CLEARWAY_AVX512 void Walk(std::span<const WindowRay> rays, std::uint32_t* words) {
  Queue queue(rays, words);
  Group a{}, b{};
  for (int lane = 0; lane < kLanes; ++lane) queue.Start(a, lane);
  for (int lane = 0; lane < kLanes; ++lane) queue.Start(b, lane);
  while (!queue.Empty()) {
    const unsigned a_ended = Step(a, words), b_ended = Step(b, words);
    Refill(a, a_ended, queue);
    Refill(b, b_ended, queue);
  }
}

}  // namespace

void WalkWindowAvx512(std::span<const WindowRay> rays, std::uint32_t* words) {
  if (!rays.empty()) Walk(rays, words);
}

bool HasAvx512() { return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl"); }

}  // namespace clearway

#else

namespace clearway {

void WalkWindowAvx512(std::span<const WindowRay> rays, std::uint32_t* words) {
  WalkWindowPortable(rays, words);
}
bool HasAvx512() { return false; }

}  // namespace clearway

#endif
