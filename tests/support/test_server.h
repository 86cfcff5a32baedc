// A server in the test's own process, and what talks to it.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>

#include "clearway/client/connection.h"
#include "server/core.h"
#include "server/server.h"

namespace clearway::testing_support {

inline ServerConfig SmallConfig() {
  ServerConfig config;
  config.listen = "127.0.0.1:0";
  config.threads = 1;
  config.scene.resolution_m = config.scene.object_resolution_m = 0.2;
  config.limits.max_version_wait_s = 0.2;
  return config;
}

// Runs from construction on. One thread.
class TestServer {
 public:
  explicit TestServer(const ServerConfig& config = SmallConfig()) {
    auto started = Server::Start(config);
    EXPECT_TRUE(started.ok()) << started.status();
    server_ = std::move(*started);
  }

  std::shared_ptr<Connection> Connect(const ConnectionOptions& options = {}) const {
    auto connection = Connection::Open(server_->address(), options);
    EXPECT_TRUE(connection.ok()) << connection.status();
    return connection.ok() ? *connection : nullptr;
  }
  const std::string& address() const { return server_->address(); }
  ServerCore& core() const { return server_->core(); }
  ScenePtr Newest() const { return core().versions.Newest(); }
  void Drain() { server_->Drain(); }
  void Stop() { server_.reset(); }

 private:
  std::unique_ptr<Server> server_;
};

}  // namespace clearway::testing_support
