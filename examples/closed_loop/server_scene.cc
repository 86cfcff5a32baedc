#include "closed_loop/server_scene.h"

#include "absl/strings/str_cat.h"

namespace clearway::closed_loop {

absl::StatusOr<std::unique_ptr<ServerScene>> ServerScene::Start(const std::string& binary) {
  const SceneParams params = LoopSceneParams();
  auto server = demo::ServerProcess::Start(
      binary, {absl::StrCat("--scene-horizon-s=", ToSeconds(params.horizon)),
               absl::StrCat("--scene-object-lifetime-s=", ToSeconds(params.object_lifetime)),
               absl::StrCat("--scene-history-s=", ToSeconds(params.history))});
  if (!server.ok()) return server.status();
  auto connection = Connection::Open((*server)->address());
  if (!connection.ok()) return connection.status();
  auto mirror = SceneMirror::Follow(*connection);
  if (!mirror.ok()) return mirror.status();
  return std::unique_ptr<ServerScene>(
      new ServerScene(*std::move(server), *std::move(connection), *std::move(mirror)));
}

ServerScene::ServerScene(std::unique_ptr<demo::ServerProcess> server,
                         std::shared_ptr<Connection> connection,
                         std::unique_ptr<SceneMirror> mirror)
    : server_(std::move(server)), sender_(std::move(connection)), mirror_(std::move(mirror)) {}

absl::StatusOr<ScenePtr> ServerScene::Push(const Frame& frame) {
  const auto ack = sender_.Push(frame);
  if (!ack.ok()) return ack.status();
  return mirror_->WaitFor(ack->version, std::chrono::seconds(10));
}

}  // namespace clearway::closed_loop
