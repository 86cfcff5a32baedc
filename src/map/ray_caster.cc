#include "clearway/map/ray_caster.h"

#include <algorithm>
#include <vector>

#include "absl/container/flat_hash_set.h"
#include "map/bit_window.h"
#include "map/window_walk.h"

namespace clearway {
namespace {

constexpr std::size_t kRaysAtOnce = 2048;  // prepared before they are walked
constexpr std::size_t kRowsAtOnce = 64;    // read out of the windows

const Eigen::Vector3f& OriginOf(const RayCloud& cloud, std::size_t i) {
  return cloud.origins.size() == 1 ? cloud.origins[0] : cloud.origins[i];
}

// The cloud's rays after RayOptions, and the blocks that they can reach.
struct LimitedCloud {
  std::vector<LimitedRay> rays;  // one per point
  BlockKey first, last;
};

LimitedCloud Limit(const VoxelGrid& grid, const RayCloud& cloud, const RayOptions& options,
                   ThreadPool& pool) {
  LimitedCloud limited;
  limited.rays.resize(cloud.ends.size());
  using Box = Eigen::AlignedBox3f;
  std::vector<Box> boxes(pool.threads());
  pool.ParallelFor(cloud.ends.size(), [&](int worker, std::size_t begin, std::size_t end) {
    Box box;
    for (std::size_t i = begin; i < end; ++i) {
      limited.rays[i] = LimitRay(grid, options, OriginOf(cloud, i), cloud.ends[i]);
      box.extend(limited.rays[i].end);
    }
    boxes[worker] = box;
  });
  for (std::size_t i = 0; i < cloud.origins.size(); ++i) boxes[0].extend(cloud.origins[i]);
  for (const Box& box : boxes) boxes[0].extend(box);
  // A ray strays by less than a voxel from its segment.
  const auto block_at = [&](const Eigen::Vector3f& p, int stray) {
    const VoxelKey key = grid.KeyOf(p.cast<double>());
    return BlockOf(VoxelKey{key.x + stray, key.y + stray, key.z + stray});
  };
  limited.first = block_at(boxes[0].min(), -2);
  limited.last = block_at(boxes[0].max(), 2);
  return limited;
}

// Which rays are walked: all, or with `discretize` the first one into each voxel (first of a
// clearing and of a returned ray apart).
std::vector<std::uint32_t> RaysToWalk(const VoxelGrid& grid, const RayCloud& cloud,
                                      bool discretize) {
  std::vector<std::uint32_t> rays;
  rays.reserve(cloud.ends.size());
  absl::flat_hash_set<VoxelKey> returned, cleared;
  const bool distinct = discretize && cloud.origins.size() == 1;
  for (std::size_t i = 0; i < cloud.ends.size(); ++i) {
    auto& seen = cloud.kinds[i] == RayEnd::kClear ? cleared : returned;
    if (!distinct || seen.insert(grid.KeyOf(cloud.ends[i].cast<double>())).second) {
      rays.push_back(static_cast<std::uint32_t>(i));
    }
  }
  return rays;
}

WindowRay InWindow(const RayStart& start, const BitWindow& window) {
  WindowRay ray;
  for (int axis = 0; axis < 3; ++axis) {
    ray.t_max[axis] = start.t_max[axis];
    ray.t_delta[axis] = start.t_delta[axis];
    ray.stride[axis] = start.step[axis] * window.strides()[axis];
  }
  ray.length_m = start.length_m;
  ray.index = window.IndexOf(start.key);
  ray.end = window.IndexOf(start.end);
  return ray;
}

}  // namespace

struct RayCaster::Impl {
  explicit Impl(ThreadPool& the_pool) : pool(the_pool), windows(the_pool.threads()) {}

  ThreadPool& pool;
  std::vector<BitWindow> windows;  // one per thread
  const WindowWalk walk = FastestWindowWalk();

  void MarkFree(const VoxelGrid& grid, const RayCloud& cloud, const LimitedCloud& limited,
                const std::vector<std::uint32_t>& rays, ScanUpdate& update);
  void MarkFreeSparsely(const VoxelGrid& grid, const RayCloud& cloud, const LimitedCloud& limited,
                        const std::vector<std::uint32_t>& rays, ScanUpdate& update);
};

void RayCaster::Impl::MarkFree(const VoxelGrid& grid, const RayCloud& cloud,
                               const LimitedCloud& limited, const std::vector<std::uint32_t>& rays,
                               ScanUpdate& update) {
  for (BitWindow& window : windows) window.Cover(limited.first, limited.last);
  pool.ParallelChunks(rays.size(), kRaysAtOnce,
                      [&](int worker, std::size_t begin, std::size_t end) {
                        BitWindow& window = windows[worker];
                        std::vector<WindowRay> ready;
                        for (std::size_t r = begin; r < end; ++r) {
                          const RayStart start =
                              StartRay(grid, OriginOf(cloud, rays[r]), limited.rays[rays[r]].end);
                          if (start.key != start.end) ready.push_back(InWindow(start, window));
                        }
                        walk(ready, window.words());
                      });
  const std::size_t rows = windows[0].rows();
  std::vector<std::vector<BitWindow::Block>> blocks((rows + kRowsAtOnce - 1) / kRowsAtOnce);
  pool.ParallelChunks(rows, kRowsAtOnce, [&](int, std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      BitWindow::TakeRow(windows, row, blocks[begin / kRowsAtOnce]);
    }
  });
  std::size_t count = 0;
  for (const auto& part : blocks) count += part.size();
  update.Reserve(count);
  for (const auto& part : blocks) {
    for (const BitWindow::Block& block : part) update.MarkFree(block.key, block.mask);
  }
}

// Without a window, which would be too large: a hash table of blocks for each thread.
void RayCaster::Impl::MarkFreeSparsely(const VoxelGrid& grid, const RayCloud& cloud,
                                       const LimitedCloud& limited,
                                       const std::vector<std::uint32_t>& rays, ScanUpdate& update) {
  std::vector<ScanUpdate> updates(pool.threads());
  pool.ParallelFor(rays.size(), [&](int worker, std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      WalkRay(grid, OriginOf(cloud, rays[r]), limited.rays[rays[r]].end,
              [&](VoxelKey key) { updates[worker].MarkFree(key); });
    }
  });
  for (const ScanUpdate& part : updates) update.Merge(part);
}

RayCaster::RayCaster(ThreadPool& pool) : impl_(std::make_unique<Impl>(pool)) {}
RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;
RayCaster& RayCaster::operator=(RayCaster&&) noexcept = default;

ScanUpdate RayCaster::Cast(const VoxelGrid& grid, const RayCloud& cloud,
                           const RayOptions& options) {
  ScanUpdate update;
  if (cloud.ends.empty()) return update;
  const LimitedCloud limited = Limit(grid, cloud, options, impl_->pool);
  const std::vector<std::uint32_t> rays = RaysToWalk(grid, cloud, options.discretize);
  if (BitWindow::Fits(limited.first, limited.last)) {
    impl_->MarkFree(grid, cloud, limited, rays, update);
  } else {
    impl_->MarkFreeSparsely(grid, cloud, limited, rays, update);
  }
  for (std::size_t i = 0; i < cloud.ends.size(); ++i) {
    if (cloud.kinds[i] == RayEnd::kClear || !limited.rays[i].within_range) continue;
    const VoxelKey key = grid.KeyOf(cloud.ends[i].cast<double>());
    cloud.kinds[i] == RayEnd::kHit ? update.MarkHit(key) : update.MarkEnd(key);
  }
  return update;
}

}  // namespace clearway
