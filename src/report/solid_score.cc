#include "clearway/report/solid_score.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <variant>

#include "report/box_voxels.h"
#include "report/voxel_marks.h"

namespace clearway {
namespace {

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

VoxelMarks PredictedOf(const Compared& c, const Aabb& box_W) {
  const VoxelMap& map_O = c.object.map_O;
  const Solid& solid = *c.object.solid;
  const Pose T_O_W = Inverse(c.T_W_O);
  const bool filled = c.object.FillsSolid(c.mode);
  VoxelMarks marks(map_O.grid(), box_W);
  const auto* const hull = std::get_if<ConvexPolytope>(&solid.shape);
  if (filled && hull != nullptr) {
    marks.MarkHull(*hull->mesh, T_O_W);
  } else {
    marks.MarkIf([&](const Eigen::Vector3d& p_W) {
      const Eigen::Vector3d p_O = T_O_W * p_W;
      if (!solid.box_O.Contains(p_O)) return false;
      return filled ? Contains(solid.shape, p_O)
                    : map_O.State(map_O.grid().KeyOf(p_O)) == VoxelState::kOccupied;
    });
  }
  return marks;
}

// Each solid is looked through on its own, and beside each of its voxels for the other: they may be
// far apart.
SolidOverlap OverlapOf(const Compared& c) {
  const VoxelGrid& grid = c.object.map_O.grid();
  const Aabb predicted_box_W = Transformed(c.T_W_O, c.object.solid->box_O);
  Aabb seen_box_W, bodies_box_W;
  std::vector<Pose> T_B_W;
  for (std::size_t i = 0; i < c.bodies.size(); ++i) {
    seen_box_W.Extend(Transformed(c.T_W_B[i], c.bodies[i].seen_B->box_O));
    bodies_box_W.Extend(Transformed(c.T_W_B[i], c.bodies[i].body->BoxB()));
    T_B_W.push_back(Inverse(c.T_W_B[i]));
  }
  const Aabb beside_W = predicted_box_W.Padded(grid.resolution_m());
  if (!CanLookThrough(grid, beside_W)) return {};
  if (!bodies_box_W.Empty() && !CanLookThrough(grid, bodies_box_W)) return {};

  const auto in_any_body = [&](auto holds) {
    return [&, holds](const Eigen::Vector3d& p_W) {
      for (std::size_t i = 0; i < c.bodies.size(); ++i) {
        if ((c.bodies[i].*holds)(T_B_W[i] * p_W)) return true;
      }
      return false;
    };
  };
  const VoxelMarks predicted = PredictedOf(c, predicted_box_W);
  VoxelMarks truly(grid, bodies_box_W);
  VoxelMarks seen(grid, seen_box_W);
  truly.MarkIf(in_any_body(&SeenBody::Holds));
  seen.MarkIf(in_any_body(&SeenBody::HoldsSeen));
  SolidOverlap overlap;
  predicted.ForEachMarked([&](VoxelKey key) {
    ++overlap.predicted;
    overlap.predicted_right += truly.AtOrBeside(key);
  });
  seen.ForEachMarked([&](VoxelKey key) {
    ++overlap.seen;
    overlap.seen_found += predicted.AtOrBeside(key);
  });
  truly.ForEachMarked([&](VoxelKey key) {
    ++overlap.whole;
    overlap.whole_found += predicted.AtOrBeside(key);
  });
  return overlap;
}

}  // namespace

SolidOverlap& SolidOverlap::operator+=(const SolidOverlap& other) {
  predicted += other.predicted;
  predicted_right += other.predicted_right;
  seen += other.seen;
  seen_found += other.seen_found;
  whole += other.whole;
  whole_found += other.whole_found;
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
