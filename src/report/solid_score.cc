#include "clearway/report/solid_score.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace clearway {
namespace {

// Marks of the voxels of a box in W.
class VoxelMarks {
 public:
  VoxelMarks(const VoxelGrid& grid, const Aabb& box_W)
      : grid_(grid), min_(grid.KeyOf(box_W.min)), max_(grid.KeyOf(box_W.max)) {
    marks_.resize(Extent(min_.x, max_.x) * Extent(min_.y, max_.y) * Extent(min_.z, max_.z));
  }

  // By where their centre is.
  template <class Holds>
  void MarkIf(Holds&& holds) {
    ForEach([&](VoxelKey key) { marks_[IndexOf(key)] = holds(grid_.CenterOf(key)); });
  }
  bool At(VoxelKey key) const { return marks_[IndexOf(key)]; }
  bool AtOrBeside(VoxelKey key) const {
    for (int neighbor = 0; neighbor < 27; ++neighbor) {
      const VoxelKey beside{key.x + neighbor % 3 - 1, key.y + neighbor / 3 % 3 - 1,
                            key.z + neighbor / 9 - 1};
      if (Holds(beside) && At(beside)) return true;
    }
    return false;
  }
  template <class Visit>
  void ForEach(Visit&& visit) const {
    for (VoxelKey key = min_; key.z <= max_.z; ++key.z) {
      for (key.y = min_.y; key.y <= max_.y; ++key.y) {
        for (key.x = min_.x; key.x <= max_.x; ++key.x) visit(key);
      }
    }
  }

 private:
  static std::size_t Extent(std::int32_t from, std::int32_t to) { return to - from + 1; }
  std::size_t IndexOf(VoxelKey key) const {
    return ((key.z - min_.z) * Extent(min_.y, max_.y) + (key.y - min_.y)) * Extent(min_.x, max_.x) +
           (key.x - min_.x);
  }
  bool Holds(VoxelKey key) const {
    return key.x >= min_.x && key.x <= max_.x && key.y >= min_.y && key.y <= max_.y &&
           key.z >= min_.z && key.z <= max_.z;
  }

  VoxelGrid grid_;
  VoxelKey min_, max_;
  std::vector<char> marks_;
};

bool BodyHolds(const Body& body, const Eigen::Vector3d& p_B) {
  return std::ranges::any_of(body.parts, [&](const BodyPart& part) {
    return Contains(part.shape, Inverse(part.T_B_G) * p_B);
  });
}

std::shared_ptr<const Solid> HullOf(const MetSurfaces::Pieces& pieces_B, double voxel_m) {
  VoxelMap map_B(voxel_m);
  for (const auto& [key, p_B] : pieces_B) map_B.Set(key, map_B.model().clamp_max);
  return SolidOf(map_B);
}

// A body, and what of it was seen.
struct SeenBody {
  const Body* body;
  std::shared_ptr<const Solid> seen_B;

  bool Holds(const Eigen::Vector3d& p_B) const { return BodyHolds(*body, p_B); }
  bool HoldsSeen(const Eigen::Vector3d& p_B) const {
    return seen_B->box_O.Contains(p_B) && Contains(seen_B->shape, p_B) && Holds(p_B);
  }
};

// What is compared at one time.
struct Compared {
  const MovingObject& object;
  SolidMode mode;
  Pose T_W_O;  // as predicted
  const std::vector<SeenBody>& bodies;
  std::vector<Pose> T_W_B;  // of these, in truth
};

SolidOverlap OverlapOf(const Compared& c) {
  const VoxelMap& map_O = c.object.map_O;
  Aabb box_W = Transformed(c.T_W_O, c.object.solid->box_O);
  std::vector<Pose> T_B_W;
  for (std::size_t i = 0; i < c.bodies.size(); ++i) {
    box_W.Extend(Transformed(c.T_W_B[i], c.bodies[i].body->BoxB()));
    T_B_W.push_back(Inverse(c.T_W_B[i]));
  }
  const auto any_body = [&](const Eigen::Vector3d& p_W, auto holds) {
    for (std::size_t i = 0; i < c.bodies.size(); ++i) {
      if ((c.bodies[i].*holds)(T_B_W[i] * p_W)) return true;
    }
    return false;
  };
  VoxelMarks predicted(map_O.grid(), box_W), truly = predicted, seen = predicted;
  const Pose T_O_W = Inverse(c.T_W_O);
  const bool filled = c.object.FillsSolid(c.mode);
  predicted.MarkIf([&](const Eigen::Vector3d& p_W) {
    const Eigen::Vector3d p_O = T_O_W * p_W;
    if (!c.object.solid->box_O.Contains(p_O)) return false;
    return filled ? Contains(c.object.solid->shape, p_O)
                  : map_O.State(map_O.grid().KeyOf(p_O)) == VoxelState::kOccupied;
  });
  truly.MarkIf([&](const Eigen::Vector3d& p_W) { return any_body(p_W, &SeenBody::Holds); });
  seen.MarkIf([&](const Eigen::Vector3d& p_W) { return any_body(p_W, &SeenBody::HoldsSeen); });
  SolidOverlap overlap;
  predicted.ForEach([&](VoxelKey key) {
    overlap.predicted += predicted.At(key);
    overlap.predicted_right += predicted.At(key) && truly.AtOrBeside(key);
    overlap.seen += seen.At(key);
    overlap.seen_found += seen.At(key) && predicted.AtOrBeside(key);
  });
  return overlap;
}

}  // namespace

SolidOverlap& SolidOverlap::operator+=(const SolidOverlap& other) {
  predicted += other.predicted;
  predicted_right += other.predicted_right;
  seen += other.seen;
  seen_found += other.seen_found;
  return *this;
}

SolidScore::SolidScore(TrueBodies bodies, Time end, std::vector<Duration> ahead)
    : bodies_(std::move(bodies)), end_(end), ahead_(std::move(ahead)) {}

void SolidScore::Add(const SceneSnapshot& scene, const MetSurfaces& met) {
  for (const auto& object : scene.objects) {
    const Body* const body = bodies_.Find(object->id);
    if (body == nullptr || object->last_seen != scene.stamp) continue;
    auto& overlaps = overlaps_.try_emplace(object->id, ahead_.size()).first->second;
    const double voxel_m = object->map_O.grid().resolution_m();
    std::vector<SeenBody> bodies = {{body, HullOf(met.Of(body->id), voxel_m)}};
    for (const Body* part : bodies_.PartsOf(body->id)) {
      if (scene.FindObject(part->id) != nullptr || met.Of(part->id).empty()) continue;
      bodies.push_back({part, HullOf(met.Of(part->id), voxel_m)});
    }
    for (std::size_t i = 0; i < ahead_.size(); ++i) {
      const Time then = scene.stamp + ahead_[i];
      if (then > end_) continue;
      std::vector<Pose> T_W_B;
      for (const SeenBody& b : bodies) {
        if (const auto T = bodies_.T_W_B(b.body->id, then)) T_W_B.push_back(*T);
      }
      if (T_W_B.size() < bodies.size()) continue;
      const Pose T_W_O = PredictPose(*object, then, scene.params.horizon).T_W_O;
      overlaps[i] += OverlapOf({*object, scene.params.solid, T_W_O, bodies, std::move(T_W_B)});
    }
  }
}

}  // namespace clearway
