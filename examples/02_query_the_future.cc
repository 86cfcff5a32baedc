// Asks a server where its objects will be, and whether a place will be free then.
//
//   01_push_frames --server 127.0.0.1:50151     (fills the scene)
//   02_query_the_future --server 127.0.0.1:50151
#include <CLI/CLI.hpp>
#include <cstdio>

#include "clearway/client/scene_client.h"

namespace clearway {
namespace {

absl::Status Run(const std::string& address) {
  auto connection = Connection::Open(address);
  if (!connection.ok()) return connection.status();
  const SceneClient client(*connection);

  // One version for every question: nobody can move the scene between two of them.
  const absl::StatusOr<LeaseGrant> lease = client.AcquireLease(std::chrono::seconds(30));
  if (!lease.ok()) return lease.status();
  const SceneQuery pinned{.min_version = 0, .lease_id = lease->id};
  const absl::StatusOr<ObjectList> objects = client.ListObjects(pinned);
  if (!objects.ok()) return objects.status();

  std::vector<Time> times;  // of sensor time, from the newest frame on
  for (int half_seconds = 0; half_seconds <= 6; ++half_seconds) {
    times.push_back(objects->stamp + half_seconds * std::chrono::milliseconds(500));
  }
  for (const ObjectInfo& object : objects->objects) {
    const ObjectId ids[] = {object.id};
    const absl::StatusOr<PredictedPoses> predicted = client.PredictPoses(ids, times, pinned);
    if (!predicted.ok()) return predicted.status();
    std::printf("object %d, %.1f m/s:\n", object.id, object.speed_mps);
    for (std::size_t i = 0; i < times.size(); ++i) {
      const Eigen::Vector3d p_W = predicted->poses[i].T_W_O.translation;
      // Is the place where the object is now still occupied then?
      const Eigen::Vector3f now_W = object.T_W_O.translation.cast<float>();
      const auto occupancy = client.OccupancyOfPoints({&now_W, 1}, {&times[i], 1}, pinned);
      if (!occupancy.ok()) return occupancy.status();
      std::printf("  in %.1f s at (%6.2f, %6.2f), the place it is at now: %s\n",
                  ToSeconds(times[i] - objects->stamp), p_W.x(), p_W.y(),
                  ToString(occupancy->points[0].status));
    }
  }
  return client.ReleaseLease(lease->id);
}

}  // namespace
}  // namespace clearway

int main(int argc, char** argv) {
  CLI::App app("Asks a Clearway server where its objects will be.");
  std::string address = "127.0.0.1:50151";
  app.add_option("--server", address, "Address of the server")->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  const absl::Status status = clearway::Run(address);
  if (!status.ok()) std::fprintf(stderr, "%s\n", status.ToString().c_str());
  return status.ok() ? 0 : 1;
}
