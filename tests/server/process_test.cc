// The program itself: how it starts, refuses to start, and ends.
#include "server/process.h"

#include <gmock/gmock.h>
#include <grpcpp/support/sync_stream.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include "absl/strings/str_cat.h"
#include "clearway/client/frame_sender.h"
#include "clearway/client/scene_client.h"
#include "clearway/client/scene_mirror.h"
#include "support/eventually.h"
#include "support/frames.h"
#include "support/raw_call.h"
#include "support/relay.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using testing_support::Process;

// grpc.health.v1.Health/Check: 1 is SERVING, 2 NOT_SERVING.
int HealthOf(const std::string& address) {
  const auto channel = grpc::CreateChannel(address, grpc::InsecureChannelCredentials());
  const grpc::ByteBuffer request(nullptr, 0);
  grpc::ByteBuffer response;
  const grpc::Status status =
      testing_support::RawCall(*channel, "/grpc.health.v1.Health/Check", request, response);
  EXPECT_TRUE(status.ok()) << status.error_message();
  grpc::Slice slice;
  if (!response.DumpToSingleSlice(&slice).ok() || slice.size() != 2) return -1;
  return slice.begin()[1];
}

TEST(ServerProcess, Empty) {
  Process dut({"--listen", "127.0.0.1:0"});
  const std::string address = dut.Address();
  ASSERT_FALSE(address.empty()) << dut.RestOfOutput();
  EXPECT_EQ(HealthOf(address), 1);
  dut.Signal(SIGTERM);
  EXPECT_EQ(dut.Wait(), 0);
}

// The answer of grpc.reflection.v1alpha.ServerReflection to `list_services` (field 7), as bytes.
std::string ReflectedServices(const std::string& address) {
  const auto channel = grpc::CreateChannel(address, grpc::InsecureChannelCredentials());
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(30));
  context.set_wait_for_ready(true);
  const grpc::internal::RpcMethod method(
      "/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo",
      grpc::internal::RpcMethod::BIDI_STREAMING, channel);
  const std::unique_ptr<grpc::ClientReaderWriter<grpc::ByteBuffer, grpc::ByteBuffer>> stream(
      grpc::internal::ClientReaderWriterFactory<grpc::ByteBuffer, grpc::ByteBuffer>::Create(
          channel.get(), method, &context));
  const grpc::Slice list_services("\x3a\x00", 2);
  stream->Write(grpc::ByteBuffer(&list_services, 1));
  grpc::ByteBuffer answer;
  stream->Read(&answer);
  stream->WritesDone();
  if (!stream->Finish().ok()) return "";
  grpc::Slice bytes;
  EXPECT_TRUE(answer.DumpToSingleSlice(&bytes).ok());
  return {reinterpret_cast<const char*>(bytes.begin()), bytes.size()};
}

TEST(ServerProcess, NamesItsServicesByReflectionIfAsked) {
  Process silent({"--listen", "127.0.0.1:0"});
  EXPECT_EQ(ReflectedServices(silent.Address()), "");
  Process dut({"--listen", "127.0.0.1:0", "--reflection", "true"});
  const std::string services = ReflectedServices(dut.Address());
  for (const char* name :
       {"Ingest", "Occupancy", "Check", "Object", "Lease", "Map", "Follow", "Server"}) {
    EXPECT_THAT(services, testing::HasSubstr(absl::StrCat("clearway.v1.", name, "Service")));
  }
}

TEST(ServerProcess, DrainsWithClientsConnected) {
  Process dut({"--listen", "127.0.0.1:0", "--scene-resolution-m", "0.5"});
  const auto connection = Connection::Open(dut.Address());
  ASSERT_TRUE(connection.ok()) << connection.status();
  EXPECT_EQ((*connection)->server().params.resolution_m, 0.5);
  FrameSender sender(*connection);
  Frame frame = testing_support::FrameAt(1);
  testing_support::AddPoint(frame, kStaticLabel, {1, 0, 0});
  EXPECT_TRUE(sender.Push(frame).ok());
  EXPECT_TRUE(sender.OpenStream([](const auto&, auto, const auto&) {}).ok());
  dut.Signal(SIGTERM);
  EXPECT_EQ(dut.Wait(), 0);
}

// Over TCP, too, where the kernel would give up after the keepalive's timeout.
TEST(ServerProcess, EndsThoughAClientReadsNothing) {
  const TemporaryFolder folder;
  for (const std::string& listen :
       {std::string("127.0.0.1:0"), "unix:" + (folder / "socket").string()}) {
    Process dut({"--listen", listen, "--keepalive-time-s", "3600", "--keepalive-timeout-s", "600",
                 "--scene-resolution-m", "0.3", "--scene-object-resolution-m", "0.3"});
    const std::string address = dut.Address();
    testing_support::Relay relay(address);
    const auto connection = Connection::Open(relay.address());
    ASSERT_TRUE(connection.ok()) << connection.status();
    const auto mirror = SceneMirror::Follow(*connection);
    ASSERT_TRUE(mirror.ok()) << mirror.status();
    relay.Freeze();
    const auto other = Connection::Open(address);
    ASSERT_TRUE(other.ok()) << other.status();
    FrameSender sender(*other);
    for (std::uint64_t i = 1; i <= 20; ++i) {
      ASSERT_TRUE(sender.Push(testing_support::ScatteredFrame(i)).ok());
    }
    dut.Signal(SIGTERM);
    EXPECT_EQ(dut.Wait(), 0) << listen;
  }
}

