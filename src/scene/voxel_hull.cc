#include "scene/voxel_hull.h"

#include <algorithm>
#include <bit>
#include <utility>
#include <vector>

namespace clearway {
namespace {

// A row of voxels along x, from the first to the last that is occupied.
struct Row {
  std::int32_t y, z, first_x, last_x;
};

// By z and y, each once.
std::vector<Row> OccupiedRows(const VoxelMap& map) {
  std::vector<Row> rows;
  map.blocks().ForEach([&](BlockKey key, const VoxelBlock& block) {
    const auto [x, y, z] = VoxelAt(key, 0);
    for (int line = 0; line < kBlockSize * kBlockSize; ++line) {
      const int in_y = line % kBlockSize, in_z = line / kBlockSize;
      const auto bits = static_cast<std::uint8_t>(block.occupied.words[in_z] >> kBlockSize * in_y);
      if (bits == 0) continue;
      rows.push_back({y + in_y, z + in_z, x + std::countr_zero(bits),
                      x + kBlockSize - 1 - std::countl_zero(bits)});
    }
  });
  std::ranges::sort(rows, {}, [](const Row& row) { return std::pair(row.z, row.y); });
  std::size_t size = 0;
  for (const Row& row : rows) {
    if (size == 0 || rows[size - 1].y != row.y || rows[size - 1].z != row.z) {
      rows[size++] = row;
      continue;
    }
    Row& same = rows[size - 1];
    same.first_x = std::min(same.first_x, row.first_x);
    same.last_x = std::max(same.last_x, row.last_x);
  }
  rows.resize(size);
  return rows;
}

// Puts a point of a plane at the end of a chain that bends to one side only: at the least x (sign
// 1) or the greatest (-1) of each y, by ascending y.
void Extend(std::vector<Eigen::Vector3d>& chain, const Eigen::Vector3d& next, int sign) {
  if (!chain.empty() && chain.back().y() == next.y()) {
    if (sign * next.x() >= sign * chain.back().x()) return;
    chain.pop_back();
  }
  while (chain.size() >= 2) {
    const Eigen::Vector3d& a = chain[chain.size() - 2];
    const Eigen::Vector3d& b = chain.back();
    const double bend = (b.y() - a.y()) * (next.x() - a.x()) - (b.x() - a.x()) * (next.y() - a.y());
    if (sign * bend > 0) break;
    chain.pop_back();
  }
  chain.push_back(next);
}

// The outline of points in a plane that come by ascending y.
class Outline {
 public:
  void Add(const Eigen::Vector3d& p) {
    Extend(least_, p, 1);
    Extend(greatest_, p, -1);
  }
  // Calls visit(corner) for each, and begins anew.
  template <class Visit>
  void Take(Visit&& visit) {
    for (const Eigen::Vector3d& p : least_) visit(p);
    for (const Eigen::Vector3d& p : greatest_) {
      if (p != least_.front() && p != least_.back()) visit(p);  // where the chains meet
    }
    least_.clear();
    greatest_.clear();
  }

 private:
  std::vector<Eigen::Vector3d> least_, greatest_;
};

}  // namespace

void KeepOutlines(std::vector<Eigen::Vector3d>& points) {
  std::ranges::sort(points, {}, [](const auto& p) { return std::pair(p.z(), p.y()); });
  Outline outline;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    outline.Add(points[i]);
    if (i + 1 < points.size() && points[i + 1].z() == points[i].z()) continue;
    outline.Take([&](const Eigen::Vector3d& p) { points[kept++] = p; });
  }
  points.resize(kept);
}

std::vector<Eigen::Vector3d> HullCandidates(const VoxelMap& map) {
  std::vector<Eigen::Vector3d> corners;
  const std::vector<Row> rows = OccupiedRows(map);
  Outline of_layer;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& [y, z, first_x, last_x] = rows[i];
    for (const int beyond : {0, 1}) {
      for (const int x : {first_x, last_x + 1}) of_layer.Add(Eigen::Vector3d(x, y + beyond, z));
    }
    if (i + 1 < rows.size() && rows[i + 1].z == z) continue;
    of_layer.Take([&](const Eigen::Vector3d& p) {
      corners.push_back(p);
      corners.push_back(p + Eigen::Vector3d::UnitZ());
    });
  }
  KeepOutlines(corners);
  const auto turn = [&] {
    for (Eigen::Vector3d& p : corners) std::swap(p.x(), p.z());
  };
  turn();
  KeepOutlines(corners);  // of each x
  turn();
  return corners;
}

}  // namespace clearway
