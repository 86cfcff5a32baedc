#include "collision/center_masks.h"

#include <algorithm>
#include <cmath>

#include "absl/container/inlined_vector.h"
#include "collision/advance.h"
#include "collision/prepared_mesh.h"

namespace clearway {
namespace {

constexpr double kRounding_m = 1e-9;

// The points p with normal . p <= most.
struct HalfSpace {
  Eigen::Vector3d normal;
  double most;
};

// A convex body, as what its half spaces have in common.
class Polytope {
 public:
  void Add(const Eigen::Vector3d& normal, double most) { faces_.push_back({normal, most}); }

  // What it holds of the line along x through a point: from the first to the second coordinate,
  // which is less if that is nothing.
  std::pair<double, double> AlongX(double y, double z) const {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    double low = -kFar, high = kFar;
    for (const auto& [normal, most] : faces_) {
      const double left = most - normal.y() * y - normal.z() * z;
      if (normal.x() > 0) {
        high = std::min(high, left / normal.x());
      } else if (normal.x() < 0) {
        low = std::max(low, left / normal.x());
      } else if (left < 0) {
        return {kFar, -kFar};
      }
    }
    return {low, high};
  }

 private:
  absl::InlinedVector<HalfSpace, 12> faces_;
};

// All that a box grown by margin_m meets on its way: its own faces, and those that its edges sweep.
Polytope MayBeIn(const TurnedBox& box, const Eigen::Vector3d& way, double margin_m) {
  Polytope polytope;
  const auto add = [&](const Eigen::Vector3d& normal) {
    const double half = (box.R_F_G.transpose() * normal).cwiseAbs().dot(box.half_m);
    for (const double sign : {-1.0, 1.0}) {
      const Eigen::Vector3d outward = sign * normal;
      const double farthest = outward.dot(box.origin_F) + half + std::max(0.0, outward.dot(way));
      polytope.Add(outward, farthest + margin_m * normal.norm());
    }
  };
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d along = box.R_F_G.col(axis), across = way.cross(along);
    add(along);
    if (across.squaredNorm() > 1e-12 * way.squaredNorm()) add(across.normalized());
  }
  return polytope;
}

// What a box less margin_m holds all along its way.
Polytope SurelyIn(const TurnedBox& box, const Eigen::Vector3d& way, double margin_m) {
  Polytope polytope;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      const Eigen::Vector3d outward = sign * box.R_F_G.col(axis);
      const double farthest =
          outward.dot(box.origin_F) + box.half_m[axis] + std::min(0.0, outward.dot(way));
      polytope.Add(outward, farthest - margin_m);
    }
  }
  return polytope;
}

std::uint64_t BitsOf(std::int32_t first, std::int32_t last, std::int32_t base) {
  const int from = std::max(first - base, 0), to = std::min(last - base, kBlockSize - 1);
  return from > to ? 0 : (0xffu >> (kBlockSize - 1 - to)) & (0xffu << from);
}

}  // namespace

CenterMasks::CenterMasks(const VoxelGrid& grid, const Sweep& sweep)
    : grid_(grid), sweep_(sweep), contact_(sweep.shape_F, 0) {
  KeyRange keys;
  if (!KeysTouching(grid, sweep.Box(), keys)) return;
  keys_ = keys;
  if (const auto box = sweep.shape_F.AsBox()) MakeRows(*box);
}

void CenterMasks::MakeRows(const TurnedBox& box) {
  const Polytope perhaps = MayBeIn(box, sweep_.way_F, sweep_.LargestMargin() + kRounding_m);
  const Polytope surely = SurelyIn(box, sweep_.way_F, sweep_.LargestMargin() + kRounding_m);
  const double per_m = 1 / grid_.resolution_m(), first_x = grid_.CenterOf(keys_->min).x();
  const double most = keys_->max.x - keys_->min.x;
  // Of keys from the lowest one on.
  const auto first = [&](double low) {
    return static_cast<std::int32_t>(std::clamp(std::ceil((low - first_x) * per_m), 0.0, most + 1));
  };
  const auto last = [&](double high) {
    return static_cast<std::int32_t>(std::clamp(std::floor((high - first_x) * per_m), -1.0, most));
  };
  for (VoxelKey key = keys_->min; key.y <= keys_->max.y; ++key.y) {
    for (key.z = keys_->min.z; key.z <= keys_->max.z; ++key.z) {
      const Eigen::Vector3d center = grid_.CenterOf(key);
      const auto [low, high] = perhaps.AlongX(center.y(), center.z());
      const auto [low_surely, high_surely] = surely.AlongX(center.y(), center.z());
      rows_.push_back({key.x + first(low), key.x + last(high), key.x + first(low_surely),
                       key.x + last(high_surely)});
    }
  }
}

