#include "clearway/planning/solve_task.h"
#include "server/handler.h"
#include "server/services.h"
#include "wire/plan_wire.h"

namespace clearway {
namespace {

absl::Status Serve(ServerCore& core, const v1::PlanRequest& request, grpc::ServerContext& context,
                   grpc::ServerWriter<v1::PlanResponse>& writer) {
  const Gone gone = GoneOf(core, &context);
  const ServerLimits& limits = core.config.limits;
  const auto robot = core.robots.Find(request.robot_id());
  if (!robot.ok()) return robot.status();
  const auto task = ReadPlanTask(request, limits);
  if (!task.ok()) return task.status();
  if (auto status = Validate(task->options.check, (*robot)->robot()); !status.ok()) {
    return WithFieldPrefix("options.", status);
  }
  const auto budget = ReadBudget(request, limits);
  if (!budget.ok()) return budget.status();
  const auto scene = core.SceneFor(request.selector(), gone);
  if (!scene.ok()) return scene.status();
  const auto checker = core.robots.CheckerFor(request.robot_id(), *scene);
  if (!checker.ok()) return checker.status();
  Work work(core, &context);
  bool lost = false;  // a stream that takes no more messages has no reader
  const auto send = [&](v1::PlanResponse& response) {
    Write(VersionOf(**scene), response.mutable_scene());
    response.set_horizon_ns((*scene)->params.horizon.count());
    response.set_inflation_mps(task->options.check.inflation_mps);
    response.set_bound_multiple(task->options.check.bound_multiple);
    work.Rest();
    lost = lost || !WriteTo(writer, response, context, core.streams);
  };
  const auto outcome = Solve(
      *task, *checker, *budget,
      [&](const Plan& plan) {
        v1::PlanResponse response;
        Write(plan, request, (*robot)->robot().links.size(), response.mutable_path());
        send(response);
      },
      [&] { return lost || core.draining || work.MustEnd(); });
  if (!outcome.ok()) return outcome.status();
  if (core.draining && outcome->status == PlanStatus::kNotFound) {
    return DrainingError();
  }
  v1::PlanResponse last;
  Write(*outcome, &last);
  send(last);
  return absl::OkStatus();
}

}  // namespace

grpc::Status PlanHandlers::Plan(grpc::ServerContext* context, const v1::PlanRequest* request,
                                grpc::ServerWriter<v1::PlanResponse>* writer) {
  return Handle(core_, context, "Plan", *request, [&](const Peer& peer) -> absl::Status {
    const Quota::Slot slot(core_.plans, peer.name);
    if (!slot.status().ok()) return slot.status();
    return Serve(core_, *request, *context, *writer);
  });
}

}  // namespace clearway
