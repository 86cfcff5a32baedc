#include "recorded_scans.h"

#include <cstdio>
#include <cstdlib>

#include "clearway/io/lidar_folder.h"
#include "clearway/sim/scenarios.h"
#include "support/data_folder.h"

namespace clearway::bench {
namespace {

FrameSource Source() {
  if (const auto folder = DataPath("kitti0000_full")) {
    auto drive = OpenLidarFolder(*folder);
    if (drive.ok()) return drive->frames;
    std::fprintf(stderr, "%s\n", drive.status().ToString().c_str());
    std::abort();
  }
  std::printf("measuring on the simulator's street instead of the real drive\n");
  return MakeScenario("street", {})->Frames();
}

}  // namespace

std::vector<Frame> WholeScans(std::size_t count) {
  const FrameSource source = Source();
  std::vector<Frame> frames;
  for (std::size_t i = 0; i < std::min(count, source.frame_count); ++i) {
    auto frame = source.read(i);
    if (!frame.ok()) std::abort();
    std::fill(frame->labels.begin(), frame->labels.end(), kStaticLabel);
    frame->motions.clear();
    frame->poses.clear();
    frames.push_back(*std::move(frame));
  }
  return frames;
}

std::vector<Eigen::Vector3f> PointsInWorld(const Frame& frame) {
  std::vector<Eigen::Vector3f> points_W;
  for (const Eigen::Vector3f& p_S : frame.points_S) {
    if (p_S.allFinite()) points_W.push_back((frame.T_W_S * p_S.cast<double>()).cast<float>());
  }
  return points_W;
}

}  // namespace clearway::bench
