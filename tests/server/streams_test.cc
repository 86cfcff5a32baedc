// What keeps streams alive, and what ends them.
#include <arpa/inet.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <string>
#include <thread>

#include "clearway/v1/check_service.grpc.pb.h"
#include "clearway/v1/follow_service.grpc.pb.h"
#include "support/test_server.h"
#include "wire/geometry_wire.h"
#include "wire/robot_wire.h"

namespace clearway {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing_support::TestServer;

// The least of HTTP/2: a connection without streams that pings.
class Pinger {
 public:
  explicit Pinger(const std::string& server_address) {
    fd_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(
        std::stoi(server_address.substr(server_address.rfind(':') + 1))));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    Send("PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" + FrameOf(kSettings, ""));
  }
  ~Pinger() { close(fd_); }
  Pinger(const Pinger&) = delete;
  Pinger& operator=(const Pinger&) = delete;

  void Ping() { Send(FrameOf(kPing, "12345678")); }
  // Reads until so many pings were answered in all, the server says goodbye, or it falls silent.
  void ReadAnswers(int answers) {
    while (answered_ < answers && !goodbye_ && ReadFrame()) {
    }
  }
  int answered() const { return answered_; }
  bool goodbye() const { return goodbye_; }  // GOAWAY, or the connection closed

 private:
  static constexpr char kSettings = 4, kPing = 6, kGoAway = 7;

