#include "server/robots.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <variant>

#include "absl/strings/str_cat.h"
#include "server/quota.h"
#include "wire/status.h"

namespace clearway {
namespace {

constexpr std::size_t kMaxCheckers = 16;

std::size_t TrianglesOf(const Robot& robot) {
  std::size_t count = 0;
  for (const Link& link : robot.links) {
    for (const LinkShape& part : link.shapes) {
      if (const auto* hull = std::get_if<ConvexPolytope>(&part.shape)) {
        count += hull->mesh->triangles.size();
      } else if (const auto* mesh = std::get_if<TriangleMesh>(&part.shape)) {
        count += mesh->mesh->triangles.size();
      }
    }
  }
  return count;
}

// Of the boxes around its shapes.
double VolumeOf_m3(const Robot& robot) {
  double volume_m3 = 0;
  for (const Link& link : robot.links) {
    for (const LinkShape& part : link.shapes) volume_m3 += BoundingBox(part.shape).Size().prod();
  }
  return volume_m3;
}

}  // namespace

Robots::Robots(const ServerLimits& limits, double resolution_m, std::size_t max_triangles)
    : max_{limits.max_robots, max_triangles},
      max_of_peer_{PeerLimit(limits.max_robots, limits.max_peer_share),
                   PeerLimit(max_triangles, limits.max_peer_share)},
      max_voxels_(limits.max_voxels_per_robot),
      voxel_m3_(std::pow(resolution_m, 3)) {}

absl::StatusOr<Robots::Registered> Robots::Register(Robot robot, const std::string& peer) {
  if (absl::Status status = Validate(robot); !status.ok()) {
    return WithFieldPrefix("robot.", status);
  }
  const auto voxels = static_cast<std::uint64_t>(VolumeOf_m3(robot) / voxel_m3_);
  if (voxels > max_voxels_) {
    return absl::ResourceExhaustedError(
        absl::StrCat("robot.links: the boxes around their shapes hold ", voxels,
                     " voxels; the limit is ", max_voxels_));
  }
  const std::string id = RobotId(robot);
  if (const auto known = Find(id); known.ok()) return Registered{id, (*known)->notes()};
  // Prepared without the lock, as it may take long; two calls may both do it, which is harmless.
  const std::size_t triangles = TrianglesOf(robot);
  RobotList entry;
  entry.push_back({id, triangles, std::make_shared<const PreparedRobot>(std::move(robot)), peer});
  Registered registered{id, entry.front().robot->notes()};
  RobotList dropped;  // freed after the lock
  std::lock_guard lock(mutex_);
  const auto known = std::find_if(robots_.begin(), robots_.end(),
                                  [&](const KnownRobot& other) { return other.id == id; });
  if (known != robots_.end()) dropped.splice(dropped.begin(), robots_, known);
  robots_.splice(robots_.begin(), entry);
  MakeRoom(peer, dropped);
  return registered;
}

std::map<std::string, Robots::Count> Robots::CountsByPeer() const {
  std::map<std::string, Count> counts;
  for (const KnownRobot& known : robots_) {
    Count& count = counts[known.peer];
    ++count.robots;
    count.triangles += known.triangles;
  }
  return counts;
}

// Moves the peer's robot that was used longest ago to `dropped`. The one used last of all stays.
bool Robots::ForgetOneOf(const std::string& peer, RobotList& dropped) {
  for (auto known = std::prev(robots_.end()); known != robots_.begin(); --known) {
    if (known->peer != peer) continue;
    dropped.splice(dropped.begin(), robots_, known);
    return true;
  }
  return false;
}

void Robots::MakeRoom(const std::string& peer, RobotList& dropped) {
  const auto exceeds = [](const Count& count, const Count& max) {
    return count.robots > max.robots || count.triangles > max.triangles;
  };
  while (exceeds(CountsByPeer()[peer], max_of_peer_) && ForgetOneOf(peer, dropped)) {
  }
  while (true) {
    Count all;
    std::string most = peer;
    const std::map<std::string, Count> counts = CountsByPeer();
    for (const auto& [name, count] : counts) {
      all.robots += count.robots;
      all.triangles += count.triangles;
      if (count.robots > counts.at(most).robots) most = name;
    }
    if (!exceeds(all, max_) || robots_.size() == 1) return;
    // Of several that have one each, the one that was used longest ago goes.
    if (!ForgetOneOf(most, dropped)) ForgetOneOf(robots_.back().peer, dropped);
  }
}

absl::StatusOr<std::shared_ptr<const PreparedRobot>> Robots::Find(const std::string& id) {
  std::lock_guard lock(mutex_);
  const auto found = std::find_if(robots_.begin(), robots_.end(),
                                  [&](const KnownRobot& known) { return known.id == id; });
  if (found == robots_.end()) {
    return WithReason(absl::NotFoundError(absl::StrCat("robot_id: no robot \"", id.substr(0, 64),
                                                       "\" is registered, or it was forgotten")),
                      "UNKNOWN_ROBOT");
  }
  robots_.splice(robots_.begin(), robots_, found);
  return found->robot;
}

std::shared_ptr<const SceneChecker> Robots::FindChecker(const std::string& id,
                                                        const ScenePtr& scene) {
  std::lock_guard lock(mutex_);
  const auto found = std::find_if(
      checkers_.begin(), checkers_.end(),
      [&](const KnownChecker& known) { return known.scene == scene && known.id == id; });
  if (found == checkers_.end()) return nullptr;
  checkers_.splice(checkers_.begin(), checkers_, found);
  return found->checker;
}

absl::StatusOr<std::shared_ptr<const SceneChecker>> Robots::CheckerFor(const std::string& id,
                                                                       const ScenePtr& scene) {
  absl::StatusOr<std::shared_ptr<const PreparedRobot>> robot = Find(id);
  if (!robot.ok()) return robot.status();
  return CheckerFor(id, *robot, scene);
}

std::shared_ptr<const SceneChecker> Robots::CheckerFor(
    const std::string& id, const std::shared_ptr<const PreparedRobot>& robot,
    const ScenePtr& scene) {
  if (auto checker = FindChecker(id, scene)) return checker;
  // Made without the lock, as it may take long; two calls may both make one, which is harmless.
  std::list<KnownChecker> entry;
  entry.push_back({id, scene, std::make_shared<const SceneChecker>(scene, robot)});
  auto checker = entry.front().checker;
  std::list<KnownChecker> dropped;  // freed after the lock
  std::lock_guard lock(mutex_);
  checkers_.splice(checkers_.begin(), entry);
  if (checkers_.size() > kMaxCheckers) {
    dropped.splice(dropped.begin(), checkers_, std::prev(checkers_.end()));
  }
  return checker;
}

std::size_t Robots::size() const {
  std::lock_guard lock(mutex_);
  return robots_.size();
}

}  // namespace clearway
