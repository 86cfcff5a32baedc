// The three questions of `clearway occupancy`, each asked and printed.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "clearway/client/scene_client.h"
#include "cli/cli.h"
#include "cli/server_flags.h"
#include "cli/values.h"

namespace clearway::cli {

struct OccupancyFlags {
  ServerFlags server;
  std::vector<Eigen::Vector3d> points;
  std::optional<Aabb> box;
  std::optional<double> slice_z_m;
  std::optional<Aabb> area;
  std::optional<double> cell_m;
  std::vector<TimeArgument> times;
  bool json = false;
};

// `times` is never empty.
absl::Status AnswerPoints(const OccupancyFlags& flags, const SceneClient& client,
                          std::span<const Time> times, const Terminal& terminal);
absl::Status AnswerBox(const OccupancyFlags& flags, const SceneClient& client,
                       std::span<const Time> times, const Terminal& terminal);
// `scene` says where there is anything to draw.
absl::Status AnswerSlice(const OccupancyFlags& flags, const SceneClient& client,
                         const ServerStatus& scene, std::span<const Time> times,
                         const Connection& connection, const Terminal& terminal);

}  // namespace clearway::cli
