#include "fuzz/scratch_server.h"

#include <thread>

#include "clearway/v1/check_service.pb.h"
#include "clearway/v1/ingest_service.pb.h"
#include "clearway/v1/map_service.pb.h"
#include "clearway/v1/object_service.pb.h"
#include "fuzz/fuzz.h"
#include "server/core.h"
#include "spdlog/spdlog.h"
#include "support/frames.h"
#include "support/raw_call.h"
#include "wire/frame_wire.h"
#include "wire/object_wire.h"
#include "wire/robot_wire.h"

namespace clearway::fuzz {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

// Small enough for any request to take little time.
ServerConfig ConfigIn(const TemporaryFolder& folder) {
  ServerConfig config;
  config.listen = "unix:" + (folder / "socket").string();
  config.threads = 1;
  config.scene.resolution_m = config.scene.object_resolution_m = 0.2;
  config.limits.max_message_bytes = config.limits.max_prior_bytes = 1 << 16;
  config.limits.max_points_per_frame = 2000;
  config.limits.max_ray_voxels = 1 << 18;
  config.limits.max_blocks = 1 << 12;
  config.limits.max_objects = 16;
  config.limits.max_states_per_batch = 100;
  config.limits.max_points_per_query = 20'000;
  config.limits.max_voxels_per_robot = 100'000;
  config.limits.max_triangles_per_robot = 2000;
  config.limits.max_version_wait_s = 0.01;
  config.limits.max_planning_s = 0.02;
  config.limits.max_lease_ttl_s = 0.2;
  config.limits.max_peer_share = 1;
  return config;
}

// What the requests of the corpus are about: static points, object 1 that moves, the given object 2
// with a future.
v1::PushFrameRequest SceneFrame(int step) {
  Frame frame = testing_support::FrameAt(10 + 0.1 * step);
  for (int i = -5; i <= 5; ++i) {
    testing_support::AddPoint(frame, kStaticLabel, {4, 0.5 * i, 0.1});
    testing_support::AddPoint(frame, 1, {2 + 0.1 * step, 0.05 * i, 0.3});
  }
  if (step > 0) {
    frame.motions = {{1, Pose::Translation(0.1, 0, 0), frame.stamp - FromSeconds(0.1)}};
  }
  v1::PushFrameRequest request;
  Write(frame, request.mutable_frame());
  return request;
}

v1::AddObjectsRequest SceneObjects() {
  const Time stamp = testing_support::At(10.1);
  GivenObject given{2, Box{{1, 1, 1}}, {stamp, Pose::Translation(0, 3, 0)}, {}, {}};
  given.future = {{stamp + seconds(1), Pose::Translation(1, 3, 0)}};
  v1::AddObjectsRequest request;
  Write(given, request.add_objects());
  return request;
}

}  // namespace

ScratchServer::ScratchServer() {
  spdlog::set_level(spdlog::level::off);
  auto started = Server::Start(ConfigIn(folder_));
  Require(started.ok(), started.status().ToString());
  server_ = *std::move(started);
  channel_ = grpc::CreateChannel(server_->address(), grpc::InsecureChannelCredentials());
  Restore();
}

grpc::Status ScratchServer::Call(const std::string& method, std::string_view bytes,
                                 milliseconds patience) {
  const grpc::Slice slice(bytes.data(), bytes.size());
  grpc::Status status = testing_support::RawStream(*channel_, method.c_str(),
                                                   grpc::ByteBuffer(&slice, 1), "", patience);
  AwaitEnd();
  return status;
}

// A handler that goes on for long, although nobody waits for its answer, is what libFuzzer's time
// limit finds. Frames that were accepted are applied before the change that changes nothing.
void ScratchServer::AwaitEnd() const {
  ServerCore& core = server_->core();
  while (core.open_calls.running() > 0) std::this_thread::sleep_for(milliseconds(1));
  const auto ticket = core.ingestor.Apply([](SceneBuilder&) { return absl::OkStatus(); },
                                          Ingestor::Effect::kTakesAway);
  Require(ticket.ok(), ticket.status().ToString());
  RequireForeseen(Ingestor::Wait(*ticket, [] { return false; }).status());
}

std::uint64_t ScratchServer::version() const { return server_->core().versions.Newest()->version; }

template <class Message>
void ScratchServer::Send(const std::string& method, const Message& message) {
  const grpc::Status status = Call(method, message.SerializeAsString(), seconds(30));
  Require(status.ok(), method + ": " + status.error_message());
}

void ScratchServer::Restore() {
  Send("/clearway.v1.MapService/SetKeepOut", v1::SetKeepOutRequest());
  Send("/clearway.v1.MapService/Reset", v1::ResetRequest());
  for (const int step : {0, 1}) Send("/clearway.v1.IngestService/PushFrame", SceneFrame(step));
  Send("/clearway.v1.ObjectService/AddObjects", SceneObjects());
  v1::RegisterRobotRequest robot;
  Write(Robot::SingleShape("ball", Sphere{0.5}), robot.mutable_robot());
  Send("/clearway.v1.CheckService/RegisterRobot", robot);
}

}  // namespace clearway::fuzz
