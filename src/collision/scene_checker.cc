#include "clearway/collision/scene_checker.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "collision/placed_object.h"
#include "collision/state_check.h"
#include "collision/validation.h"

namespace clearway {
namespace {

// The states' indices by ascending time, so that objects are placed once for each.
std::vector<std::size_t> OrderByTime(const std::vector<Time>& times) {
  std::vector<std::size_t> order(times.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return times[a] < times[b]; });
  return order;
}

}  // namespace

struct SceneChecker::Impl {
  ScenePtr scene;
  Robot robot;
  RobotGeometry geometry;
  ObjectHulls hulls;
};

SceneChecker::SceneChecker(ScenePtr scene, Robot robot)
    : impl_(std::make_unique<const Impl>(
          Impl{scene, robot, PrepareRobot(robot), PrepareHulls(*scene)})) {}

SceneChecker::~SceneChecker() = default;

absl::StatusOr<CheckReply> SceneChecker::Check(const StateBatch& states,
                                               const CheckOptions& options) const {
  return Check(states, options, [] { return false; });
}

absl::StatusOr<CheckReply> SceneChecker::Check(const StateBatch& states,
                                               const CheckOptions& options,
                                               const std::function<bool()>& cancelled) const {
  if (auto status = Validate(options, impl_->robot); !status.ok()) return status;
  if (auto status = Validate(states, impl_->robot); !status.ok()) return status;
  const std::set<std::pair<int, ObjectId>> allowed_contacts(options.allowed_contacts.begin(),
                                                            options.allowed_contacts.end());
  CheckReply reply{version(), stamp(), std::vector<StateAnswer>(states.times.size())};
  std::vector<PlacedObject> objects;
  const CheckContext context{*impl_->scene, options, allowed_contacts, objects, cancelled};
  std::optional<Time> placed_at;
  for (std::size_t s : OrderByTime(states.times)) {
    if (placed_at != states.times[s]) {
      placed_at = states.times[s];
      objects = PlaceObjects(*impl_->scene, impl_->hulls, *placed_at, options);
    }
    const Pose* T_W_L = &states.T_W_L[s * impl_->geometry.size()];
    reply.answers[s] = StateCheck(context, impl_->geometry, T_W_L).Answer();
    if (cancelled()) return absl::CancelledError("the check was cancelled");
  }
  return reply;
}

const Robot& SceneChecker::robot() const { return impl_->robot; }
std::uint64_t SceneChecker::version() const { return impl_->scene->version; }
Time SceneChecker::stamp() const { return impl_->scene->stamp; }

}  // namespace clearway
