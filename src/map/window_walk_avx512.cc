#include "map/window_walk.h"

#ifdef __x86_64__
#include <cstddef>

#include "map/avx512_functions.h"

namespace clearway {
namespace {

static_assert(kLanes == 8);  // doubles in a register

// Eight rays under way, in registers. A lane without a ray stands still.
struct Group {
  __m512d x, y, z;     // t_max
  __m512d dx, dy, dz;  // t_delta
  __m512d length_m;
  __m256i sx, sy, sz;  // stride
  __m256i index, end;
};

// Moves a ray into a lane of the group.
CLEARWAY_AVX512 inline void Put(Group& group, int lane, const WindowRays& rays, int from) {
  const auto at = static_cast<__mmask8>(1 << lane);
  const auto put = [at, from](__m512d& lanes, const LaneDoubles& values) CLEARWAY_AVX512 {
    lanes = _mm512_mask_broadcastsd_pd(lanes, at, _mm_set_sd(values[from]));
  };
  const auto put_int = [at, from](__m256i& lanes, const LaneInts& values) CLEARWAY_AVX512 {
    lanes = _mm256_mask_set1_epi32(lanes, at, values[from]);
  };
  put(group.x, rays.t_max[0]);
  put(group.y, rays.t_max[1]);
  put(group.z, rays.t_max[2]);
  put(group.dx, rays.t_delta[0]);
  put(group.dy, rays.t_delta[1]);
  put(group.dz, rays.t_delta[2]);
  put(group.length_m, rays.length_m);
  put_int(group.sx, rays.stride[0]);
  put_int(group.sy, rays.stride[1]);
  put_int(group.sz, rays.stride[2]);
  put_int(group.index, rays.index);
  put_int(group.end, rays.end);
}

// The rays that are not yet under way, and how many are.
class Queue {
 public:
  Queue(std::span<const WindowRays> rays, std::uint32_t* words) : rays_(rays), words_(words) {
    Find();
  }

  // Starts the next ray in the lane; without one, the lane marks a voxel that is marked for ever.
  CLEARWAY_AVX512 void Start(Group& group, int lane) {
    if (next_ == rays_.size() * kLanes) return Put(group, lane, none_, 0);
    const WindowRays& rays = rays_[next_ / kLanes];
    const auto from = static_cast<int>(next_ % kLanes);
    const std::int32_t index = none_.index[0] = rays.index[from];
    words_[index >> 5] |= std::uint32_t{1} << (index & 31);
    Put(group, lane, rays, from);
    ++under_way_;
    ++next_;
    Find();
  }
  void End() { --under_way_; }
  bool Empty() const { return under_way_ == 0; }

 private:
  // Goes on to the next ray that goes anywhere.
  void Find() {
    while (next_ < rays_.size() * kLanes && GoesNowhere()) ++next_;
  }
  bool GoesNowhere() const {
    const WindowRays& rays = rays_[next_ / kLanes];
    return rays.index[next_ % kLanes] == rays.end[next_ % kLanes];
  }

