#include "client/registered_robot.h"

#include "client/call.h"
#include "wire/robot_wire.h"

namespace clearway {

absl::StatusOr<RegisteredRobot> RegisteredRobot::At(std::shared_ptr<Connection> connection,
                                                    Robot robot) {
  RegisteredRobot registered;
  registered.connection_ = std::move(connection);
  registered.robot_ = std::move(robot);
  Write(registered.robot_, &registered.proto_);
  auto id = registered.Register();
  if (!id.ok()) return id.status();
  registered.id_ = *std::move(id);
  return registered;
}

absl::StatusOr<std::string> RegisteredRobot::Register() const {
  v1::RegisterRobotRequest request;
  *request.mutable_robot() = proto_;
  auto response = Call(connection_->options(), *connection_->impl().check,
                       &v1::CheckService::Stub::RegisterRobot, request);
  if (!response.ok()) return response.status();
  return response->robot_id();
}

}  // namespace clearway
