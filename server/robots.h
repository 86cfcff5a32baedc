// The robots that clients have registered, and their checkers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/collision/scene_checker.h"
#include "clearway/wire/server_info.h"

namespace clearway {

// Remembers robots by the hash of their content, and the checkers made last. Both are bounded,
// robots also by their triangles and by peer: the one used longest ago is forgotten, of the peer
// that has too many, or else of the one that has most. So no peer can make the server forget
// another's robots. Any thread may call any method.
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
  absl::StatusOr<Registered> Register(Robot robot, const std::string& peer);
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
    std::string peer;  // that registered it first
  };
  using RobotList = std::list<KnownRobot>;
  struct Count {
    std::size_t robots = 0, triangles = 0;
  };
  struct KnownChecker {
    std::string id;
    ScenePtr scene;  // held, so that its address stays its own
    std::shared_ptr<const SceneChecker> checker;
  };
  // With the lock held.
  void MakeRoom(const std::string& peer, RobotList& dropped);
  bool ForgetOneOf(const std::string& peer, RobotList& dropped);
  std::map<std::string, Count> CountsByPeer() const;
  std::shared_ptr<const SceneChecker> FindChecker(const std::string& id, const ScenePtr& scene);

  const Count max_, max_of_peer_;  // of all known robots, of one peer's
  const std::uint64_t max_voxels_;
  const double voxel_m3_;
  mutable std::mutex mutex_;
  RobotList robots_;                  // used last first
  std::list<KnownChecker> checkers_;  // likewise
};

}  // namespace clearway
