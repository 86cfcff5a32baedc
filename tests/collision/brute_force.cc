#include "collision/brute_force.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <utility>

#include "collision/brute_geometry.h"

namespace clearway {
namespace {

bool InOneOf(const std::vector<Aabb>& boxes, const Eigen::Vector3d& p) {
  return std::any_of(boxes.begin(), boxes.end(), [&](const Aabb& box) { return box.Contains(p); });
}

// What was met so far.
struct Findings {
  using LinkAndObject = std::pair<int, ObjectId>;
  std::map<SpaceStatus, LinkAndObject, std::greater<>> lowest;  // worst status first
  bool unsure = false;
  double nearest_m = 0;

  void Look(int link, const RobotBody& body, const Obstacle& obstacle,
            const CheckOptions& options) {
    const LinkAndObject pair{link, obstacle.id};
    const auto& allowed = options.allowed_contacts;
    if ((obstacle.status == SpaceStatus::kOccupied ||
         obstacle.status == SpaceStatus::kBeyondHorizon) &&
        std::find(allowed.begin(), allowed.end(), pair) != allowed.end()) {
      return;
    }
    const bool wall = obstacle.status == SpaceStatus::kOutOfBounds;
    const double margin_m = wall ? 0 : obstacle.margin_m + options.padding_m;
    const double gap_m = (body.pose_W.translation() - obstacle.pose_W.translation()).norm() -
                         body.radius_m - obstacle.radius_m - margin_m;
    if (gap_m <= 1e-3) {
      const Verdict verdict = Touches(body, obstacle, margin_m);
      unsure = unsure || verdict == Verdict::kUnsure;
      if (verdict == Verdict::kTouching) {
        const auto entry = lowest.try_emplace(obstacle.status, pair).first;
        entry->second = std::min(entry->second, pair);
      }
    }
    if (!wall && gap_m <= nearest_m && nearest_m > 0) {
      const double distance_m = Distance(body, obstacle.geometry.exact, obstacle.pose_W);
      nearest_m = std::clamp(distance_m - margin_m, 0.0, nearest_m);
    }
  }

  BruteAnswer Conclude(double unknown_share, const CheckOptions& options) const {
    BruteAnswer result;
    result.unsure = unsure;
    StateAnswer& answer = result.answer;
    answer.status = SpaceStatus::kFree;
    if (options.NeedsUnknownFraction()) answer.unknown_fraction = unknown_share;
    if (options.clearance_up_to_m) answer.clearance_m = nearest_m;
    if (!lowest.empty()) {
      answer.status = lowest.begin()->first;
      answer.link = lowest.begin()->second.first;
      answer.object = lowest.begin()->second.second;
    } else if (options.unknown == UnknownPolicy::kTolerated &&
               unknown_share > options.max_unknown_fraction) {
      answer.status = SpaceStatus::kUnknownSpace;
      answer.link = 0;
    }
    if (answer.status == SpaceStatus::kOutOfBounds) {
      if (options.NeedsUnknownFraction()) answer.unknown_fraction = 1;
      if (options.clearance_up_to_m) answer.clearance_m = 0;
    }
    return result;
  }
};

}  // namespace

struct BruteForce::Impl {
  ScenePtr scene;
  Robot robot;
  CheckOptions options;
  std::vector<std::vector<FclGeometry>> links;
  std::vector<VoxelKey> keys;  // of the region
  Sizes static_voxel, object_voxel;
  std::vector<Obstacle> static_obstacles;  // at any time

