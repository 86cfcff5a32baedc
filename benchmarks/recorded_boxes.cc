#include "recorded_boxes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <ranges>
#include <span>
#include <utility>

#include "box_corners.h"
#include "clearway/geometry/hull.h"

namespace clearway::bench {
namespace {

Frame FrameOf(const LidarFolder& folder, std::size_t index) {
  Frame frame;
  frame.sensor_id = "tracks";
  frame.sequence = index;
  frame.stamp = folder.poses[index].stamp;
  if (index == 0) return frame;
  const int number = static_cast<int>(index);
  for (const RecordedBox& box : BoxesOf(folder, number)) {
    for (const RecordedBox& before : BoxesOf(folder, number - 1)) {
      if (before.id != box.id) continue;
      frame.motions.push_back(
          {box.id, box.T_W_B * Inverse(before.T_W_B), folder.poses[index - 1].stamp});
    }
  }
  return frame;
}

}  // namespace

LidarFolder FolderOf(const std::vector<cli::Track>& tracks, const std::string& type) {
  std::map<std::int64_t, std::vector<RecordedBox>> boxes_at;  // by milliseconds
  ObjectId id = 0;
  for (const cli::Track& track : tracks) {
    ++id;
    if (!track.moves) continue;
    Aabb box_O;
    for (const Eigen::Vector3d& vertex : HullAround(track.shape).vertices) box_O.Extend(vertex);
    for (const cli::Sighting& seen : track.seen) {
      boxes_at[std::llround(1000 * seen.t_s)].push_back(
          {0, id, type, box_O.Size(), seen.T_W_O, -1});
    }
  }
  auto folder = std::make_shared<LidarFolder>();
  for (auto& [at_ms, boxes] : boxes_at) {
    const int frame = static_cast<int>(folder->poses.size());
    folder->poses.push_back({frame, Time(std::chrono::milliseconds(at_ms)), Pose{}});
    for (RecordedBox& box : boxes) {
      box.frame = frame;
      folder->boxes.push_back(std::move(box));
    }
  }
  LidarFolder result = *folder;
  result.frames.description = type;
  result.frames.frame_count = folder->poses.size();
  result.frames.read = [folder](std::size_t index) { return FrameOf(*folder, index); };
  return result;
}

}  // namespace clearway::bench