  static std::string FrameOf(char type, const std::string& payload) {
    std::string frame(9, '\0');  // without flags, of the connection itself
    frame[2] = static_cast<char>(payload.size());
    frame[3] = type;
    frame.append(payload);
    return frame;
  }
  void Send(const std::string& bytes) {
    if (send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL) < 0) goodbye_ = true;
  }
  bool Receive(std::string& bytes, std::size_t size) {
    bytes.assign(size, '\0');
    for (std::size_t got = 0; got < size;) {
      pollfd polled{fd_, POLLIN, 0};
      if (poll(&polled, 1, 30'000) != 1) return false;
      const ssize_t part = recv(fd_, bytes.data() + got, size - got, 0);
      if (part <= 0) {
        goodbye_ = true;
        return false;
      }
      got += static_cast<std::size_t>(part);
    }
    return true;
  }
  bool ReadFrame() {
    std::string header, payload;
    if (!Receive(header, 9)) return false;
    const auto byte = [&](int i) { return static_cast<unsigned char>(header[i]); };
    if (!Receive(payload, (byte(0) << 16) + (byte(1) << 8) + byte(2))) return false;
    answered_ += header[3] == kPing && header[4] == 1;
    goodbye_ = goodbye_ || header[3] == kGoAway;
    return true;
  }

  int fd_ = -1;
  int answered_ = 0;
  bool goodbye_ = false;
};

ServerConfig PingableEvery(Duration interval) {
  ServerConfig config = testing_support::SmallConfig();
  config.keepalive.min_client_ping = interval;
  return config;
}

// Behind NATs and on Wi-Fi clients ping every 5 to 10 s; dead ones are dropped within a minute.
TEST(ServerStreams, EmptyConfiguration) {
  const KeepaliveConfig dut;
  EXPECT_LT(dut.min_client_ping, milliseconds(4500));
  EXPECT_LT(dut.time + dut.timeout, seconds(50));
}

TEST(ServerStreams, ClientsMayPingWithoutCallsAsOftenAsAllowed) {
  const TestServer server(PingableEvery(milliseconds(100)));
  Pinger client(server.address());
  for (int i = 1; i <= 12; ++i) {
    client.Ping();
    client.ReadAnswers(i);
    std::this_thread::sleep_for(milliseconds(150));
  }
  EXPECT_EQ(client.answered(), 12);
  EXPECT_FALSE(client.goodbye());
}

TEST(ServerStreams, ClientsThatPingTooOftenAreDisconnected) {
  const TestServer server(PingableEvery(seconds(100)));
  Pinger client(server.address());
  for (int i = 1; i <= 12; ++i) client.Ping();
  client.ReadAnswers(1'000);  // until the end
  EXPECT_TRUE(client.goodbye());
}

TEST(ServerStreams, AFollowerIsToldThatItsVersionIsTheNewest) {
  const TestServer server;
  const auto stub = v1::FollowService::NewStub(
      grpc::CreateChannel(server.address(), grpc::InsecureChannelCredentials()));
  v1::FollowSceneRequest request;
  request.set_from_version(1);
  request.set_server_instance(server.core().instance);
  request.set_heartbeat_s(0.1);
  grpc::ClientContext context;
  const auto stream = stub->FollowScene(&context, request);
  for (int i = 0; i < 3; ++i) {
    v1::FollowSceneResponse response;
    ASSERT_TRUE(stream->Read(&response));
    EXPECT_FALSE(response.has_delta());
    EXPECT_EQ(response.scene().version(), 1u);
    EXPECT_EQ(response.server_instance(), server.core().instance);
  }
  context.TryCancel();
  (void)stream->Finish();
}

TEST(ServerStreams, RefusesHeartbeatsOutOfRange) {
  const TestServer server;
  const auto stub = v1::FollowService::NewStub(
      grpc::CreateChannel(server.address(), grpc::InsecureChannelCredentials()));
  for (const double bad : {-1.0, 0.09, 3601.0, std::numeric_limits<double>::quiet_NaN()}) {
    v1::FollowSceneRequest request;
    request.set_heartbeat_s(bad);
    grpc::ClientContext context;
    const auto stream = stub->FollowScene(&context, request);
    v1::FollowSceneResponse response;
    EXPECT_FALSE(stream->Read(&response));
    const grpc::Status status = stream->Finish();
    EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT) << bad;
    EXPECT_EQ(status.error_message().rfind("heartbeat_s", 0), 0u) << status.error_message();
  }
}

class WatchStream : public testing::Test {
 protected:
  static ServerConfig Config() {
    ServerConfig config = testing_support::SmallConfig();
    config.limits.max_robots = 1;
    return config;
  }
  std::string Register(const Robot& robot) {
    v1::RegisterRobotRequest request;
    Write(robot, request.mutable_robot());
    v1::RegisterRobotResponse response;
    grpc::ClientContext context;
    EXPECT_TRUE(stub_->RegisterRobot(&context, request, &response).ok());
    return response.robot_id();
  }

  TestServer server_{Config()};
  std::unique_ptr<v1::CheckService::Stub> stub_ = v1::CheckService::NewStub(
      grpc::CreateChannel(server_.address(), grpc::InsecureChannelCredentials()));
};

TEST_F(WatchStream, GoesOnWhenItsRobotIsForgotten) {
  v1::WatchMotionsRequest request;
  v1::CheckMotionsRequest& motion = *request.mutable_motions();
  motion.set_robot_id(Register(Robot::SingleShape("ball", Sphere{0.2})));
  motion.mutable_options()->set_unknown_space(v1::UNKNOWN_SPACE_POLICY_FREE);
  motion.add_knot_counts(2);
  for (const int second : {100, 101}) {
    motion.add_times_ns(second * std::int64_t{1'000'000'000});
    Append(Pose{}, motion.mutable_world_from_link());
  }
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + seconds(60));
  const auto stream = stub_->WatchMotions(&context, request);
  v1::WatchMotionsResponse response;
  ASSERT_TRUE(stream->Read(&response));
  Register(Robot::SingleShape("other", Sphere{0.3}));
  GivenObject post;
  post.id = 1;
  post.shape = Sphere{1};
  ASSERT_TRUE(
      server_.core()
          .ingestor
          .Apply([&](SceneBuilder& builder) { return builder.AddObjects(std::span(&post, 1)); },
                 Ingestor::Effect::kAdds)
          .ok());
  ASSERT_TRUE(stream->Read(&response)) << stream->Finish().error_message();
  ASSERT_EQ(response.broken_size(), 1);
  EXPECT_EQ(response.broken(0), 0u);
  context.TryCancel();
  (void)stream->Finish();
}

}  // namespace
}  // namespace clearway
