#include "clearway/report/static_fit.h"

#include <algorithm>
#include <vector>

#include "clearway/geometry/distance.h"
#include "clearway/map/voxel_neighbours.h"

namespace clearway {
namespace {

struct Placed {
  const Shape* shape;
  Pose T_G_W;
  Aabb box_W;
};

std::vector<Placed> StaticParts(const World& world) {
  std::vector<Placed> placed;
  for (const Body& body : world.bodies()) {
    if (body.id != kStaticLabel) continue;
    const Pose T_W_B = PoseAt(body.trajectory, Time());  // whenever
    for (const BodyPart& part : body.parts) {
      const Pose T_W_G = T_W_B * part.T_B_G;
      placed.push_back({&part.shape, Inverse(T_W_G), Transformed(T_W_G, BoundingBox(part.shape))});
    }
  }
  return placed;
}

// The static bodies near a place.
class Surroundings {
 public:
  Surroundings(const std::vector<Placed>& all, const Aabb& box_W) {
    for (const Placed& placed : all) {
      if (placed.box_W.Intersects(box_W)) near_.push_back(&placed);
    }
  }

  bool Hold(const Eigen::Vector3d& p_W) const {
    return std::ranges::any_of(
        near_, [&](const Placed* placed) { return Contains(*placed->shape, placed->T_G_W * p_W); });
  }
  bool HoldWithin(const Eigen::Vector3d& p_W, double distance_m) const {
    return std::ranges::any_of(near_, [&](const Placed* placed) {
      return PointShapeDistance(placed->T_G_W * p_W, *placed->shape) <= distance_m;
    });
  }
  // Of a point inside: whether every body that holds it does so no deeper.
  bool EndWithin(const Eigen::Vector3d& p_W, double distance_m) const {
    return std::ranges::all_of(near_, [&](const Placed* placed) {
      const Eigen::Vector3d p_G = placed->T_G_W * p_W;
      return !Contains(*placed->shape, p_G) || SurfaceDistance(p_G, *placed->shape) <= distance_m;
    });
  }

 private:
  std::vector<const Placed*> near_;
};

Confusion::Said SaidOf(VoxelState state) {
  switch (state) {
    case VoxelState::kFree:
      return Confusion::kFree;
    case VoxelState::kOccupied:
      return Confusion::kOccupied;
    case VoxelState::kUnknown:
      break;
  }
  return Confusion::kUnknown;
}

// Every fourth voxel along each axis of a block.
void CountGrid(const VoxelMap& map_W, BlockKey block_key, const Surroundings& around,
               Confusion::Counts& truly_free) {
  for (int index = 0; index < kBlockSize * kBlockSize * kBlockSize; ++index) {
    const VoxelKey key = VoxelAt(block_key, index);
    if ((key.x | key.y | key.z) % 4 != 0) continue;
    if (around.Hold(map_W.grid().CenterOf(key))) continue;
    ++truly_free[SaidOf(map_W.State(key))];
  }
}

}  // namespace

StaticFit FitOf(const VoxelMap& map_W, const World& world, const MetSurfaces& met) {
  const std::vector<Placed> parts = StaticParts(world);
  const VoxelGrid& grid = map_W.grid();
  const double voxel_m = grid.resolution_m();
  StaticFit fit;
  map_W.blocks().ForEach([&](BlockKey block_key, const VoxelBlock& block) {
    Aabb box_W = grid.BoxOf(VoxelAt(block_key, 0));
    box_W.Extend(grid.BoxOf(VoxelAt(block_key, kBlockSize * kBlockSize * kBlockSize - 1)));
    const Surroundings around(parts, box_W.Padded(voxel_m));
    CountGrid(map_W, block_key, around, fit.grid.truly_free);
    block.observed.ForEach([&](int index) {
      const VoxelKey key = VoxelAt(block_key, index);
      const Eigen::Vector3d center_W = grid.CenterOf(key);
      const bool occupied = block.occupied.Test(index), inside = around.Hold(center_W);
      if (occupied) {
        ++fit.occupied;
        fit.occupied_right += inside || around.HoldWithin(center_W, voxel_m);
      } else {
        ++fit.free;
        fit.free_right += !inside || around.EndWithin(center_W, voxel_m);
      }
      if (inside) return;
      ++fit.truly_free;
      fit.free_found += !occupied || AtOrBeside(map_W, key, VoxelState::kFree);
    });
  });
  for (const auto& [key, p_W] : met.Of(kStaticLabel)) {
    ++fit.met;
    fit.met_found += AtOrBeside(map_W, key, VoxelState::kOccupied);
    ++fit.grid.truly_occupied[SaidOf(map_W.State(key))];
  }
  return fit;
}

}  // namespace clearway
