#include "clearway/scene/object_index.h"

#include <algorithm>

namespace clearway {
namespace {

double FarthestCorner_m(const Aabb& box_O) {
  if (box_O.Empty()) return 0;
  return box_O.min.cwiseAbs().cwiseMax(box_O.max.cwiseAbs()).norm();
}

// A box round the origin's way through the poses: from each to the next along a screw, on which no
// point is farther from both ends than half of its length.
Aabb OriginsOf(const std::vector<StampedPose>& history) {
  Aabb way_W{history[0].T_W_O.translation, history[0].T_W_O.translation};
  for (std::size_t i = 1; i < history.size(); ++i) {
    const Pose &from = history[i - 1].T_W_O, &to = history[i].T_W_O;
    Aabb ends_W{from.translation, from.translation};
    ends_W.Extend(to.translation);
    way_W.Extend(ends_W.Padded(0.5 * Log(Inverse(from) * to).linear.norm()));
  }
  return way_W;
}

// A box round everything of the object from `first` to `last`. From t_k on the origin moves at a
// constant speed along a screw, before t_k between the poses of the history.
Aabb ReachOf(const MovingObject& object, Time first, Time last, double inflation_mps) {
  constexpr double kRounding_m = 1e-6;
  const double radius_m = std::max({FarthestCorner_m(object.observed_box_O),
                                    FarthestCorner_m(object.solid->box_O), object.solid->radius_m});
  const StampedPose& newest = object.history.back();
  Aabb origins_W{newest.T_W_O.translation, newest.T_W_O.translation};
  if (first < newest.stamp) origins_W.Extend(OriginsOf(object.history));
  const double ahead_s = std::max(0.0, ToSeconds(last - newest.stamp));
  return origins_W.Padded(radius_m + kRounding_m + ahead_s * (object.SpeedMps() + inflation_mps));
}

}  // namespace

ObjectIndex::ObjectIndex(const SceneSnapshot& scene, Time first, Time last, double inflation_mps)
    : words_((scene.objects.size() + 63) / 64) {
  std::vector<Aabb> reaches_W;
  for (const auto& object : scene.objects) {
    reaches_W.push_back(ReachOf(*object, first, last, inflation_mps));
    box_W_.Extend(reaches_W.back());
  }
  if (reaches_W.empty()) return;
  low_ = box_W_.min;
  cells_per_m_ = kCells * (box_W_.max - box_W_.min).cwiseMax(1e-3).cwiseInverse();
  for (int axis = 0; axis < 3; ++axis) {
    cells_[axis].assign(kCells * words_, 0);
    for (std::size_t i = 0; i < reaches_W.size(); ++i) {
      const int to = CellOf(axis, reaches_W[i].max[axis]);
      for (int cell = CellOf(axis, reaches_W[i].min[axis]); cell <= to; ++cell) {
        cells_[axis][cell * words_ + i / 64] |= std::uint64_t{1} << i % 64;
      }
    }
  }
}

}  // namespace clearway
