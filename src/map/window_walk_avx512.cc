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

constexpr int kLanes = 8;   // doubles in a register
constexpr int kGroups = 3;  // registers of rays under way: one's steps hide the others' latency

// Eight rays under way. A lane without a ray stands still.
struct Group {
  alignas(64) double t_max[3][kLanes] = {};
  alignas(64) double t_delta[3][kLanes] = {};
  alignas(64) double length_m[kLanes] = {};
  alignas(32) std::int32_t stride[3][kLanes] = {};
  alignas(32) std::int32_t index[kLanes] = {};
  alignas(32) std::int32_t end[kLanes] = {};

  void Put(int lane, const WindowRay& ray) {
    for (int axis = 0; axis < 3; ++axis) {
      t_max[axis][lane] = ray.t_max[axis];
      t_delta[axis][lane] = ray.t_delta[axis];
      stride[axis][lane] = ray.stride[axis];
    }
    length_m[lane] = ray.length_m;
    index[lane] = ray.index;
    end[lane] = ray.end;
  }
};

// The rays that are not yet under way, and how many are.
class Queue {
 public:
  Queue(std::span<const WindowRay> rays, std::uint32_t* words) : rays_(rays), words_(words) {}

  // Starts the next ray in the lane; without one, the lane marks its first voxel for ever.
  void Start(Group& group, int lane) {
    if (next_ < rays_.size()) {
      const WindowRay& ray = rays_[next_++];
      words_[ray.index >> 5] |= std::uint32_t{1} << (ray.index & 31);
      group.Put(lane, ray);
      ++under_way_;
    } else {
      group.Put(lane, {{0, 0, 0}, {0, 0, 0}, 1, {0, 0, 0}, rays_[0].index, -1});
    }
  }
  void End() { --under_way_; }
  bool Empty() const { return under_way_ == 0; }

 private:
  std::span<const WindowRay> rays_;
  std::uint32_t* words_;
  std::size_t next_ = 0;
  std::size_t under_way_ = 0;
};

CLEARWAY_AVX512 inline __m256i Load(const std::int32_t* from) {
  return _mm256_load_si256(reinterpret_cast<const __m256i*>(from));
}

// One step of eight rays, as Walk in window_walk.cc; those that end make room for others.
CLEARWAY_AVX512 inline void Step(Group& group, Queue& queue, std::uint32_t* words) {
  const __m512d x = _mm512_load_pd(group.t_max[0]);
  const __m512d y = _mm512_load_pd(group.t_max[1]);
  const __m512d z = _mm512_load_pd(group.t_max[2]);
  const __mmask8 x_before_y = _mm512_cmp_pd_mask(x, y, _CMP_LT_OQ);
  const __mmask8 not_z = _mm512_cmp_pd_mask(_mm512_min_pd(x, y), z, _CMP_LT_OQ);
  const auto along_x = static_cast<__mmask8>(x_before_y & not_z);
  const auto along_y = static_cast<__mmask8>(~x_before_y & not_z);
  const auto along_z = static_cast<__mmask8>(~not_z);
  const __m512d x2 = _mm512_mask_add_pd(x, along_x, x, _mm512_load_pd(group.t_delta[0]));
  const __m512d y2 = _mm512_mask_add_pd(y, along_y, y, _mm512_load_pd(group.t_delta[1]));
  const __m512d z2 = _mm512_mask_add_pd(z, along_z, z, _mm512_load_pd(group.t_delta[2]));
  _mm512_store_pd(group.t_max[0], x2);
  _mm512_store_pd(group.t_max[1], y2);
  _mm512_store_pd(group.t_max[2], z2);

  __m256i index = Load(group.index);
  index = _mm256_mask_add_epi32(index, along_x, index, Load(group.stride[0]));
  index = _mm256_mask_add_epi32(index, along_y, index, Load(group.stride[1]));
  index = _mm256_mask_add_epi32(index, along_z, index, Load(group.stride[2]));
  _mm256_store_si256(reinterpret_cast<__m256i*>(group.index), index);

  const __m512d next = _mm512_min_pd(_mm512_min_pd(x2, y2), z2);
  const unsigned ended = _mm256_cmpeq_epi32_mask(index, Load(group.end)) |
                         _mm512_cmp_pd_mask(next, _mm512_load_pd(group.length_m), _CMP_GT_OQ);
  alignas(32) std::uint32_t word[kLanes], bit[kLanes];
  _mm256_store_si256(reinterpret_cast<__m256i*>(word), _mm256_srli_epi32(index, 5));
  _mm256_store_si256(reinterpret_cast<__m256i*>(bit),
                     _mm256_maskz_sllv_epi32(static_cast<__mmask8>(~ended), _mm256_set1_epi32(1),
                                             _mm256_and_si256(index, _mm256_set1_epi32(31))));
  for (int lane = 0; lane < kLanes; ++lane) words[word[lane]] |= bit[lane];
  for (unsigned rest = ended; __builtin_expect(rest != 0, 0); rest &= rest - 1) {
    queue.End();
    queue.Start(group, __builtin_ctz(rest));
  }
}

CLEARWAY_AVX512 void Walk(std::span<const WindowRay> rays, std::uint32_t* words) {
  Group groups[kGroups];
  Queue queue(rays, words);
  for (Group& group : groups) {
    for (int lane = 0; lane < kLanes; ++lane) queue.Start(group, lane);
  }
  while (!queue.Empty()) {
    for (Group& group : groups) Step(group, queue, words);
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
