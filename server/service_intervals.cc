#include "clearway/collision/cancellable_checker.h"
#include "server/handler.h"
#include "server/motion_question.h"
#include "server/services.h"
#include "wire/interval_wire.h"

namespace clearway {
namespace {

using Intervals = absl::StatusOr<std::vector<std::vector<TimeInterval>>>;

// find(checker) -> Intervals, on the version that is asked for.
template <class Find, class Response>
absl::Status Answer(ServerCore& core, const v1::SceneSelector& selector,
                    const std::string& robot_id, const CheckOptions& options,
                    const grpc::ServerContext* context, Find&& find, Response* response) {
  const absl::StatusOr<ScenePtr> scene = core.SceneFor(selector, GoneOf(core, context));
  if (!scene.ok()) return scene.status();
  auto checker = core.robots.CheckerFor(robot_id, *scene);
  if (!checker.ok()) return checker.status();
  const Intervals intervals = find(CancellableChecker(*std::move(checker), WorkOf(core, context)));
  if (!intervals.ok()) return intervals.status();
  Write(VersionOf(**scene), response->mutable_scene());
  response->set_horizon_ns((*scene)->params.horizon.count());
  response->set_inflation_mps(options.inflation_mps);
  response->set_bound_multiple(options.bound_multiple);
  Write(*intervals, response->mutable_intervals());
  const std::uint64_t limit = core.config.limits.max_message_bytes;
  const std::uint64_t size = response->ByteSizeLong();
  return size > limit ? LimitError("intervals", size, limit) : absl::OkStatus();
}

absl::Status ForMotions(const absl::Status& status) {
  return absl::IsInvalidArgument(status) || absl::IsNotFound(status) ||
                 absl::IsResourceExhausted(status)
             ? WithFieldPrefix("motions.", status)
             : status;
}

}  // namespace

grpc::Status CheckHandlers::FindSafeIntervals(grpc::ServerContext* context,
                                              const v1::FindSafeIntervalsRequest* request,
                                              v1::FindSafeIntervalsResponse* response) {
  return HandleUnary(
      core_, context, "FindSafeIntervals", *request, *response, [&]() -> absl::Status {
        const auto robot = core_.robots.Find(request->robot_id());
        if (!robot.ok()) return robot.status();
        const auto question =
            ReadSafeIntervalQuestion(*request, (*robot)->robot().links.size(), core_.config.limits);
        if (!question.ok()) return question.status();
        const MotionOptions waits{question->options.check};
        if (absl::Status status = Validate(waits, (*robot)->robot()); !status.ok()) {
          return WithFieldPrefix("options.", status);
        }
        const auto find = [&](const StateChecker& checker) {
          return clearway::FindSafeIntervals(checker, question->T_W_L, question->window,
                                             question->options);
        };
        return Answer(core_, request->selector(), request->robot_id(), waits.check, context, find,
                      response);
      });
}

grpc::Status CheckHandlers::FindDepartureIntervals(grpc::ServerContext* context,
                                                   const v1::FindDepartureIntervalsRequest* request,
                                                   v1::FindDepartureIntervalsResponse* response) {
  return HandleUnary(
      core_, context, "FindDepartureIntervals", *request, *response, [&]() -> absl::Status {
        const v1::CheckMotionsRequest& motions = request->motions();
        FieldReader read;
        read.Require(request->has_motions(), "motions", "is missing");
        read.Require(!motions.has_world_at_ns(), "motions.world_at_ns",
                     "is not for departures: time passes");
        if (!read.ok()) return read.status();
        const absl::StatusOr<MotionQuestion> question = ReadMotionQuestion(motions, core_);
        if (!question.ok()) return ForMotions(question.status());
        const absl::StatusOr<TimeInterval> window = ReadDepartureWindow(*request);
        if (!window.ok()) return window.status();
        const auto find = [&](const StateChecker& checker) {
          return clearway::FindDepartureIntervals(checker, question->motions, *window,
                                                  {question->options, ReadResolution(*request)});
        };
        return Answer(core_, motions.selector(), motions.robot_id(), question->options.check,
                      context, find, response);
      });
}

}  // namespace clearway
