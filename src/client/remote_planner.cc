#include "clearway/client/remote_planner.h"

#include <thread>
#include <utility>

#include "client/call.h"
#include "client/reconnector.h"
#include "client/registered_robot.h"
#include "wire/motion_wire.h"
#include "wire/plan_wire.h"
#include "wire/scene_wire.h"

namespace clearway {
namespace {

// Nothing is known of the motions.
MotionReply Unresolved(const MotionBatch& motions) {
  MotionReply reply;
  std::size_t knot = 0;
  for (const std::size_t knots : motions.knot_counts) {
    reply.answers.push_back({SpaceStatus::kUnresolved, motions.times[knot], std::nullopt});
    knot += knots;
  }
  return reply;
}

// What is new to someone who was told of each reply.
class NewsOf {
 public:
  explicit NewsOf(std::size_t motions) : free_(motions, true) {}

  RemotePlanner::News operator()(MotionReply reply, absl::Status connection = {}) {
    RemotePlanner::News news;
    for (std::size_t m = 0; m < free_.size(); ++m) {
      const bool free = reply.answers[m].status == SpaceStatus::kFree;
      if (free_[m] && !free) news.broken.push_back(m);
      if (!free_[m] && free) news.mended.push_back(m);
      free_[m] = free;
    }
    news.reply = std::move(reply);
    news.connection = std::move(connection);
    return news;
  }

 private:
  std::vector<bool> free_;
};

}  // namespace

struct RemotePlanner::Impl {
  explicit Impl(RegisteredRobot r) : registered(std::move(r)) {}

  std::size_t links() const { return registered.robot().links.size(); }
  absl::StatusOr<PlanOutcome> PlanOnce(const v1::PlanRequest& request, const PlanTask& task,
                                       const std::function<bool(const clearway::Plan&)>& found);
  // Until the stream ends, or take(reply) says false: then OK.
  absl::Status WatchOnce(const v1::WatchMotionsRequest& request, std::size_t motions,
                         const std::function<bool(MotionReply)>& take);

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
                                            const std::function<bool(MotionReply)>& take) {
  AwaitConnection(*registered.connection()->impl().channel, [] { return false; });
  grpc::ClientContext context;
  const auto stream = registered.connection()->impl().check->WatchMotions(&context, request);
  absl::Status broken;
  bool enough = false;
  v1::WatchMotionsResponse response;
  while (!enough && broken.ok() && stream->Read(&response)) {
    auto reply = ReadMotionReply(response.answers(), motions);
    broken = reply.status();
    if (reply.ok()) enough = !take(*std::move(reply));
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
                                  const std::function<bool(const News&)>& tell,
                                  const ReconnectOptions& reconnect) const {
  if (auto status = Validate(motions, impl_->registered.robot()); !status.ok()) return status;
  const std::size_t count = motions.knot_counts.size();
  v1::WatchMotionsRequest request;
  request.mutable_motions()->set_robot_id(impl_->registered.id());
  Write(options, request.mutable_motions());
  WriteMotions(motions, impl_->links(), 0, count, 0, request.mutable_motions());
  Reconnector reconnector(reconnect);
  NewsOf news(count);
  bool enough = false, lost = false;
  const auto take = [&](MotionReply reply) {
    reconnector.Connected();
    enough = !tell(news(std::move(reply)));
    return !enough;
  };
  while (true) {
    absl::Status status =
        impl_->registered.Ask([&] { return impl_->WatchOnce(request, count, take); });
    if (enough) return absl::OkStatus();
    // A server that shuts down may also just end or cancel the stream.
    if (status.ok() || absl::IsCancelled(status)) {
      status = absl::UnavailableError("the server ended the watch");
    }
    if (!reconnector.MayReturn(status)) return status;
    const bool just_lost = !lost || reconnector.state().connected;
    const std::optional<Duration> pause = reconnector.Lost(status);
    if (!pause) return reconnector.GivenUp(status);
    lost = true;
    if (just_lost && !tell(news(Unresolved(motions), status))) return absl::OkStatus();
    std::this_thread::sleep_for(*pause);
  }
}

}  // namespace clearway
