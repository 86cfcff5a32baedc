#include <algorithm>
#include <bit>
#include <cmath>

#include "absl/container/inlined_vector.h"
#include "collision/body_contact.h"
#include "collision/cube_contact.h"
#include "collision/sweep.h"
#include "collision/voxel_contact.h"

namespace clearway {
namespace {

// Among voxels, from large cubes to small ones. To move the shape is to move the cubes the other
// way.
class Search {
 public:
  Search(const VoxelGrid& grid, const Sweep& sweep, double until)
      : grid_(grid),
        sweep_(sweep),
        contact_(sweep.shape_F, 0),
        directions_(contact_.Apart(Eigen::Vector3d::Zero(), 0).has_value()),
        length_m_(sweep.way_F.norm()),
        until_(until) {}

  // Before which share none of the block's voxels is touched; kNever if none is before what is
  // found so far.
  double BlockTouched(BlockKey block) { return CubeTouched(VoxelAt(block, 0), kBlockSize); }
  bool Misses(BlockKey block) { return BlockTouched(block) == kNever; }

  // Looks at the voxels that are marked.
  void Look(BlockKey block, const BlockMask& voxels) {
    const VoxelKey base = VoxelAt(block, 0);
    for (int octant = 0; octant < 8; ++octant) {
      const VoxelKey corner{base.x + kHalf * (octant & 1), base.y + kHalf * (octant >> 1 & 1),
                            base.z + kHalf * (octant >> 2)};
      LookAtOctant(block, octant, corner, voxels);
    }
  }

  const FirstTouch& found() const { return found_; }
  double until() const { return until_; }

 private:
  static constexpr int kHalf = kBlockSize / 2;

  void LookAtOctant(BlockKey block, int octant, VoxelKey corner, const BlockMask& voxels) {
    const std::uint64_t quarter = std::uint64_t{0x0f0f0f0f} << kHalf * (octant & 1)
                                                            << 32 * (octant >> 1 & 1);
    const int first_layer = kHalf * (octant >> 2);
    std::uint64_t any = 0;
    for (int z = first_layer; z < first_layer + kHalf; ++z) any |= voxels.words[z] & quarter;
    if (any == 0 || CubeTouched(corner, kHalf) == kNever) return;
    for (int z = first_layer; z < first_layer + kHalf; ++z) {
      for (std::uint64_t word = voxels.words[z] & quarter; word != 0; word &= word - 1) {
        LookAt(VoxelAt(block, z * 64 + std::countr_zero(word)));
      }
    }
  }

  double CubeTouched(VoxelKey corner, int edge) {
    const double half_m = 0.5 * edge * grid_.resolution_m();
    const Eigen::Vector3d center =
        grid_.resolution_m() * Eigen::Vector3d(corner.x, corner.y, corner.z) +
        Eigen::Vector3d::Constant(half_m);
    return Touched(center, half_m);
  }

  // A direction, and how far the shape reaches along it where it begins, its spread included.
  struct Reach {
    Eigen::Vector3d direction;
    double reach_m;
  };

  // Along which of the axes about which the shape turns, where the turn moves nothing, the cube is
  // farthest beyond the shape.
  Separation ApartAlongAxes(const Eigen::Vector3d& center, double half_m) {
    if (along_axes_.empty()) AddAxes();
    Separation best;
    for (const auto& [direction, reach_m] : along_axes_) {
      const double gap_m = direction.dot(center) - half_m * direction.cwiseAbs().sum() - reach_m;
      if (gap_m - kRounding_m > best.gap_m) best = {direction, gap_m - kRounding_m};
    }
    return best;
  }

  // Both ways.
  void AddAxes() {
    const PlacedShape& shape = sweep_.shape_F;
    for (const auto& [axis, radius_m] : sweep_.spread_F.discs()) {
      for (const Eigen::Vector3d& direction : {axis, Eigen::Vector3d(-axis)}) {
        along_axes_.push_back({direction, direction.dot(shape.FarthestOfCore(direction)) +
                                              shape.geometry().core_radius_m() +
                                              sweep_.spread_F.Along(direction)});
      }
    }
  }

  // Less what the shape spreads, with `left` of its way to go.
  Separation Apart(const Eigen::Vector3d& center, double half_m, double left) {
    Separation apart = *contact_.Apart(center, half_m);
    if (sweep_.spread_F.empty()) return apart;
    const double far_m = apart.gap_m - sweep_.spread_F.radius_m();  // however it spreads
    const double used_m = std::max(0.0, left * apart.direction.dot(sweep_.way_F));
    if (far_m - sweep_.margin_m - kKept_m > used_m) {
      apart.gap_m = far_m;
      return apart;
    }
    apart.gap_m -= sweep_.spread_F.Along(apart.direction);
    if (apart.gap_m - sweep_.margin_m > kTouching_m) return apart;
    const Separation along = ApartAlongAxes(center, half_m);
    return along.gap_m > apart.gap_m ? along : apart;
  }

