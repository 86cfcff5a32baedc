#include "clearway/map/voxel_reader.h"

#include "map/voxel_runs.h"

namespace clearway {
namespace {

constexpr VoxelBlock kUnobserved{};

const RunKernels& Kernels() {
  static const RunKernels kernels = FastestRunKernels();
  return kernels;
}

}  // namespace

VoxelReader::VoxelReader(const VoxelMap& map)
    : map_(map),
      indices_(kAtOnce + kRunsRoom),
      states_(kAtOnce + kRunsRoom),
      firsts_(kAtOnce + kRunsRoom),
      block_keys_(kAtOnce + kRunsRoom),
      blocks_(kAtOnce) {}

std::size_t VoxelReader::Locate(std::span<const Eigen::Vector3d> points, std::size_t begin,
                                std::size_t count) {
  static_assert(kAtOnce <= kRunsAtOnce);
  constexpr std::size_t kAhead = 3 * kAtOnce;
  const std::size_t soon = begin + kAhead + count <= points.size() ? begin + kAhead : begin;
  const std::size_t runs = Kernels().cut(map_.grid(), &points[begin], count, &points[soon],
                                         indices_.data(), firsts_.data(), block_keys_.data());
  map_.blocks().FindAll(std::span(block_keys_).first(runs), blocks_.data());
  std::replace(blocks_.begin(), blocks_.begin() + runs, static_cast<const VoxelBlock*>(nullptr),
               &kUnobserved);
  return runs;
}

void VoxelReader::States(std::span<const Eigen::Vector3d> points, std::span<VoxelState> states) {
  for (std::size_t begin = 0; begin < points.size(); begin += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, points.size() - begin);
    const std::size_t runs = Locate(points, begin, count);
    Kernels().read(blocks_.data(), firsts_.data(), runs, indices_.data(), states_.data());
    std::copy_n(states_.begin(), count, states.begin() + begin);
  }
}

}  // namespace clearway
