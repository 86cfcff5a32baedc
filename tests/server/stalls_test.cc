// Clients that do not read what they asked for.
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>

#include "clearway/client/frame_sender.h"
#include "clearway/client/scene_mirror.h"
#include "clearway/v1/follow_service.grpc.pb.h"
#include "support/eventually.h"
#include "support/frames.h"
#include "support/relay.h"
#include "support/test_server.h"

namespace clearway {
namespace {

using testing_support::Eventually;
using testing_support::TestServer;

ServerConfig ImpatientConfig() {
  ServerConfig config = testing_support::SmallConfig();
  config.limits.max_stall_s = 0.3;
  return config;
}

class Stalls : public testing::Test {
 protected:
  void PushMuch() {
    FrameSender sender(server_.Connect());
    for (int i = 0; i < 20; ++i) {
      ASSERT_TRUE(sender.Push(testing_support::ScatteredFrame(++sequence_)).ok());
    }
  }

  TestServer server_{ImpatientConfig()};
  std::uint64_t sequence_ = 0;
};

TEST_F(Stalls, AStreamWhoseClientDoesNotReadEndsAndSaysWhy) {
  const auto stub = v1::FollowService::NewStub(
      grpc::CreateChannel(server_.address(), grpc::InsecureChannelCredentials()));
  grpc::ClientContext context;
  const auto stream = stub->FollowScene(&context, {});
  v1::FollowSceneResponse response;
  ASSERT_TRUE(stream->Read(&response));
  EXPECT_EQ(server_.core().follow_streams.size(), 1u);
  PushMuch();
  EXPECT_TRUE(Eventually([&] { return server_.core().follow_streams.size() == 0; }));
  while (stream->Read(&response)) {
  }
  const grpc::Status status = stream->Finish();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::UNAVAILABLE);
  EXPECT_EQ(status.error_message(), "the client read nothing for 0.3 s: the stream has ended");
}

TEST_F(Stalls, AClientWithNothingToReadMayWait) {
  const auto mirror = SceneMirror::Follow(server_.Connect());
  ASSERT_TRUE(mirror.ok()) << mirror.status();
  std::this_thread::sleep_for(std::chrono::milliseconds(800));
  EXPECT_TRUE((*mirror)->state().connected);
  EXPECT_EQ((*mirror)->state().reconnects, 0u);
}

TEST_F(Stalls, AMirrorThatStalledFollowsAgain) {
  testing_support::Relay relay(server_.address());
  ConnectionOptions options;
  const auto connection = Connection::Open(relay.address(), options);
  ASSERT_TRUE(connection.ok()) << connection.status();
  const auto mirror = SceneMirror::Follow(*connection);
  ASSERT_TRUE(mirror.ok()) << mirror.status();
  relay.Freeze();
  PushMuch();
  ASSERT_TRUE(Eventually([&] { return server_.core().follow_streams.size() == 0; }));
  relay.Thaw();
  ASSERT_TRUE(Eventually([&] {
    return (*mirror)->Latest()->version == server_.Newest()->version &&
           (*mirror)->state().connected;
  }));
  EXPECT_EQ((*mirror)->state().reconnects, 1u);
  EXPECT_EQ((*mirror)->Latest()->Hash(), server_.Newest()->Hash());
}

}  // namespace
}  // namespace clearway
