#include "clearway/report/truth.h"

#include <algorithm>
#include <map>
#include <utility>

namespace clearway {
namespace {

// Boxes of one object, by time.
using Track = std::map<Time, RecordedBox>;

// Two boxes further apart in time are two visits, with nothing known in between.
constexpr Duration kLongestGap = std::chrono::milliseconds(550);

std::optional<TrueBox> BoxAt(const Track& track, Time t) {
  const auto after = track.lower_bound(t);
  if (after == track.end()) return std::nullopt;
  const RecordedBox& b = after->second;
  if (after->first == t) return TrueBox{b.id, b.size_m, b.T_W_B};
  if (after == track.begin()) return std::nullopt;
  const auto before = std::prev(after);
  const Duration gap = after->first - before->first;
  if (gap > kLongestGap) return std::nullopt;
  const double fraction = ToSeconds(t - before->first) / ToSeconds(gap);
  return TrueBox{b.id, b.size_m, Interpolate(before->second.T_W_B, b.T_W_B, fraction)};
}

}  // namespace

Truth TruthOf(std::shared_ptr<const World> world, Time end) {
  Truth truth;
  truth.description = "the simulated world";
  truth.end = end;
  truth.boxes = [world](Time t) {
    std::vector<TrueBox> boxes;
    for (const ObjectId id : world->ObjectIds()) {
      const Aabb box_B = world->FindObject(id)->BoxB();
      const Eigen::Vector3d center_B = box_B.Center();
      boxes.push_back(
          {id, box_B.Size(),
           *world->T_W_B(id, t) * Pose::Translation(center_B.x(), center_B.y(), center_B.z())});
    }
    return boxes;
  };
  truth.touched = [world](const Shape& shape, const Pose& T_W_G, Time t) {
    return world->Touched(shape, T_W_G, t);
  };
  return truth;
}

Truth TruthOf(const LidarFolder& folder) {
  std::map<int, Time> stamps;
  for (const RecordedPose& pose : folder.poses) stamps[pose.frame] = pose.stamp;
  auto tracks = std::make_shared<std::map<ObjectId, Track>>();
  for (const RecordedBox& box : folder.boxes) {
    const auto stamp = stamps.find(box.frame);
    if (stamp != stamps.end()) (*tracks)[box.id].emplace(stamp->second, box);
  }
  Truth truth;
  truth.description = "the recorded boxes";
  truth.end = folder.poses.empty() ? Time{} : folder.poses.back().stamp;
  for (const RecordedPose& pose : folder.poses) truth.told.push_back(pose.stamp);
  truth.boxes = [tracks](Time t) {
    std::vector<TrueBox> boxes;
    for (const auto& [id, track] : *tracks) {
      if (const auto box = BoxAt(track, t)) boxes.push_back(*box);
    }
    return boxes;
  };
  truth.touched = [boxes = truth.boxes](const Shape& shape, const Pose& T_W_G, Time t) {
    World world;
    for (const TrueBox& box : boxes(t)) {
      world.Add(Body::Single(box.id, "", Box{box.size_m}, FixedPose{box.T_W_B}));
    }
    return WorldAtTime(world, t).Touched(shape, T_W_G);
  };
  return truth;
}

Truth CarriedBy(WorldCorrections corrections, Truth truth_V) {
  const auto shared = std::make_shared<const WorldCorrections>(std::move(corrections));
  Truth truth = truth_V;
  truth.boxes = [shared, boxes_V = truth_V.boxes](Time t) {
    std::vector<TrueBox> boxes = boxes_V(t);
    for (TrueBox& box : boxes) box.T_W_B = Carried(*shared, t, box.T_W_B);
    return boxes;
  };
  truth.touched = [shared, touched_V = truth_V.touched](const Shape& shape, const Pose& T_W_G,
                                                        Time t) {
    return touched_V(shape, Inverse(shared->At(t)) * T_W_G, t);
  };
  return truth;
}

std::optional<TrueBox> BoxOf(const Truth& truth, ObjectId id, Time t) {
  for (const TrueBox& box : truth.boxes(t)) {
    if (box.id == id) return box;
  }
  return std::nullopt;
}

std::vector<TopViewOutline> OutlinesAt(const Truth& truth, Time t) {
  std::vector<TopViewOutline> outlines;
  for (const TrueBox& box : truth.boxes(t)) {
    TopViewOutline& outline = outlines.emplace_back(TopViewOutline{t, {}});
    for (const auto& [x, y] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}) {
      const Eigen::Vector3d corner_B(0.5 * x * box.size_m.x(), 0.5 * y * box.size_m.y(), 0);
      outline.polygon_W.push_back((box.T_W_B * corner_B).head<2>());
    }
  }
  return outlines;
}

}  // namespace clearway
