#include "clearway/client/remote_planner.h"

#include "client/call.h"
#include "client/registered_robot.h"
#include "wire/motion_wire.h"
#include "wire/plan_wire.h"
#include "wire/scene_wire.h"

namespace clearway {

struct RemotePlanner::Impl {
  explicit Impl(RegisteredRobot r) : registered(std::move(r)) {}

  std::size_t links() const { return registered.robot().links.size(); }
  absl::StatusOr<PlanOutcome> PlanOnce(const v1::PlanRequest& request, const PlanTask& task,
                                       const std::function<bool(const clearway::Plan&)>& found);
  absl::Status WatchOnce(const v1::WatchMotionsRequest& request, std::size_t motions,
                         const std::function<bool(const News&)>& tell);

  RegisteredRobot registered;
};

// No deadline: the budget ends the call.
absl::StatusOr<PlanOutcome> RemotePlanner::Impl::PlanOnce(
    const v1::PlanRequest& request, const PlanTask& task,
    const std::function<bool(const clearway::Plan&)>& found) {
  grpc::ClientContext context;
  const auto stream = registered.connection()->impl().plan->Plan(&context, request);
  PlanOutcome outcome;
  absl::Status broken;
  bool enough = false;
  v1::PlanResponse response;
  while (!enough && broken.ok() && stream->Read(&response)) {
    outcome = ReadOutcome(response);
    if (!response.has_path()) continue;
    const auto plan = ReadPlan(response.path(), task, links());
    broken = plan.status();
    if (!plan.ok()) continue;
    enough = !found(*plan);
    outcome.status = PlanStatus::kFound;
  }
  if (enough || !broken.ok()) context.TryCancel();
  const absl::Status status = FromGrpc(stream->Finish());
  if (!broken.ok()) return broken;
  if (!enough && !status.ok()) return status;
  return outcome;
}

absl::Status RemotePlanner::Impl::WatchOnce(const v1::WatchMotionsRequest& request,
                                            std::size_t motions,
                                            const std::function<bool(const News&)>& tell) {
  grpc::ClientContext context;
  const auto stream = registered.connection()->impl().check->WatchMotions(&context, request);
  absl::Status broken;
  bool enough = false;
  v1::WatchMotionsResponse response;
  while (!enough && broken.ok() && stream->Read(&response)) {
    auto reply = ReadMotionReply(response.answers(), motions);
    broken = reply.status();
    if (!reply.ok()) continue;
    enough = !tell({*std::move(reply),
                    {response.broken().begin(), response.broken().end()},
                    {response.mended().begin(), response.mended().end()}});
  }
  if (enough || !broken.ok()) context.TryCancel();
  const absl::Status status = FromGrpc(stream->Finish());
  if (!broken.ok()) return broken;
  return enough ? absl::OkStatus() : status;
}

RemotePlanner::RemotePlanner(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RemotePlanner::~RemotePlanner() = default;

absl::StatusOr<std::unique_ptr<RemotePlanner>> RemotePlanner::For(
    std::shared_ptr<Connection> connection, Robot robot) {
  auto registered = RegisteredRobot::At(std::move(connection), std::move(robot));
  if (!registered.ok()) return registered.status();
  return std::unique_ptr<RemotePlanner>(
      new RemotePlanner(std::make_unique<Impl>(*std::move(registered))));
}

absl::StatusOr<PlanOutcome> RemotePlanner::Plan(
    const PlanTask& task, Duration budget, const std::function<bool(const clearway::Plan&)>& found,
    const SceneQuery& query) const {
  v1::PlanRequest request;
  Write(query, request.mutable_selector());
  request.set_robot_id(impl_->registered.id());
  Write(task, &request);
  request.set_budget_s(ToSeconds(budget));
  return impl_->registered.Ask([&] { return impl_->PlanOnce(request, task, found); });
}

absl::Status RemotePlanner::Watch(const MotionBatch& motions, const MotionOptions& options,
                                  const std::function<bool(const News&)>& tell) const {
  if (auto status = Validate(motions, impl_->registered.robot()); !status.ok()) return status;
  v1::WatchMotionsRequest request;
  request.mutable_motions()->set_robot_id(impl_->registered.id());
  Write(options, request.mutable_motions());
  WriteMotions(motions, impl_->links(), 0, motions.knot_counts.size(), 0,
               request.mutable_motions());
  return impl_->registered.Ask(
      [&] { return impl_->WatchOnce(request, motions.knot_counts.size(), tell); });
}

}  // namespace clearway