  std::span<const WindowRays> rays_;
  std::uint32_t* words_;
  WindowRays none_{{}, {}, LaneDoubles{} + 1, {}, {}, LaneInts{} - 1};  // never moves, never ends
  std::size_t next_ = 0;
  std::size_t under_way_ = 0;
};

// Sets the bits of the voxels that some of the rays are in.
CLEARWAY_AVX512 inline void Mark(const Group& g, __mmask8 lanes, std::uint32_t* words) {
  alignas(32) std::uint32_t word[kLanes], bit[kLanes];
  _mm256_store_si256(reinterpret_cast<__m256i*>(word), _mm256_srli_epi32(g.index, 5));
  _mm256_store_si256(reinterpret_cast<__m256i*>(bit),
                     _mm256_maskz_sllv_epi32(lanes, _mm256_set1_epi32(1),
                                             _mm256_and_si256(g.index, _mm256_set1_epi32(31))));
  // Through memory: to take lanes out of registers one by one takes twice as long.
  asm("" : "+m"(word), "+m"(bit));
  for (int lane = 0; lane < kLanes; ++lane) words[word[lane]] |= bit[lane];
}

// One step of eight rays, as Step in window_walk.cc. Returns which end with it.
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
  Mark(g, static_cast<__mmask8>(~ended), words);
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
CLEARWAY_AVX512 void Walk(std::span<const WindowRays> rays, std::uint32_t* words) {
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

CLEARWAY_AVX512 inline void Load(const WindowRays& rays, Group& group) {
  const auto load = [](__m512d& lanes, const LaneDoubles& values)
                        CLEARWAY_AVX512 { lanes = _mm512_load_pd(&values); };
  const auto load_ints = [](__m256i& lanes, const LaneInts& values) CLEARWAY_AVX512 {
    lanes = _mm256_load_si256(reinterpret_cast<const __m256i*>(&values));
  };
  load(group.x, rays.t_max[0]);
  load(group.y, rays.t_max[1]);
  load(group.z, rays.t_max[2]);
  load(group.dx, rays.t_delta[0]);
  load(group.dy, rays.t_delta[1]);
  load(group.dz, rays.t_delta[2]);
  load(group.length_m, rays.length_m);
  load_ints(group.sx, rays.stride[0]);
  load_ints(group.sy, rays.stride[1]);
  load_ints(group.sz, rays.stride[2]);
  load_ints(group.index, rays.index);
  load_ints(group.end, rays.end);
}

// Eight rays that begin together, and wait for the last of them. Those at their end step on the
// spot.
class Eight {
 public:
  CLEARWAY_AVX512 Eight(const WindowRays& rays, std::uint32_t* words) {
    Load(rays, group_);
    StopAll(_mm256_cmpeq_epi32_mask(group_.index, group_.end));
    Mark(group_, under_way_, words);
  }
  CLEARWAY_AVX512 void Go(std::uint32_t* words) {
    const unsigned ended = Step(group_, words) & under_way_;
    if (__builtin_expect(ended != 0, 0)) StopAll(static_cast<__mmask8>(ended));
  }
  bool UnderWay() const { return under_way_ != 0; }

 private:
  CLEARWAY_AVX512 void StopAll(__mmask8 ended) {
    under_way_ = static_cast<__mmask8>(under_way_ & ~ended);
    for (__m256i* stride : {&group_.sx, &group_.sy, &group_.sz}) {
      *stride = _mm256_maskz_mov_epi32(under_way_, *stride);
    }
  }

  Group group_;
  __mmask8 under_way_ = 0xff;
};

CLEARWAY_AVX512 void WalkAbreast(std::span<const WindowRays> rays, std::uint32_t* words) {
  std::size_t i = 0;
  for (; i + 1 < rays.size(); i += 2) {
    Eight a(rays[i], words), b(rays[i + 1], words);
    while (a.UnderWay() || b.UnderWay()) {
      a.Go(words);
      b.Go(words);
    }
  }
  if (i == rays.size()) return;
  for (Eight last(rays[i], words); last.UnderWay();) last.Go(words);
}

}  // namespace

void WalkWindowAvx512(std::span<const WindowRays> rays, std::uint32_t* words) {
  if (!rays.empty()) Walk(rays, words);
}

void WalkWindowAbreastAvx512(std::span<const WindowRays> rays, std::uint32_t* words) {
  WalkAbreast(rays, words);
}

}  // namespace clearway

#else

namespace clearway {

void WalkWindowAvx512(std::span<const WindowRays> rays, std::uint32_t* words) {
  WalkWindowPortable(rays, words);
}

void WalkWindowAbreastAvx512(std::span<const WindowRays> rays, std::uint32_t* words) {
  WalkWindowPortable(rays, words);
}

}  // namespace clearway

#endif
