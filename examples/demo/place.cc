#include "demo/place.h"

#include "absl/strings/str_cat.h"
#include "clearway/client/remote_checker.h"
#include "clearway/collision/scene_checker.h"

namespace clearway::demo {
namespace {

std::vector<ObjectId> IdsOf(const SceneSnapshot& scene) {
  std::vector<ObjectId> ids;
  for (const auto& object : scene.objects) ids.push_back(object->id);
  return ids;
}

// What the straight way has to touch, for a place to pose the problem.
enum class Obstacle { kBlocker, kAnythingThatMoves };

// Objects that do not stay where they are.
std::vector<ObjectId> MoversOf(const SceneSnapshot& scene, const Truth& truth, Time now) {
  constexpr Duration kMeanwhile = std::chrono::seconds(1);
  constexpr double kMovedM = 0.5;
  std::vector<ObjectId> ids;
  for (const ObjectId id : IdsOf(scene)) {
    const auto then = BoxOf(truth, id, now), later = BoxOf(truth, id, now + kMeanwhile);
    const bool stays =
        then && later && (then->T_W_B.translation - later->T_W_B.translation).norm() < kMovedM;
    if (!stays) ids.push_back(id);
  }
  return ids;
}

absl::Status CheckRoomIn(const ScenePtr& scene, const Truth& truth, const Place& place,
                         PlanSettings settings) {
  settings.ignored_objects = MoversOf(*scene, truth, place.crossing.now);
  Crossing crossing = place.crossing;
  crossing.now = scene->stamp;
  const auto robot = std::make_shared<const PreparedRobot>(crossing.RobotModel(place.margin_m));
  return CheckRoom(std::make_shared<SceneChecker>(scene, robot), crossing, place.ground, settings);
}

// FAILED_PRECONDITION or NOT_FOUND: the place is void.
absl::StatusOr<Place> Examine(const std::shared_ptr<Connection>& connection,
                              const SceneSnapshot& scene, const ScenePtr& hindsight,
                              const Candidate& candidate, Obstacle obstacle, double margin_m,
                              const Truth& truth, PlanSettings settings) {
  const auto crossing = candidate();
  if (!crossing.ok()) return crossing.status();
  constexpr double kGroundRadiusM = 4;
  const auto ground = FitGround(scene.static_map_W, *crossing, kGroundRadiusM);
  if (!ground.ok()) return ground.status();
  Place place{margin_m, *crossing,
              *ground,  StraightWay(*crossing, *ground, settings.ground_clearance_m),
              {},       nullptr};
  place.straight = Judge(truth, *crossing, place.straight_way);
  if (!place.straight.contact || place.straight.touched == kStaticLabel) {
    return absl::FailedPreconditionError("the straight way touches nothing that moves");
  }
  if (obstacle == Obstacle::kBlocker && place.straight.touched != crossing->blocker) {
    return absl::FailedPreconditionError(
        absl::StrCat("the straight way touches object ", place.straight.touched));
  }
  auto checker = RemoteChecker::Pin(connection, crossing->RobotModel(margin_m),
                                    {.min_version = scene.version});
  if (!checker.ok()) return checker.status();
  place.checker = *std::move(checker);
  settings.ignored_objects = IdsOf(scene);
  if (auto room = CheckRoom(place.checker, *crossing, *ground, settings); !room.ok()) return room;
  if (hindsight) {
    if (auto room = CheckRoomIn(hindsight, truth, place, settings); !room.ok()) return room;
  }
  return place;
}

bool IsVoid(const absl::Status& status) {
  return absl::IsFailedPrecondition(status) || absl::IsNotFound(status);
}

}  // namespace

absl::StatusOr<Place> ChoosePlace(const std::shared_ptr<Connection>& connection,
                                  const SceneSnapshot& scene, const ScenePtr& hindsight,
                                  const Problem& problem, const Truth& truth,
                                  const PlanSettings& settings,
                                  std::vector<std::string>& void_places) {
  for (const Obstacle obstacle : {Obstacle::kBlocker, Obstacle::kAnythingThatMoves}) {
    for (const double margin_m : settings.margins_m) {
      void_places.clear();
      for (const Candidate& candidate : problem.candidates) {
        auto place =
            Examine(connection, scene, hindsight, candidate, obstacle, margin_m, truth, settings);
        if (place.ok() || !IsVoid(place.status())) return place;
        void_places.emplace_back(place.status().message());
      }
    }
  }
  return absl::NotFoundError("void: no place along the object's path poses the problem");
}

}  // namespace clearway::demo
