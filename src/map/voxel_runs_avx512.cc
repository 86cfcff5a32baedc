#include "map/voxel_runs.h"

#ifdef __x86_64__
#include <algorithm>
#include <array>
#include <bit>

#include "map/avx512_functions.h"

namespace clearway {
namespace {

constexpr std::size_t kCutLanes = 8, kReadLanes = 32;  // points at a time

// Of eight coordinates: VoxelGrid's Index.
CLEARWAY_AVX512 inline __m256i IndicesOf(const double* coordinates, __m512d voxels_per_m) {
  return _mm512_cvt_roundpd_epi32(_mm512_mul_pd(voxels_per_m, _mm512_loadu_pd(coordinates)),
                                  _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
}

// Of eight triples the x, y or z.
CLEARWAY_AVX512 inline __m256i Along(int axis, __m512i first_16, __m512i last_8) {
  const __m512i places =
      _mm512_add_epi32(_mm512_setr_epi32(0, 3, 6, 9, 12, 15, 18, 21, 0, 0, 0, 0, 0, 0, 0, 0),
                       _mm512_set1_epi32(axis));
  return _mm512_castsi512_si256(_mm512_permutex2var_epi32(first_16, places, last_8));
}

CLEARWAY_AVX512 inline void Store(void* to, __m256i values) {
  _mm256_storeu_si256(static_cast<__m256i*>(to), values);
}

// What differs in each lane from the one before it, of which `before` holds the first's in its
// last.
CLEARWAY_AVX512 inline __m256i Changes(__m256i before, __m256i values) {
  return _mm256_xor_si256(values, _mm256_alignr_epi32(values, before, 7));
}

// Along one axis: the blocks of eight points after the other.
class BlockAxis {
 public:
  CLEARWAY_AVX512 explicit BlockAxis(std::int32_t before) : last_(_mm256_set1_epi32(before)) {}

  // Puts down those of points i to i + 7, of whose voxels these are the indices; returns what
  // differs from the point before.
  CLEARWAY_AVX512 __m256i Add(std::size_t i, __m256i indices) {
    const __m256i next = _mm256_srai_epi32(indices, kBlockBits);
    const __m256i changes = Changes(last_, next);
    Store(&of_points_[i], next);
    last_ = next;
    return changes;
  }
  std::int32_t operator[](std::size_t i) const { return of_points_[i]; }

 private:
  __m256i last_;
  std::array<std::int32_t, kRunsAtOnce + kCutLanes> of_points_;
};

// The places in their blocks of eight voxels.
CLEARWAY_AVX512 inline __m128i PlacesOf(__m256i x, __m256i y, __m256i z) {
  const __m256i seven = _mm256_set1_epi32(kBlockSize - 1);
  const __m256i rows = _mm256_slli_epi32(_mm256_and_si256(y, seven), kBlockBits);
  const __m256i layers = _mm256_slli_epi32(_mm256_and_si256(z, seven), 2 * kBlockBits);
  return _mm256_cvtepi32_epi16(
      _mm256_or_si256(_mm256_and_si256(x, seven), _mm256_or_si256(rows, layers)));
}

CLEARWAY_AVX512 std::size_t Cut(const VoxelGrid& grid, const Eigen::Vector3d* points,
                                std::size_t count, const Eigen::Vector3d* soon,
                                std::uint16_t* indices, std::uint32_t* firsts, BlockKey* blocks) {
  if (count == 0) return 0;
  const __m512d voxels_per_m = _mm512_set1_pd(grid.voxels_per_m());
  const __m256i order = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  // The last ones, and as often as it takes the very last.
  std::array<Eigen::Vector3d, kCutLanes> rest;
  const std::size_t whole = count / kCutLanes * kCutLanes;
  std::fill(std::copy(points + whole, points + count, rest.begin()), rest.end(), points[count - 1]);
  // The first one begins a run: what is before it lies elsewhere.
  BlockAxis block_x(~BlockOf(grid.KeyOf(points[0])).x), block_y(0), block_z(0);
  std::size_t run_count = 0;
  for (std::size_t i = 0; i < count; i += kCutLanes) {
    AskFor(soon + i, kCutLanes);
    const double* const from = i < whole ? points[i].data() : rest[0].data();
    const __m512i first_16 =
        _mm512_inserti64x4(_mm512_castsi256_si512(IndicesOf(from, voxels_per_m)),
                           IndicesOf(from + 8, voxels_per_m), 1);
    const __m512i last_8 = _mm512_castsi256_si512(IndicesOf(from + 16, voxels_per_m));
    const __m256i x = Along(0, first_16, last_8), y = Along(1, first_16, last_8),
                  z = Along(2, first_16, last_8);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(indices + i), PlacesOf(x, y, z));
    const __m256i changes =
        _mm256_or_si256(block_x.Add(i, x), _mm256_or_si256(block_y.Add(i, y), block_z.Add(i, z)));
    const __mmask8 begins = _mm256_test_epi32_mask(changes, changes);
    Store(firsts + run_count,
          _mm256_maskz_compress_epi32(
              begins, _mm256_add_epi32(_mm256_set1_epi32(static_cast<int>(i)), order)));
    run_count += static_cast<std::size_t>(std::popcount(begins));
  }
  for (std::size_t r = 0; r < run_count; ++r) {
    blocks[r] = {block_x[firsts[r]], block_y[firsts[r]], block_z[firsts[r]]};
  }
  firsts[run_count] = static_cast<std::uint32_t>(count);
  return run_count;
}

// Bit `places` of the mask's 16-bit words `words`, 32 times.
CLEARWAY_AVX512 inline __m512i BitsOf(const BlockMask& mask, __m512i words, __m512i places) {
  const __m512i word = _mm512_permutexvar_epi16(words, _mm512_loadu_si512(mask.words.data()));
  return _mm512_and_si512(_mm512_srlv_epi16(word, places), _mm512_set1_epi16(1));
}

// A block's masks in registers: each voxel picks its word there.
CLEARWAY_AVX512 void Read(const VoxelBlock* const* blocks, const std::uint32_t* firsts,
                          std::size_t run_count, const std::uint16_t* indices, VoxelState* states) {
  for (std::size_t r = 0; r < run_count; ++r) {
    for (std::size_t i = firsts[r]; i < firsts[r + 1]; i += kReadLanes) {
      const __m512i index = _mm512_loadu_si512(indices + i);
      const __m512i words = _mm512_srli_epi16(index, 4);
      const __m512i places = _mm512_and_si512(index, _mm512_set1_epi16(15));
      const __m512i sum = _mm512_add_epi16(BitsOf(blocks[r]->observed, words, places),
                                           BitsOf(blocks[r]->occupied, words, places));
      // What is written beyond the run's end, the next run writes anew.
      _mm256_storeu_si256(reinterpret_cast<__m256i*>(states + i), _mm512_cvtepi16_epi8(sum));
    }
  }
}

}  // namespace

RunKernels Avx512RunKernels() { return {Cut, Read}; }

}  // namespace clearway

#else

namespace clearway {

RunKernels Avx512RunKernels() { return PortableRunKernels(); }

}  // namespace clearway

#endif
