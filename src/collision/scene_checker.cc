#include "clearway/collision/scene_checker.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "clearway/geometry/unit_quaternion.h"
#include "collision/motion_check.h"
#include "collision/placed_object.h"
#include "collision/state_check.h"
#include "collision/validation.h"

namespace clearway {
namespace {

// Of the time for which there are predictions, which stated futures make longer; of more than this
// the index knows nothing.
constexpr int kTimeSlices = 8, kMostTimeSlices = 64;
constexpr Duration kLongestIndexed = std::chrono::minutes(10);

ObjectIndex IndexOf(const SceneSnapshot& scene) {
  const Duration horizon = scene.params.horizon;
  Time end = scene.stamp + horizon;
  for (const auto& object : scene.objects) {
    if (!object->future.empty()) end = std::max(end, object->LastPose().stamp + horizon);
  }
  end = std::min(end, scene.stamp + std::max(horizon, kLongestIndexed));
  const double horizons =
      ToSeconds(end - scene.stamp) / std::max(1e-3, ToSeconds(scene.params.horizon));
  const int slices = static_cast<int>(std::min<double>(kMostTimeSlices, kTimeSlices * horizons));
  return ObjectIndex(scene, scene.stamp, end, std::max(kTimeSlices, slices));
}

}  // namespace

struct SceneChecker::Impl {
  ScenePtr scene;
  std::shared_ptr<const PreparedRobot> robot;
  ObjectSolids solids;
  ObjectIndex index;
};

SceneChecker::SceneChecker(ScenePtr scene, std::shared_ptr<const PreparedRobot> robot)
    : impl_(std::make_unique<const Impl>(
          Impl{scene, std::move(robot), PrepareSolids(*scene), IndexOf(*scene)})) {}

SceneChecker::SceneChecker(ScenePtr scene, Robot robot)
    : SceneChecker(std::move(scene), std::make_shared<const PreparedRobot>(std::move(robot))) {}

SceneChecker::~SceneChecker() = default;

absl::StatusOr<CheckReply> SceneChecker::Check(const StateBatch& states,
                                               const CheckOptions& options) const {
  return Check(states, options, [] { return false; });
}

absl::StatusOr<CheckReply> SceneChecker::Check(const StateBatch& states,
                                               const CheckOptions& options,
                                               const std::function<bool()>& cancelled) const {
  if (auto status = Validate(options, robot()); !status.ok()) return status;
  if (auto status = Validate(states, robot()); !status.ok()) return status;
  if (auto T_W_L = Renormalized(states.T_W_L)) {
    return Check({states.times, *std::move(T_W_L)}, options, cancelled);
  }
  const auto allowed_contacts = AllowedContacts(options, *impl_->scene);
  CheckReply reply{version(), stamp(), std::vector<StateAnswer>(states.times.size())};
  ObjectPlacer objects(*impl_->scene, impl_->solids, impl_->index, options);
  const CheckContext context{*impl_->scene, options, allowed_contacts, objects, cancelled};
  StateCheck check(context, impl_->robot->geometry());
  const std::size_t links = robot().links.size();
  for (std::size_t s = 0; s < states.times.size(); ++s) {
    check.Answer(states.times[s], &states.T_W_L[s * links], reply.answers[s]);
    if (cancelled()) return absl::CancelledError("the check was cancelled");
  }
  return reply;
}

absl::StatusOr<MotionReply> SceneChecker::CheckMotions(const MotionBatch& motions,
                                                       const MotionOptions& options) const {
  return CheckMotions(motions, options, [] { return false; });
}

absl::StatusOr<MotionReply> SceneChecker::CheckMotions(
    const MotionBatch& motions, const MotionOptions& options,
    const std::function<bool()>& cancelled) const {
  if (auto status = Validate(options, robot()); !status.ok()) return status;
  if (auto status = Validate(motions, robot()); !status.ok()) return status;
  if (auto T_W_L = Renormalized(motions.T_W_L)) {
    MotionBatch normalized = motions;
    normalized.T_W_L = *std::move(T_W_L);
    return CheckMotions(normalized, options, cancelled);
  }
  const SceneSnapshot& scene = *impl_->scene;
  MotionReply reply{version(),
                    stamp(),
                    scene.params.horizon,
                    options.check.inflation_mps,
                    options.check.bound_multiple,
                    {}};
  reply.answers.resize(motions.knot_counts.size());
  const auto allowed_contacts = AllowedContacts(options.check, scene);
  ObjectPlacer objects(scene, impl_->solids, impl_->index, options.check);
  const CheckContext states{scene, options.check, allowed_contacts, objects, cancelled};
  const MotionContext context{states, impl_->solids, impl_->index, options};
  MotionCheck check(context, impl_->robot->geometry());
  const std::size_t links = robot().links.size();
  std::size_t knot = 0;
  for (std::size_t m = 0; m < motions.knot_counts.size(); ++m) {
    const double* const deviations_m =
        motions.deviations_m.empty() ? nullptr : &motions.deviations_m[knot * links];
    check.Answer(std::span(motions.times).subspan(knot, motions.knot_counts[m]),
                 &motions.T_W_L[knot * links], deviations_m, reply.answers[m]);
    if (cancelled()) return absl::CancelledError("the check was cancelled");
    knot += motions.knot_counts[m];
  }
  return reply;
}

const Robot& SceneChecker::robot() const { return impl_->robot->robot(); }
std::uint64_t SceneChecker::version() const { return impl_->scene->version; }
Time SceneChecker::stamp() const { return impl_->scene->stamp; }

const SceneSnapshot& SceneChecker::scene() const { return *impl_->scene; }

}  // namespace clearway
