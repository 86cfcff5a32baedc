// A scene on a server, as a robot's computer sees it.
#pragma once

#include <memory>
#include <string>

#include "clearway/client/frame_sender.h"
#include "clearway/client/scene_mirror.h"
#include "closed_loop/scene_feed.h"
#include "demo/server_process.h"

namespace clearway::closed_loop {

// Scans go to a server of our own, its scene comes back by a mirror. One thread.
class ServerScene : public SceneFeed {
 public:
  // Starts the server's program with LoopSceneParams.
  static absl::StatusOr<std::unique_ptr<ServerScene>> Start(const std::string& binary);
  absl::StatusOr<ScenePtr> Push(const Frame& frame) override;

 private:
  ServerScene(std::unique_ptr<demo::ServerProcess> server, std::shared_ptr<Connection> connection,
              std::unique_ptr<SceneMirror> mirror);

  std::unique_ptr<demo::ServerProcess> server_;  // ends last
  FrameSender sender_;
  std::unique_ptr<SceneMirror> mirror_;
};

}  // namespace clearway::closed_loop
