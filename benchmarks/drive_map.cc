#include "drive_map.h"

#include <cmath>
#include <cstdlib>
#include <sstream>

#include "clearway/io/octomap_file.h"
#include "clearway/scene/scene_builder.h"
#include "recorded_scans.h"

namespace clearway::bench {
namespace {

constexpr double kResolution_m = 0.1, kRange_m = 50;
constexpr double kPeriod_s = 0.1;  // between frames
constexpr double kApart_m = 5;     // of objects in a crowd

// Of the square that a crowd is arranged in: objects along a side.
int SideOf(int count) { return static_cast<int>(std::ceil(std::sqrt(count))); }

ScenePtr Integrate(const std::vector<Frame>& scans) {
  ThreadPool pool(1);
  SceneParams params;
  params.resolution_m = kResolution_m;
  params.rays = {.max_range_m = kRange_m, .octomap_ends = true};
  SceneBuilder builder(params, {}, pool);
  for (const Frame& scan : scans) {
    if (!builder.Apply(scan).ok()) std::abort();
  }
  return builder.Publish();
}

using TreePtr = std::shared_ptr<octomap::OcTree>;

TreePtr InsertAll(const std::vector<Frame>& scans) {
  auto tree = std::make_shared<octomap::OcTree>(kResolution_m);
  for (const Frame& scan : scans) {
    octomap::Pointcloud cloud;
    for (const Eigen::Vector3f& p : PointsInWorld(scan)) cloud.push_back(p.x(), p.y(), p.z());
    const Eigen::Vector3f origin = scan.T_W_S.translation.cast<float>();
    tree->insertPointCloud(cloud, {origin.x(), origin.y(), origin.z()}, kRange_m);
  }
  tree->prune();
  return tree;
}

TreePtr ReadFrom(const VoxelMap& map) {
  const auto bytes = SerializeOctomap(map, OctomapFormat::kFull);
  if (!bytes.ok()) std::abort();
  std::istringstream stream(*bytes);
  TreePtr tree(dynamic_cast<octomap::OcTree*>(octomap::AbstractOcTree::read(stream)));
  if (tree == nullptr) std::abort();
  tree->prune();
  return tree;
}

}  // namespace

std::vector<Frame> FramesWithObjects(Time last, int count, const Eigen::Vector3d& center_W,
                                     int frames) {
  const int side = SideOf(count);
  std::vector<Frame> made;
  for (int k = 0; k < frames; ++k) {
    const double ahead_s = kPeriod_s * (k + 1 - frames);
    Frame& frame = made.emplace_back();
    frame.sequence = static_cast<std::uint64_t>(k + 1);
    frame.T_W_S.translation = center_W;
    frame.stamp = last + FromSeconds(ahead_s);
    for (int i = 0; i < count; ++i) {
      const Eigen::Vector3d velocity_W(std::cos(i), std::sin(i), 0);
      const Eigen::Vector3d middle_W =
          center_W + ahead_s * velocity_W +
          kApart_m * Eigen::Vector3d(i % side - side / 2, i / side - side / 2, 0);
      for (int corner = 0; corner < 8; ++corner) {
        const Eigen::Vector3d offset(corner & 1, corner >> 1 & 1, corner >> 2);
        frame.points_S.push_back((middle_W - center_W + 2 * offset).cast<float>());
        frame.labels.push_back(i + 1);
      }
      if (k == 0) continue;
      const Pose H_W{Eigen::Quaterniond::Identity(), kPeriod_s * velocity_W};
      frame.motions.push_back({i + 1, H_W, frame.stamp - FromSeconds(kPeriod_s)});
    }
  }
  return made;
}

Aabb CrowdBox(int count, const Eigen::Vector3d& center_W) {
  const double half_m = kApart_m / 2;
  const double low_m = -kApart_m * (SideOf(count) / 2) - half_m;
  const double high_m = low_m + kApart_m * SideOf(count);
  return {center_W + Eigen::Vector3d(low_m, low_m, -half_m),
          center_W + Eigen::Vector3d(high_m, high_m, half_m)};
}

ScenePtr WithObjects(const SceneSnapshot& scene, int count, const Eigen::Vector3d& center_W) {
  ThreadPool pool(1);
  SceneParams params = scene.params;
  params.rays.max_range_m = -1;
  SceneBuilder builder(params, {}, pool);
  for (const Frame& frame : FramesWithObjects(scene.stamp, count, center_W, 2)) {
    if (!builder.Apply(frame).ok()) std::abort();
  }
  auto with = std::make_shared<SceneSnapshot>(scene);
  with->objects = builder.Publish()->objects;
  if (with->objects.size() != static_cast<std::size_t>(count)) std::abort();
  return with;
}

DriveMap MakeDriveMap(std::size_t scans) {
  const std::vector<Frame> frames = WholeScans(scans);
  DriveMap drive;
  drive.scene = Integrate(frames);
  drive.read_tree = ReadFrom(drive.scene->static_map_W);  // first: into a heap without holes
  drive.tree = InsertAll(frames);
  const Eigen::Vector3d center_W = frames.front().T_W_S.translation;
  drive.box_W = drive.scene->static_map_W.ObservedBox();
  drive.box_W.min = drive.box_W.min.cwiseMax(center_W - Eigen::Vector3d(20, 20, 2.5));
  drive.box_W.max = drive.box_W.max.cwiseMin(center_W + Eigen::Vector3d(20, 20, 2.5));
  return drive;
}

}  // namespace clearway::bench