bool CenterMasks::Near(BlockKey block) const {
  if (!keys_) return false;
  const BlockKey from = first(), to = last();
  return block.x >= from.x && block.x <= to.x && block.y >= from.y && block.y <= to.y &&
         block.z >= from.z && block.z <= to.z;
}

void CenterMasks::AddTo(BlockKey block, Masks& masks) const {
  if (!rows_.empty()) return AddRows(block, masks);
  RangeInBlock(block, *keys_).All().ForEach([&](int index) {
    const Eigen::Vector3d center_W = grid_.CenterOf(VoxelAt(block, index));
    if (!Perhaps(center_W)) return;
    masks.perhaps.Set(index);
    if (Surely(center_W)) masks.surely.Set(index);
  });
}

void CenterMasks::AddRows(BlockKey block, Masks& masks) const {
  const VoxelKey base = VoxelAt(block, 0), &min = keys_->min, &max = keys_->max;
  const std::int32_t layers = max.z - min.z + 1;
  const std::int32_t last_y = std::min(max.y, base.y + kBlockSize - 1);
  const std::int32_t last_z = std::min(max.z, base.z + kBlockSize - 1);
  for (std::int32_t y = std::max(min.y, base.y); y <= last_y; ++y) {
    for (std::int32_t z = std::max(min.z, base.z); z <= last_z; ++z) {
      const Row& row = rows_[static_cast<std::size_t>(y - min.y) * layers + (z - min.z)];
      const int shift = kBlockSize * (y - base.y);
      masks.perhaps.words[z - base.z] |= BitsOf(row.first_perhaps, row.last_perhaps, base.x)
                                         << shift;
      masks.surely.words[z - base.z] |= BitsOf(row.first_surely, row.last_surely, base.x) << shift;
    }
  }
}

// By directions if they are known, else as if the shape were grown by all of its way.
bool CenterMasks::Perhaps(const Eigen::Vector3d& center_W) const {
  const PlacedShape& shape_W = sweep_.shape_F;
  const Eigen::Vector3d& way_W = sweep_.way_F;
  const double margin_m = sweep_.LargestMargin();
  if (contact_.Apart(center_W, 0)) {
    const double share = AdvanceAlong(way_W, margin_m, 0, 1, [&](double at) {
      return *contact_.Apart(center_W - at * way_W, 0);
    });
    return share != kNever;
  }
  const Eigen::Vector3d middle_W = center_W - 0.5 * way_W;
  const double reach_m = margin_m + 0.5 * way_W.norm() + kRounding_m;
  if (const PreparedMesh* mesh = shape_W.AsMesh()) {
    return mesh->SideOf(shape_W.ToG(middle_W), reach_m).value_or(true);
  }
  return shape_W.DistanceToBall(middle_W, 0, reach_m) <= reach_m;
}

// A convex shape that holds a ball at both ends does so in between.
bool CenterMasks::Surely(const Eigen::Vector3d& center_W) const {
  const PlacedShape& shape_W = sweep_.shape_F;
  const Eigen::Vector3d& way_W = sweep_.way_F;
  const double margin_m = sweep_.LargestMargin();
  const double radius_m = margin_m + kRounding_m;
  if (!shape_W.geometry().convex()) {
    return shape_W.Holds(center_W - 0.5 * way_W, radius_m + 0.5 * way_W.norm());
  }
  return shape_W.Holds(center_W, radius_m) && shape_W.Holds(center_W - way_W, radius_m);
}

}  // namespace clearway
