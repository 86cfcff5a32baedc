#include "recorded_scans.h"

#include <cstdio>
#include <cstdlib>

#include "clearway/io/lidar_folder.h"
#include "clearway/sim/scenarios.h"
#include "support/data_folder.h"

namespace clearway::bench {
namespace {

// A recording, or the simulator's street in its place.
FrameSource Drive(const char* name) {
  if (const auto folder = DataPath(name)) {
    auto drive = OpenLidarFolder(*folder);
    if (drive.ok()) return drive->frames;
    std::fprintf(stderr, "%s\n", drive.status().ToString().c_str());
    std::abort();
  }
  std::printf("measuring on the simulator's street instead of the real drive\n");
  return MakeScenario("street", {})->Frames();
}

std::vector<Frame> First(std::size_t count, const FrameSource& source) {
  std::vector<Frame> frames;
  for (std::size_t i = 0; i < std::min(count, source.frame_count); ++i) {
    auto frame = source.read(i);
    if (!frame.ok()) std::abort();
    frames.push_back(*std::move(frame));
  }
  return frames;
}

}  // namespace

std::vector<Frame> WholeScans(std::size_t count) {
  std::vector<Frame> frames = First(count, Drive("kitti0000_full"));
  for (Frame& frame : frames) {
    std::fill(frame.labels.begin(), frame.labels.end(), kStaticLabel);
    frame.motions.clear();
    frame.poses.clear();
  }
  return frames;
}

std::vector<Frame> LabelledScans(std::size_t count) { return First(count, Drive("kitti0000_fov")); }

std::vector<Frame> DepthFrames(std::size_t count) {
  return First(count, MakeScenario("lab", {.image_width_px = 640})->Frames());
}

std::vector<Eigen::Vector3f> PointsInWorld(const Frame& frame) {
  std::vector<Eigen::Vector3f> points_W;
  for (std::size_t i = 0; i < frame.points_S.size(); ++i) {
    const Eigen::Vector3f& p_S = frame.points_S[i];
    if (frame.labels[i] == kIgnoreLabel || !p_S.allFinite() || p_S.isZero(0)) continue;
    points_W.push_back((frame.T_W_S * p_S.cast<double>()).cast<float>());
  }
  return points_W;
}

}  // namespace clearway::bench
