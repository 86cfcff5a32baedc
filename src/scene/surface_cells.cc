#include "scene/surface_cells.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace clearway {
namespace {

// The columns of L, where L L^T is the matrix: symmetric, and not negative but for rounding.
std::array<Eigen::Vector3d, 3> Factors(const Eigen::Matrix3d& m) {
  const auto root = [](double value) { return std::sqrt(std::max(value, 1e-12)); };
  const double l00 = root(m(0, 0)), l10 = m(1, 0) / l00, l20 = m(2, 0) / l00;
  const double l11 = root(m(1, 1) - l10 * l10), l21 = (m(2, 1) - l20 * l10) / l11;
  const double l22 = root(m(2, 2) - l20 * l20 - l21 * l21);
  return {{{l00, l10, l20}, {0, l11, l21}, {0, 0, l22}}};
}

}  // namespace

void SurfaceCells::Sums::Add(double of_weight, const Eigen::Vector3d& p) {
  count += 1;
  weight += of_weight;
  for (int i = 0; i < 3; ++i) {
    first[i] += of_weight * p[i];
    for (int j = 0; j < 3; ++j) second(i, j) += of_weight * p[i] * p[j];
  }
}

void SurfaceCells::Sums::Add(const Sums& other) {
  count += other.count;
  weight += other.weight;
  first += other.first;
  second += other.second;
}

SurfaceCells::SurfaceCells(const VoxelMap& map, int bits, const Eigen::Vector3d& origin)
    : map_(&map),
      bits_(bits),
      shift_(kBlockBits - bits),
      voxel_m_(map.grid().resolution_m()),
      per_m_(map.grid().voxels_per_m() / (1 << bits)),
      origin_(origin) {}

const SurfaceCells::Cell* SurfaceCells::At(const Eigen::Vector3d& p_M) {
  constexpr double kFar = 1e9;  // cells; nothing is there
  const auto index = [&](double x) {
    return static_cast<std::int32_t>(std::clamp(std::floor(x * per_m_), -kFar, kFar));
  };
  const Eigen::Vector3d p = p_M + origin_;
  const auto [entry, fresh] = seen_.try_emplace({index(p.x()), index(p.y()), index(p.z())});
  if (fresh) entry->second = CellAround(entry->first);
  return entry->second ? &*entry->second : nullptr;
}

std::ptrdiff_t SurfaceCells::BeginOf(BlockKey block) {
  Recent& recent = recent_[(block.x & 3) | (block.y & 3) << 2 | (block.z & 3) << 4];
  if (recent.begin == kUnasked || recent.block != block) recent = {block, FindOrAdd(block)};
  return recent.begin;
}

std::ptrdiff_t SurfaceCells::FindOrAdd(BlockKey block_key) {
  const auto [entry, fresh] = begins_.try_emplace(block_key, kNone);
  if (!fresh) return entry->second;
  const VoxelBlock* block = map_->blocks().Find(block_key);
  if (block == nullptr || !block->occupied.Any()) return kNone;
  entry->second = static_cast<std::ptrdiff_t>(sums_.size());
  sums_.resize(sums_.size() + (std::size_t{1} << 3 * shift_));
  Sums* const of_block = &sums_[entry->second];
  block->occupied.ForEach([&](int index) {
    const int x = index & 7, y = index >> 3 & 7, z = index >> 6;
    const int cell = x >> bits_ | y >> bits_ << shift_ | z >> bits_ << 2 * shift_;
    // Occupied may be what is as likely free.
    const double weight = std::max<double>(block->log_odds[index], 1);
    of_block[cell].Add(weight, map_->grid().CenterOf(VoxelAt(block_key, index)));
  });
  return entry->second;
}

std::optional<SurfaceCells::Cell> SurfaceCells::CellAround(BlockKey key) {
  constexpr double kFewest = 3;  // voxels that make a distribution
  const int across = (1 << shift_) - 1;
  Sums around;
  BlockKey block;  // most often that of the cell before, too
  std::ptrdiff_t begin = kNone;
  for (int i = 0; i < 27; ++i) {
    const BlockKey at{key.x + i % 3 - 1, key.y + i / 3 % 3 - 1, key.z + i / 9 - 1};
    const BlockKey of_cell{at.x >> shift_, at.y >> shift_, at.z >> shift_};
    if (i == 0 || of_cell != block) begin = BeginOf(of_cell);
    block = of_cell;
    if (begin == kNone) continue;
    const int cell = (at.x & across) | (at.y & across) << shift_ | (at.z & across) << 2 * shift_;
    if (sums_[begin + cell].count > 0) around.Add(sums_[begin + cell]);
  }
  if (around.count < kFewest) return std::nullopt;
  return CellOf(around);
}

// The information of the distribution, less that of a wider one: for a thin surface that is nearly
// all across it, and nearly none along it. Where a voxel lies, nobody knows better than by half of
// its edge.
SurfaceCells::Cell SurfaceCells::CellOf(const Sums& sums) const {
  constexpr double kOwnVariance = 0.25, kWider = 2;  // in squares of voxels
  const Eigen::Vector3d mean = sums.first / sums.weight;
  Cell cell;
  cell.mean_M = mean - origin_;
  Eigen::Matrix3d covariance;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      covariance(i, j) = sums.second(i, j) / sums.weight - mean[i] * mean[j];
    }
    covariance(i, i) += kOwnVariance * voxel_m_ * voxel_m_;
  }
  Eigen::Matrix3d wider = covariance;
  for (int i = 0; i < 3; ++i) wider(i, i) += kWider * voxel_m_ * voxel_m_;
  cell.factors = Factors(covariance.inverse() - wider.inverse());
  return cell;
}

}  // namespace clearway
