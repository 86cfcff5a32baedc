#include "server/handler.h"
#include "server/motion_question.h"
#include "server/services.h"
#include "wire/check_wire.h"
#include "wire/motion_wire.h"
#include "wire/robot_wire.h"

namespace clearway {

grpc::Status CheckHandlers::RegisterRobot(grpc::ServerContext* context,
                                          const v1::RegisterRobotRequest* request,
                                          v1::RegisterRobotResponse* response) {
  return HandleUnary(
      core_, context, "RegisterRobot", *request, *response, [&](const Peer& peer) -> absl::Status {
        if (!request->has_robot()) return FieldError("robot", "is missing");
        if (absl::Status room = core_.memory.Room(); !room.ok()) return room;
        absl::StatusOr<Robot> robot = ReadRobot("robot", request->robot(), core_.config.limits);
        if (!robot.ok()) return robot.status();
        absl::StatusOr<Robots::Registered> registered =
            core_.robots.Register(*std::move(robot), peer.name);
        if (!registered.ok()) return registered.status();
        response->set_robot_id(registered->id);
        for (const std::string& note : registered->notes) response->add_notes(note);
        Write(VersionOf(*core_.versions.Newest()), response->mutable_scene());
        return absl::OkStatus();
      });
}

grpc::Status CheckHandlers::CheckStates(grpc::ServerContext* context,
                                        const v1::CheckStatesRequest* request,
                                        v1::CheckStatesResponse* response) {
  return HandleUnary(core_, context, "CheckStates", *request, *response, [&]() -> absl::Status {
    const Gone gone = GoneOf(core_, context);
    absl::StatusOr<std::shared_ptr<const PreparedRobot>> robot =
        core_.robots.Find(request->robot_id());
    if (!robot.ok()) return robot.status();
    const ServerLimits& limits = core_.config.limits;
    absl::StatusOr<CheckOptions> options = ReadCheckOptions("options", request->options(), limits);
    if (!options.ok()) return options.status();
    if (absl::Status status = Validate(*options, (*robot)->robot()); !status.ok()) {
      return WithFieldPrefix("options.", status);
    }
    absl::StatusOr<StateBatch> states =
        ReadStates(*request, (*robot)->robot().links.size(), limits);
    if (!states.ok()) return states.status();
    absl::StatusOr<ScenePtr> scene = core_.SceneFor(request->selector(), gone);
    if (!scene.ok()) return scene.status();
    auto checker = core_.robots.CheckerFor(request->robot_id(), *scene);
    if (!checker.ok()) return checker.status();
    absl::StatusOr<CheckReply> reply = (*checker)->Check(*states, *options, WorkOf(core_, context));
    if (!reply.ok()) return reply.status();
    Write(*reply, response);
    return absl::OkStatus();
  });
}

grpc::Status CheckHandlers::CheckMotions(grpc::ServerContext* context,
                                         const v1::CheckMotionsRequest* request,
                                         v1::CheckMotionsResponse* response) {
  return HandleUnary(core_, context, "CheckMotions", *request, *response, [&]() -> absl::Status {
    const Gone gone = GoneOf(core_, context);
    const absl::StatusOr<MotionQuestion> question = ReadMotionQuestion(*request, core_);
    if (!question.ok()) return question.status();
    absl::StatusOr<ScenePtr> scene = core_.SceneFor(request->selector(), gone);
    if (!scene.ok()) return scene.status();
    auto checker = core_.robots.CheckerFor(request->robot_id(), *scene);
    if (!checker.ok()) return checker.status();
    absl::StatusOr<MotionReply> reply =
        (*checker)->CheckMotions(question->motions, question->options, WorkOf(core_, context));
    if (!reply.ok()) return reply.status();
    Write(*reply, response);
    return absl::OkStatus();
  });
}

}  // namespace clearway
