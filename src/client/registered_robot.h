// A robot that a server knows.
#pragma once

#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "clearway/client/connection.h"
#include "clearway/collision/robot.h"
#include "clearway/v1/robot.pb.h"

namespace clearway {

// Registered when it is made, and again if the server has forgotten it. Any thread may call any
// method.
class RegisteredRobot {
 public:
  static absl::StatusOr<RegisteredRobot> At(std::shared_ptr<Connection> connection, Robot robot);

  const Robot& robot() const { return robot_; }
  const std::string& id() const { return id_; }
  const std::shared_ptr<Connection>& connection() const { return connection_; }

  // The result of call(), a Status or StatusOr; if it is NOT_FOUND, of a second call with the robot
  // registered again.
  template <class Call>
  auto Ask(Call&& call) const -> decltype(call()) {
    auto result = call();
    if (!absl::IsNotFound(StatusOf(result))) return result;
    if (auto again = Register(); !again.ok()) return again.status();
    return call();
  }

 private:
  RegisteredRobot() = default;
  static const absl::Status& StatusOf(const absl::Status& status) { return status; }
  template <class T>
  static const absl::Status& StatusOf(const absl::StatusOr<T>& result) {
    return result.status();
  }
  absl::StatusOr<std::string> Register() const;

  std::shared_ptr<Connection> connection_;
  Robot robot_;
  v1::Robot proto_;
  std::string id_;
};

}  // namespace clearway
