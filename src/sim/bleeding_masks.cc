#include "clearway/sim/bleeding_masks.h"

#include <cmath>
#include <vector>

#include "absl/container/flat_hash_map.h"
#include "clearway/map/voxel_key.h"
#include "clearway/map/voxel_neighbours.h"

namespace clearway {
namespace {

struct Seen {
  Eigen::Vector3d direction_S;
  ObjectId label;
};

// The points of objects by where they are seen, in cells of the unit ball.
class ObjectDirections {
 public:
  explicit ObjectDirections(double reach) : cells_(reach), reach_(reach) {}

  void Add(const Eigen::Vector3d& direction_S, ObjectId label) {
    seen_[cells_.KeyOf(direction_S)].push_back({direction_S, label});
  }

  // The label of the nearest within reach; static if there is none.
  ObjectId Nearest(const Eigen::Vector3d& direction_S) const {
    ObjectId nearest = kStaticLabel;
    double best = reach_;
    for (const VoxelKey key : WithNeighbours(cells_.KeyOf(direction_S))) {
      const auto cell = seen_.find(key);
      if (cell == seen_.end()) continue;
      for (const Seen& seen : cell->second) {
        const double apart = (seen.direction_S - direction_S).norm();
        if (apart > best) continue;
        best = apart;
        nearest = seen.label;
      }
    }
    return nearest;
  }

 private:
  VoxelGrid cells_;
  double reach_;
  absl::flat_hash_map<VoxelKey, std::vector<Seen>> seen_;
};

}  // namespace

Frame WithBleedingMasks(Frame frame, double bleed_rad) {
  if (bleed_rad <= 0) return frame;
  const auto returned = [&](std::size_t i) {
    return (frame.no_return.empty() || frame.no_return[i] == 0) && frame.points_S[i].allFinite() &&
           !frame.points_S[i].isZero();
  };
  const auto direction_S = [&](std::size_t i) -> Eigen::Vector3d {
    return frame.points_S[i].cast<double>().normalized();
  };
  ObjectDirections objects(2 * std::sin(bleed_rad / 2));
  for (std::size_t i = 0; i < frame.labels.size(); ++i) {
    if (frame.labels[i] > kStaticLabel && returned(i)) objects.Add(direction_S(i), frame.labels[i]);
  }
  std::vector<ObjectId> told = frame.labels;
  for (std::size_t i = 0; i < told.size(); ++i) {
    if (told[i] == kStaticLabel && returned(i)) told[i] = objects.Nearest(direction_S(i));
  }
  frame.labels = std::move(told);
  return frame;
}

}  // namespace clearway
