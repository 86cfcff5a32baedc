// Clients that do not read what they asked for.
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "clearway/client/frame_sender.h"
#include "clearway/client/scene_client.h"
#include "clearway/client/scene_mirror.h"
#include "clearway/v1/follow_service.grpc.pb.h"
#include "clearway/v1/occupancy_service.grpc.pb.h"
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

// Calls of one connection whose replies wait until Read.
class UnreadCalls {
 public:
  UnreadCalls(const std::string& address, int count)
      : stub_(v1::OccupancyService::NewStub(grpc::CreateCustomChannel(
            address, grpc::InsecureChannelCredentials(), AnyMessageSize()))) {
    // gRPC ends with the last of its objects, and then waits 10 s for such connections.
    [[maybe_unused]] static const auto& keeps_grpc_alive = *new grpc::CompletionQueue;
    constexpr int kPoints = 1'000'000;  // whose reply of 10 MB no window of gRPC takes
    v1::GetPointOccupancyRequest request;
    request.mutable_points_m()->Resize(3 * kPoints, 1);
    request.add_times_ns(0);
    for (int i = 0; i < count; ++i) {
      auto call = std::make_unique<Call>();
      call->reply = stub_->AsyncGetPointOccupancy(&call->context, request, &queue_);
      call->reply->ReadInitialMetadata(nullptr);  // which sends the request
      calls_.push_back(std::move(call));
    }
  }

  // Lets the connection work; reads no reply.
  void Poll() {
    void* tag = nullptr;
    bool done = false;
    queue_.AsyncNext(&tag, &done, std::chrono::system_clock::now() + std::chrono::milliseconds(1));
  }
  // Whether all were answered.
  bool Read() {
    bool ok = true;
    for (auto& call : calls_) {
      v1::GetPointOccupancyResponse response;
      grpc::Status status;
      call->reply->Finish(&response, &status, call.get());
      void* tag = nullptr;
      bool done = false;
      while (tag != call.get() && queue_.Next(&tag, &done)) {
      }
      ok = ok && status.ok() && response.statuses_size() > 0;
    }
    return ok;
  }

 private:
  static grpc::ChannelArguments AnyMessageSize() {
    grpc::ChannelArguments arguments;
    arguments.SetMaxReceiveMessageSize(-1);
    return arguments;
  }

  struct Call {
    grpc::ClientContext context;
    std::unique_ptr<grpc::ClientAsyncResponseReader<v1::GetPointOccupancyResponse>> reply;
  };
  std::unique_ptr<v1::OccupancyService::Stub> stub_;
  grpc::CompletionQueue queue_;
  std::vector<std::unique_ptr<Call>> calls_;
};

// Each takes memory and a thread.
TEST(UnreadReplies, CountAsOpenCallsUntilTheyAreRead) {
  ServerConfig config = testing_support::SmallConfig();
  config.limits.max_calls = 2;
  config.limits.max_peer_share = 1;
  const TestServer server(config);
  const OpenCalls& calls = server.core().open_calls;
  const SceneClient other(server.Connect());
  UnreadCalls unread(server.address(), 2);
  ASSERT_TRUE(Eventually([&] {
    unread.Poll();
    return calls.size() == 2 && calls.running() == 0;
  }));
  const absl::Status refused = other.GetServerInfo().status();
  EXPECT_TRUE(absl::IsResourceExhausted(refused)) << refused;
  EXPECT_TRUE(unread.Read());
  EXPECT_TRUE(Eventually([&] { return calls.size() == 0; }));
  EXPECT_TRUE(other.GetServerInfo().ok());
}

TEST(UnreadReplies, TakeMemoryUntilTheyAreRead) {
  ServerConfig config = testing_support::SmallConfig();
  config.limits.max_request_memory_bytes = 25'000'000;  // a request of 12 MB, replies of 10 MB
  const TestServer server(config);
  UnreadCalls first(server.address(), 1);
  ASSERT_TRUE(Eventually([&] {
    first.Poll();
    return server.core().open_calls.size() == 1 && server.core().open_calls.running() == 0;
  }));
  const SceneClient other(server.Connect());
  const std::vector<Eigen::Vector3f> points_W(1'000'000);
  const std::vector<Time> now(1);
  const absl::Status refused = other.OccupancyOfPoints(points_W, now).status();
  EXPECT_TRUE(absl::IsResourceExhausted(refused)) << refused;
  EXPECT_TRUE(first.Read());
  EXPECT_TRUE(Eventually([&] { return other.OccupancyOfPoints(points_W, now).ok(); }));
}

}  // namespace
}  // namespace clearway
