#include "drive_server.h"

#include <cstdio>
#include <cstdlib>

#include "clearway/io/lidar_folder.h"
#include "clearway/sim/scenarios.h"
#include "server/queries.h"
#include "support/data_folder.h"

namespace clearway::bench {
namespace {

constexpr Duration kPeriod = std::chrono::milliseconds(100);
constexpr std::size_t kScans = 20;

template <class T>
T OrAbort(absl::StatusOr<T> result) {
  if (result.ok()) return *std::move(result);
  std::fprintf(stderr, "%s\n", result.status().ToString().c_str());
  std::abort();
}

FrameSource Source() {
  LidarFolderOptions options;
  options.objects = LidarObjects::kPoses;  // they hold on the way back too
  if (const auto folder = DataPath("kitti0000_full")) {
    return OrAbort(OpenLidarFolder(*folder, options)).frames;
  }
  std::printf("measuring on the simulator's street instead of the real drive\n");
  return MakeScenario("street", {})->Frames();
}

}  // namespace

Drive::Drive() {
  const FrameSource source = Source();
  for (std::size_t i = 0; i < std::min(kScans, source.frame_count); ++i) {
    frames_.push_back(OrAbort(source.read(i)));
    frames_.back().motions.clear();
  }
  first_stamp_ = frames_[0].stamp;
}

const Frame& Drive::Next() {
  const std::size_t turn = std::max<std::size_t>(1, 2 * (frames_.size() - 1));
  const std::size_t place = next_ % turn;
  Frame& frame = frames_[std::min(place, turn - place)];
  frame.sequence = next_;
  frame.stamp = first_stamp_ + static_cast<std::int64_t>(next_) * kPeriod;
  ++next_;
  return frame;
}

SceneParams DriveParams() {
  SceneParams params;
  params.rays.max_range_m = 50;
  return params;
}

DriveServer::DriveServer(std::size_t scans) {
  ServerConfig config;
  config.listen = "127.0.0.1:0";
  config.scene = DriveParams();
  server_ = OrAbort(Server::Start(config));
  for (std::size_t i = 0; i < scans; ++i) Apply();
}

std::uint64_t DriveServer::Apply() {
  const auto ticket = OrAbort(server_->core().ingestor.Push({.frame = drive_.Next()}));
  return OrAbort(ticket.answer.get()).version;
}

QuestionSpace DriveServer::Space() {
  const ScenePtr scene = Newest();
  QuestionSpace space;
  space.box_W = BoxAroundBlocks(scene->static_map_W);
  space.from = scene->stamp;
  space.span = std::chrono::seconds(2);
  return space;
}

QuestionSpace DriveServer::GroundSpace() {
  QuestionSpace space = Space();
  space.box_W.min = space.box_W.min.cwiseMax(Eigen::Vector3d(-30, -30, -2));
  space.box_W.max = space.box_W.max.cwiseMin(Eigen::Vector3d(30, 30, 1));
  return space;
}

}  // namespace clearway::bench
