#include "map/voxel_runs.h"

#ifdef __x86_64__
#include <algorithm>
#include <array>
#include <bit>

#include "map/avx512_functions.h"

namespace clearway {
namespace {

constexpr std::size_t kLanes = 8;  // voxels at a time

// For each byte, how many of its bits are set up to each one.
constexpr std::array<std::uint64_t, 256> kBitsUpTo = [] {
  std::array<std::uint64_t, 256> bits{};
  for (int byte = 0; byte < 256; ++byte) {
    for (int i = 0; i < 8; ++i) {
      bits[byte] |= std::uint64_t(std::popcount(byte & ((2u << i) - 1))) << 8 * i;
    }
  }
  return bits;
}();

// The keys' x, y or z.
CLEARWAY_AVX512 inline __m256i Along(int axis, __m512i first_16, __m512i last_8) {
  const __m512i places =
      _mm512_add_epi32(_mm512_setr_epi32(0, 3, 6, 9, 12, 15, 18, 21, 0, 0, 0, 0, 0, 0, 0, 0),
                       _mm512_set1_epi32(axis));
  return _mm512_castsi512_si256(_mm512_permutex2var_epi32(first_16, places, last_8));
}

// The lanes that differ from the one before them, of which `before` holds the first's in its last.
CLEARWAY_AVX512 inline unsigned Changes(__m256i before, __m256i values) {
  return _mm256_cmpneq_epi32_mask(values, _mm256_alignr_epi32(values, before, 7));
}

CLEARWAY_AVX512 inline void Store(std::uint32_t* to, __m256i values) {
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), values);
}

// Bit `places` of the mask's words `words`, eight times.
CLEARWAY_AVX512 inline __m512i BitsOf(const BlockMask& mask, __m512i words, __m512i places) {
  const __m512i word = _mm512_permutexvar_epi64(words, _mm512_loadu_si512(mask.words.data()));
  return _mm512_and_si512(_mm512_srlv_epi64(word, places), _mm512_set1_epi64(1));
}

CLEARWAY_AVX512 std::size_t Cut(const VoxelKey* keys, std::size_t count, std::uint32_t* indices,
                                std::uint32_t* runs, std::uint32_t* firsts) {
  if (count == 0) return 0;
  const __m256i seven = _mm256_set1_epi32(kBlockSize - 1);
  const __m256i order = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  // Of the voxels before: at first, of one that lies in another block.
  __m256i block_x = _mm256_set1_epi32(~(keys[0].x >> kBlockBits)), block_y{}, block_z{};
  std::size_t run_count = 0;
  for (std::size_t i = 0; i < count; i += kLanes) {
    const std::size_t used = std::min(kLanes, count - i);
    const unsigned ints = (1u << 3 * used) - 1;  // 24 of them hold eight keys
    const std::int32_t* const from = &keys[i].x;
    const __m512i first_16 = _mm512_maskz_loadu_epi32(static_cast<__mmask16>(ints), from);
    const __m512i last_8 = _mm512_maskz_loadu_epi32(static_cast<__mmask16>(ints >> 16), from + 16);
    const __m256i x = Along(0, first_16, last_8), y = Along(1, first_16, last_8),
                  z = Along(2, first_16, last_8);
    Store(indices + i,
          _mm256_or_si256(
              _mm256_and_si256(x, seven),
              _mm256_or_si256(_mm256_slli_epi32(_mm256_and_si256(y, seven), kBlockBits),
                              _mm256_slli_epi32(_mm256_and_si256(z, seven), 2 * kBlockBits))));
    const __m256i next_x = _mm256_srai_epi32(x, kBlockBits),
                  next_y = _mm256_srai_epi32(y, kBlockBits),
                  next_z = _mm256_srai_epi32(z, kBlockBits);
    const unsigned begins =
        (Changes(block_x, next_x) | Changes(block_y, next_y) | Changes(block_z, next_z)) &
        ((1u << used) - 1);
    block_x = next_x;
    block_y = next_y;
    block_z = next_z;
    const __m256i upto =
        _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(static_cast<long long>(kBitsUpTo[begins])));
    Store(runs + i, _mm256_add_epi32(_mm256_set1_epi32(static_cast<int>(run_count) - 1), upto));
    Store(firsts + run_count, _mm256_maskz_compress_epi32(
                                  static_cast<__mmask8>(begins),
                                  _mm256_add_epi32(_mm256_set1_epi32(static_cast<int>(i)), order)));
    run_count += static_cast<std::size_t>(std::popcount(begins));
  }
  return run_count;
}

// A block's masks in registers: each voxel picks its word there.
CLEARWAY_AVX512 void Read(const VoxelBlock* const* blocks, const std::uint32_t* firsts,
                          std::size_t run_count, const std::uint32_t* indices, std::size_t count,
                          VoxelState* states) {
  for (std::size_t r = 0; r < run_count; ++r) {
    const std::size_t end = r + 1 < run_count ? firsts[r + 1] : count;
    for (std::size_t i = firsts[r]; i < end; i += kLanes) {
      const __m512i index =
          _mm512_cvtepu32_epi64(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(indices + i)));
      const __m512i words = _mm512_srli_epi64(index, 6);
      const __m512i places = _mm512_and_si512(index, _mm512_set1_epi64(63));
      const __m512i sum = _mm512_add_epi64(BitsOf(blocks[r]->observed, words, places),
                                           BitsOf(blocks[r]->occupied, words, places));
      // What is written beyond the run's end, the next run writes anew.
      _mm_storel_epi64(reinterpret_cast<__m128i*>(states + i), _mm512_cvtepi64_epi8(sum));
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