  std::vector<Obstacle> StaticObstacles() const;
  void AddObject(const MovingObject& object, Time time, std::vector<Obstacle>& obstacles) const;
  double UnknownShare(const std::vector<RobotBody>& bodies) const;
  void AddWalls(std::vector<Obstacle>& obstacles) const;
  std::vector<RobotBody> BodiesOf(int link, const Pose* T_W_L) const;
};

BruteForce::BruteForce(ScenePtr scene, const Robot& robot, const CheckOptions& options,
                       const Aabb& region_W)
    : impl_(std::make_unique<Impl>()) {
  impl_->scene = scene;
  impl_->robot = WithSolidMeshes(robot).robot;
  impl_->options = options;
  for (const Link& link : impl_->robot.links) {
    auto& shapes = impl_->links.emplace_back();
    for (const LinkShape& shape : link.shapes) shapes.push_back(GeometryOf(shape.shape));
  }
  const VoxelGrid& grid = scene->static_map_W.grid();
  const VoxelKey low = grid.KeyOf(region_W.min), high = grid.KeyOf(region_W.max);
  for (std::int32_t z = low.z; z <= high.z; ++z) {
    for (std::int32_t y = low.y; y <= high.y; ++y) {
      for (std::int32_t x = low.x; x <= high.x; ++x) impl_->keys.push_back({x, y, z});
    }
  }
  impl_->static_voxel = BoxSizes(Eigen::Vector3d::Constant(grid.resolution_m()));
  impl_->object_voxel = BoxSizes(Eigen::Vector3d::Constant(scene->params.object_resolution_m));
  impl_->static_obstacles = impl_->StaticObstacles();
  impl_->AddWalls(impl_->static_obstacles);
}

BruteForce::~BruteForce() = default;

std::vector<Obstacle> BruteForce::Impl::StaticObstacles() const {
  std::vector<Obstacle> obstacles;
  const VoxelGrid& grid = scene->static_map_W.grid();
  for (const VoxelKey& key : keys) {
    const VoxelState state = scene->static_map_W.State(key);
    const Eigen::Vector3d center = grid.CenterOf(key);
    if (state == VoxelState::kFree) continue;
    if (state == VoxelState::kUnknown &&
        (options.unknown != UnknownPolicy::kBlocked || InOneOf(options.known_free_W, center))) {
      continue;
    }
    Obstacle& added = obstacles.emplace_back();
    added.status =
        state == VoxelState::kOccupied ? SpaceStatus::kOccupied : SpaceStatus::kUnknownSpace;
    added.geometry = static_voxel;
    added.pose_W.translation() = center;
    added.radius_m = grid.resolution_m();
  }
  for (const Aabb& box : scene->params.keep_out_W) {
    Obstacle& added = obstacles.emplace_back();
    added.geometry = BoxSizes(box.Size());
    added.pose_W.translation() = box.Center();
    added.radius_m = box.Size().norm();
  }
  return obstacles;
}

void BruteForce::Impl::AddObject(const MovingObject& object, Time time,
                                 std::vector<Obstacle>& obstacles) const {
  const auto& ignored = options.ignored_objects;
  if (std::find(ignored.begin(), ignored.end(), object.id) != ignored.end()) return;
  const PredictedPose predicted = PredictPose(object, time, scene->params.horizon);
  Obstacle obstacle;
  obstacle.id = object.id;
  obstacle.pose_W = AsIsometry(predicted.T_W_O);
  const bool rests =
      object.future.empty() && object.velocity_O.has_value() && *object.velocity_O == Twist{};
  if (!(options.inflate_moving_only && rests)) {
    obstacle.margin_m = options.inflation_mps * std::max(0.0, ToSeconds(time - object.t_k()));
    const Time last =
        object.future.empty() ? object.history.back().stamp : object.future.back().stamp;
    const double since_s = ToSeconds(time - last);
    if (since_s >= 0) {
      const auto& [at_m, speed_mps, accel_mps2] = object.bound;
      obstacle.margin_m += options.bound_multiple *
                           (at_m + speed_mps * since_s + accel_mps2 * since_s * since_s / 2);
    }
  }
  if (predicted.beyond_horizon_radius_m) {
    obstacle.status = SpaceStatus::kBeyondHorizon;
    obstacle.radius_m = *predicted.beyond_horizon_radius_m;
    obstacle.geometry = BallSizes(obstacle.radius_m);
    obstacles.push_back(obstacle);
  } else if (object.FillsSolid(scene->params.solid)) {
    obstacle.radius_m = object.solid->radius_m;
    obstacle.geometry = SolidSizes(*object.solid);
    obstacles.push_back(obstacle);
  } else {
    object.map_O.blocks().ForEach([&](BlockKey block_key, const VoxelBlock& block) {
      block.occupied.ForEach([&](int index) {
        const VoxelKey key = VoxelAt(block_key, index);
        Obstacle voxel = obstacle;
        voxel.geometry = object_voxel;
        voxel.pose_W.translation() = obstacle.pose_W * object.map_O.grid().CenterOf(key);
        voxel.radius_m = object.map_O.grid().resolution_m();
        obstacles.push_back(voxel);
      });
    });
  }
}

double BruteForce::Impl::UnknownShare(const std::vector<RobotBody>& bodies) const {
  const VoxelMap& map = scene->static_map_W;
  const auto unknown = [&](VoxelKey key) {
    return map.State(key) == VoxelState::kUnknown &&
           !InOneOf(options.known_free_W, map.grid().CenterOf(key));
  };
  double all = 0, unknown_count = 0;
  for (const VoxelKey& key : keys) {
    const Eigen::Vector3d center = map.grid().CenterOf(key);
    const bool inside = std::any_of(bodies.begin(), bodies.end(), [&](const RobotBody& body) {
      if ((center - body.pose_W.translation()).norm() > body.radius_m) return false;
      return Contains(*body.shape, body.pose_W.inverse() * center);
    });
    all += inside;
    unknown_count += inside && unknown(key);
  }
  if (all > 0) return unknown_count / all;
  std::set<VoxelKey> central;
  for (const RobotBody& body : bodies) {
    central.insert(map.grid().KeyOf(body.pose_W * BoundingBox(*body.shape).Center()));
  }
  return static_cast<double>(std::count_if(central.begin(), central.end(), unknown)) /
         static_cast<double>(central.size());
}

// The space outside the bounds, as six thick walls.
void BruteForce::Impl::AddWalls(std::vector<Obstacle>& obstacles) const {
  constexpr double kThickness_m = 20;
  const Aabb& bounds = scene->params.bounds_W;
  for (int axis = 0; axis < 3; ++axis) {
    for (double side : {-1.0, 1.0}) {
      Obstacle& wall = obstacles.emplace_back();
      wall.status = SpaceStatus::kOutOfBounds;
      wall.geometry = BoxSizes(Eigen::Vector3d::Constant(kThickness_m));
      wall.pose_W.translation() = bounds.Center();
      wall.pose_W.translation()[axis] += side * 0.5 * (bounds.Size()[axis] + kThickness_m);
      wall.radius_m = kThickness_m;
    }
  }
}

std::vector<RobotBody> BruteForce::Impl::BodiesOf(int link, const Pose* T_W_L) const {
  std::vector<RobotBody> bodies;
  for (std::size_t s = 0; s < links[link].size(); ++s) {
    const LinkShape& shape = robot.links[link].shapes[s];
    bodies.push_back({links[link][s], AsIsometry(T_W_L[link]) * AsIsometry(shape.T_L_G),
                      &shape.shape, RadiusOf(shape.shape)});
  }
  return bodies;
}

BruteAnswer BruteForce::Check(Time time, const Pose* T_W_L) const {
  std::vector<Obstacle> moving;
  for (const auto& object : impl_->scene->objects) impl_->AddObject(*object, time, moving);
  Findings findings;
  findings.nearest_m = impl_->options.clearance_up_to_m.value_or(0);
  std::vector<RobotBody> all;
  for (int link = 0; link < static_cast<int>(impl_->links.size()); ++link) {
    for (const RobotBody& body : impl_->BodiesOf(link, T_W_L)) {
      for (const auto* obstacles : {&impl_->static_obstacles, &moving}) {
        for (const Obstacle& obstacle : *obstacles) {
          findings.Look(link, body, obstacle, impl_->options);
        }
      }
      all.push_back(body);
    }
  }
  return findings.Conclude(impl_->UnknownShare(all), impl_->options);
}

}  // namespace clearway
