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
      keys_(kAtOnce),
      indices_(kAtOnce + kRunsRoom),
      runs_(kAtOnce + kRunsRoom),
      states_(kAtOnce + kRunsRoom),
      firsts_(kAtOnce + kRunsRoom),
      block_keys_(kAtOnce),
      blocks_(kAtOnce) {}

std::size_t VoxelReader::Locate(std::span<const Eigen::Vector3d> points) {
  map_.grid().KeysOf(points, keys_.data());
  const std::size_t runs =
      Kernels().cut(keys_.data(), points.size(), indices_.data(), runs_.data(), firsts_.data());
  for (std::size_t r = 0; r < runs; ++r) block_keys_[r] = BlockOf(keys_[firsts_[r]]);
  map_.blocks().FindAll(std::span(block_keys_).first(runs), blocks_.data());
  std::replace(blocks_.begin(), blocks_.begin() + runs, static_cast<const VoxelBlock*>(nullptr),
               &kUnobserved);
  return runs;
}

void VoxelReader::States(std::span<const Eigen::Vector3d> points, std::span<VoxelState> states) {
  for (std::size_t begin = 0; begin < points.size(); begin += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, points.size() - begin);
    const std::size_t runs = Locate(points.subspan(begin, count));
    Kernels().read(blocks_.data(), firsts_.data(), runs, indices_.data(), count, states_.data());
    std::copy_n(states_.begin(), count, states.begin() + begin);
  }
}

}  // namespace clearway
