// The robots that clients have registered, and their checkers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/collision/scene_checker.h"
#include "clearway/wire/server_info.h"

namespace clearway {

// Remembers robots by the hash of their content, and the checkers made last. Both are bounded,
// robots also by their triangles: the one used longest ago is forgotten. Any thread may call any
// method.
class Robots {
 public:
  // For scenes of the resolution.
  Robots(const ServerLimits& limits, double resolution_m, std::size_t max_triangles = 2'000'000);

  struct Registered {
    std::string id;
    std::vector<std::string> notes;  // on its meshes, of PreparedRobot
  };
  // INVALID_ARGUMENT for what Validate(robot) refuses, RESOURCE_EXHAUSTED for a robot of more than
  // max_voxels_per_robot: what one state costs grows with them.
  absl::StatusOr<Registered> Register(Robot robot);
  // NOT_FOUND for a robot that is not, or no longer, known.
  absl::StatusOr<std::shared_ptr<const PreparedRobot>> Find(const std::string& id);
  // The robot's checker on the scene; NOT_FOUND as Find.
  absl::StatusOr<std::shared_ptr<const SceneChecker>> CheckerFor(const std::string& id,
                                                                 const ScenePtr& scene);
  // Likewise, of a robot that Find returned: for callers that hold it while it may be forgotten.
  std::shared_ptr<const SceneChecker> CheckerFor(const std::string& id,
                                                 const std::shared_ptr<const PreparedRobot>& robot,
                                                 const ScenePtr& scene);
  std::size_t size() const;

 private:
  struct KnownRobot {
    std::string id;
    std::size_t triangles;
    std::shared_ptr<const PreparedRobot> robot;
  };
  struct KnownChecker {
    std::string id;
    ScenePtr scene;  // held, so that its address stays its own
    std::shared_ptr<const SceneChecker> checker;
  };
  void Forget(std::list<KnownRobot>& dropped);
  std::shared_ptr<const SceneChecker> FindChecker(const std::string& id, const ScenePtr& scene);

  const std::size_t max_robots_;
  const std::uint64_t max_voxels_;
  const std::size_t max_triangles_;  // of all known robots together
  const double voxel_m3_;
  mutable std::mutex mutex_;
  std::list<KnownRobot> robots_;      // used last first
  std::list<KnownChecker> checkers_;  // likewise
};

}  // namespace clearway