  // By what is quick.
  double Touched(const Eigen::Vector3d& center, double half_m) {
    if (directions_) {
      return AdvanceAlong(sweep_.way_F, sweep_.margin_m, 0, until_, [&](double share) {
        return Apart(center - share * sweep_.way_F, half_m, until_ - share);
      });
    }
    if (!sweep_.spread_F.empty()) {
      const Separation along = ApartAlongAxes(center, half_m);
      const double used_m = std::max(0.0, until_ * along.direction.dot(sweep_.way_F));
      if (along.gap_m - sweep_.margin_m - kKept_m > used_m) return kNever;
    }
    return Advance(length_m_, 0, until_, [&](double share) {
      return contact_.DistanceTo(center - share * sweep_.way_F, half_m).least_m -
             sweep_.LargestMargin();
    });
  }

  void LookAt(VoxelKey key) {
    double share = Touched(grid_.CenterOf(key), 0.5 * grid_.resolution_m());
    if (share == kNever) return;
    const Aabb cube = grid_.BoxOf(key);
    const auto farthest = [&](const Eigen::Vector3d& direction) -> Eigen::Vector3d {
      return (direction.array() > 0).select(cube.max, cube.min);
    };
    share = FirstTouchOf(sweep_, {farthest, cube.Center()}, 0, share, until_);
    if (share == kNever) return;
    // What is hardly nearer is no news.
    const double earlier = sweep_.tolerance_m < length_m_ ? sweep_.tolerance_m / length_m_ : 1;
    found_ = {std::max(0.0, share - earlier), key};
    until_ = std::nextafter(found_.share, -1.0);
  }

  static constexpr double kRounding_m = 1e-9;

  const VoxelGrid& grid_;
  const Sweep& sweep_;
  CubeContact contact_;  // without the margin
  absl::InlinedVector<Reach, 4> along_axes_;
  bool directions_;  // are known for cubes
  double length_m_;
  double until_;
  FirstTouch found_;
};

}  // namespace

// The blocks that may be touched first come first: then most others cannot be touched before.
FirstTouch TouchOccupied(const VoxelMap& map_F, const Sweep& sweep, double until) {
  struct Candidate {
    double share;
    BlockKey key;
    const VoxelBlock* block;
  };
  KeyRange keys;
  if (!KeysTouching(map_F.grid(), sweep.Box(), keys)) return {};
  if (sweep.AtRest() && !TouchesOccupied(map_F, sweep.shape_F, sweep.margin_m + kContact_m)) {
    return {};
  }
  Search search(map_F.grid(), sweep, until);
  absl::InlinedVector<Candidate, 64> candidates;
  map_F.blocks().AnyOccupiedIn(BlockOf(keys.min), BlockOf(keys.max),
                               [&](BlockKey key, const VoxelBlock& block) {
                                 const double share = search.BlockTouched(key);
                                 if (share != kNever) candidates.push_back({share, key, &block});
                                 return false;
                               });
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.share < b.share; });
  for (const auto& [share, key, block] : candidates) {
    if (share > search.until()) break;
    search.Look(key, RangeInBlock(key, keys).Of(block->occupied));
  }
  return search.found();
}

FirstTouch TouchUnobserved(const VoxelMap& map_F, const std::vector<Aabb>& known_free_F,
                           const Sweep& sweep, double until, const Cancelled& cancelled) {
  KeyRange keys;
  if (!KeysTouching(map_F.grid(), sweep.Box(), keys)) return {};
  if (sweep.AtRest() && !TouchesUnobserved(map_F, sweep.shape_F, known_free_F,
                                           sweep.margin_m + kContact_m, cancelled)) {
    return {};
  }
  Search search(map_F.grid(), sweep, until);
  constexpr int kBlocksToAsk = 64;  // to ask takes as long as to look
  std::int64_t blocks = 0;
  AnyBlock(map_F.blocks(), BlockOf(keys.min), BlockOf(keys.max),
           [&](BlockKey key, const VoxelBlock* block) {
             const bool ask = ++blocks % kBlocksToAsk == 0;
             if (search.until() < 0 || (ask && cancelled())) return true;
             BlockMask voxels = RangeInBlock(key, keys).All();
             if (block != nullptr) voxels.Subtract(block->observed);
             if (!voxels.Any() || search.Misses(key)) return false;
             if (!known_free_F.empty()) {
               const BlockMask candidates = voxels;
               candidates.ForEach([&](int index) {
                 const Eigen::Vector3d center = map_F.grid().CenterOf(VoxelAt(key, index));
                 if (InOneOf(known_free_F, center)) voxels.Clear(index);
               });
             }
             search.Look(key, voxels);
             return false;
           });
  return search.found();
}

}  // namespace clearway
