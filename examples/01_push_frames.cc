// Pushes labelled scans to a server, as a Dynamic SLAM system would; here they are simulated.
//
//   clearway-server --listen 127.0.0.1:50151 &
//   01_push_frames --server 127.0.0.1:50151
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "clearway/client/frame_sender.h"
#include "clearway/sim/scenarios.h"

namespace clearway {
namespace {

absl::Status Run(const std::string& address, std::size_t frames) {
  const absl::StatusOr<Simulation> simulation = MakeScenario("crossing");
  if (!simulation.ok()) return simulation.status();
  auto connection = Connection::Open(address);
  if (!connection.ok()) return connection.status();
  FrameSender sender(*connection);

  for (std::size_t k = 0; k < std::min(frames, simulation->frame_count()); ++k) {
    // A frame is a scan in the sensor's frame S with a label per point (0 static, -1 leave out,
    // else an object), the sensor's pose T_W_S, and the world-frame motion H_W of every moving
    // object.
    const Frame frame = simulation->MakeFrame(k);
    // Waits until the frame is in the scene. Sending it again would be harmless: (sensor_id,
    // sensor_run, sequence) names it, and the server would repeat its first answer. The sender
    // chooses a random sensor_run, so that a program that restarts may count from 0 again.
    const absl::StatusOr<PushAck> ack = sender.Push(frame);
    if (!ack.ok()) return ack.status();
    std::printf("frame %3zu: %6zu points, %zu motions -> version %llu\n", k,
                ack->report.points_used, frame.motions.size(),
                static_cast<unsigned long long>(ack->version));
  }
  return absl::OkStatus();
}

}  // namespace
}  // namespace clearway

int main(int argc, char** argv) {
  CLI::App app("Pushes simulated frames of a road with traffic to a Clearway server.");
  std::string address = "127.0.0.1:50151";
  std::size_t frames = 31;
  app.add_option("--server", address, "Address of the server")->capture_default_str();
  app.add_option("--frames", frames, "How many frames to push")->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  const absl::Status status = clearway::Run(address, frames);
  if (!status.ok()) std::fprintf(stderr, "%s\n", status.ToString().c_str());
  return status.ok() ? 0 : 1;
}
