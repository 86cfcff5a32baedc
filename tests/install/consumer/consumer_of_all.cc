// Something of each layer that a project may link by its own name.
#include <ompl/base/spaces/RealVectorStateSpace.h>

#include <cstdio>

#include "clearway/client/connection.h"
#include "clearway/io/octomap_file.h"
#include "clearway/planning/space_time.h"
#include "clearway/report/top_view.h"
#include "clearway/sim/scenarios.h"

int main() {
  using namespace clearway;
  const auto simulation = MakeScenario("crossing", {});
  if (!simulation.ok()) return 1;
  const auto file = SerializeOctomap(VoxelMap(0.1), OctomapFormat::kBinary);
  if (!file.ok() || file->rfind("# Octomap", 0) != 0) return 1;
  const auto space = std::make_shared<ompl::base::RealVectorStateSpace>(2);
  const auto nobody = Connection::Open("127.0.0.1:1", {.retry_for = std::chrono::milliseconds(1)});
  if (!absl::IsUnavailable(nobody.status())) return 1;
  const SceneSnapshot empty = SceneSnapshot::Empty(SceneParams{});
  if (WriteTopView(empty, {}, "/nonexistent/x.png").ok()) return 1;
  std::printf("%s of %u dimensions\n", file->substr(0, 9).c_str(), space->getDimension());
  return 0;
}