// gRPC must not report what it found before the server was back: the next attempt is the last. In a
// process of its own, for a server's threads would look at the client's sockets as well.
TEST(ServerProcess, TheFirstAttemptAfterItIsBackSucceeds) {
  auto dut = std::make_unique<Process>(std::vector<std::string>{"--listen", "127.0.0.1:0"});
  const std::string address = dut->Address();
  const auto connection = Connection::Open(address);
  ASSERT_TRUE(connection.ok()) << connection.status();
  FrameSender sender(*connection);
  ReconnectOptions reconnect;
  reconnect.first_pause = std::chrono::seconds(1);
  reconnect.max_pause = std::chrono::seconds(4);
  reconnect.give_up_after = std::chrono::seconds(5);
  const auto ignore = [](const auto&, auto, const auto&) {};
  ASSERT_TRUE(sender.OpenStream(ignore, AckLevel::kApplied, reconnect).ok());
  ASSERT_TRUE(testing_support::Eventually([&] { return sender.state().connected; }));
  dut.reset();
  ASSERT_TRUE(testing_support::Eventually(
      [&] { return sender.state().last_error.message().find("refused") != std::string::npos; }));
  dut = std::make_unique<Process>(std::vector<std::string>{"--listen", address});
  ASSERT_EQ(dut->Address(), address);
  ASSERT_TRUE(sender.Send(testing_support::FrameAt(1)).ok());
  const absl::Status closed = sender.CloseStream();
  EXPECT_TRUE(closed.ok()) << closed;
}

TEST(ServerProcess, OnlyThreadsThatApplyFramesGiveWay) {
  const int usual = getpriority(PRIO_PROCESS, 0);
  const int giving_way = usual + 7;
  if (giving_way > 19) GTEST_SKIP() << "this test itself hardly counts";
  Process dut({"--listen", "127.0.0.1:0", "--threads", "2", "--writer-niceness",
               std::to_string(giving_way)});
  const auto connection = Connection::Open(dut.Address());
  ASSERT_TRUE(connection.ok()) << connection.status();
  ASSERT_TRUE(FrameSender(*connection).Push(testing_support::FrameAt(1)).ok());
  std::map<int, int> threads = dut.Nicenesses();
  EXPECT_EQ(threads[giving_way], 2);
  EXPECT_GT(threads[usual], 0);
  EXPECT_EQ(threads.size(), 2);
}

TEST(ServerProcess, ListensOnAUnixSocket) {
  const TemporaryFolder folder;
  Process dut({"--listen", "unix:" + (folder / "socket").string()});
  const std::string address = dut.Address();
  const auto connection = Connection::Open(address);
  ASSERT_TRUE(connection.ok()) << connection.status();
  EXPECT_TRUE(SceneClient(*connection).GetStatus().ok());
  EXPECT_EQ(std::filesystem::status(folder / "socket").permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  Process second({"--listen", address});
  EXPECT_EQ(second.Wait(), 1);
  EXPECT_TRUE(SceneClient(*connection).GetStatus().ok());
}

TEST(ServerProcess, RefusesAPortInUse) {
  Process first({"--listen", "127.0.0.1:0"});
  const std::string address = first.Address();
  Process dut({"--listen", address});
  EXPECT_EQ(dut.Address(), "");
  EXPECT_EQ(dut.Wait(), 1);
  EXPECT_THAT(dut.RestOfOutput(), testing::HasSubstr(address + " is in use"));
}

TEST(ServerProcess, RefusesUnknownFlags) {
  Process dut({"--scene-resolution", "1"});
  EXPECT_EQ(dut.Address(), "");
  EXPECT_EQ(dut.Wait(), 2);
}

TEST(ServerProcess, StartsWithVariablesOfOthersAndWarns) {
  Process dut({"--listen", "127.0.0.1:0"},
              {"CLEARWAY_SERVICE_HOST=10.0.0.1", "CLEARWAY_PORT=tcp://10.0.0.1:50151",
               "CLEARWAY_COLOUR=red"});
  EXPECT_NE(dut.Address(), "");
  dut.Signal(SIGTERM);
  EXPECT_EQ(dut.Wait(), 0);
  const std::string output = dut.RestOfOutput();
  EXPECT_THAT(output, testing::HasSubstr("CLEARWAY_SERVICE_HOST, CLEARWAY_PORT look like"));
  EXPECT_THAT(output, testing::HasSubstr("CLEARWAY_COLOUR is not a setting"));
}

TEST(ServerProcess, ListensOnAnAddressWithGrpcsPrefix) {
  Process dut({"--listen", "ipv4:127.0.0.1:0"});
  const auto connection = Connection::Open(dut.Address());
  EXPECT_TRUE(connection.ok()) << connection.status();
}

TEST(ServerProcess, RefusesToBeReachedFromElsewhereWithoutTls) {
  Process dut({"--listen", "0.0.0.0:0"});
  EXPECT_NE(dut.RestOfOutput().find("tls_cert"), std::string::npos);
  EXPECT_EQ(dut.Wait(), 2);
}

TEST(ServerProcess, PrintsItsConfiguration) {
  Process dut({"--print-config", "--threads", "3"});
  EXPECT_NE(dut.RestOfOutput().find("threads = 3"), std::string::npos);
  EXPECT_EQ(dut.Wait(), 0);
}

}  // namespace
}  // namespace clearway
