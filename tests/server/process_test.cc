// The program itself: how it starts, refuses to start, and ends.
#include <gmock/gmock.h>
#include <grpcpp/support/sync_stream.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "absl/strings/str_cat.h"
#include "clearway/client/error_details.h"
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

// A running clearway-server with its output in a pipe. One thread.
class Process {
 public:
  explicit Process(std::vector<std::string> arguments, std::vector<std::string> environment = {}) {
    arguments.insert(arguments.begin(), CLEARWAY_SERVER_PROGRAM);
    std::array<int, 2> pipe_ends{};
    EXPECT_EQ(pipe(pipe_ends.data()), 0);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDERR_FILENO);
    posix_spawn_file_actions_addclose(&actions, pipe_ends[0]);
    posix_spawn_file_actions_addclose(&actions, pipe_ends[1]);
    EXPECT_EQ(posix_spawn(&id_, CLEARWAY_SERVER_PROGRAM, &actions, nullptr,
                          Pointers(arguments).data(), Pointers(environment).data()),
              0);
    posix_spawn_file_actions_destroy(&actions);
    close(pipe_ends[1]);
    output_ = fdopen(pipe_ends[0], "r");
  }
  ~Process() {
    if (!ended_) {
      kill(id_, SIGKILL);
      Wait();
    }
    fclose(output_);
  }

  // Where it listens; empty if it ended instead.
  std::string Address() {
    std::string line;
    while (ReadLine(line)) {
      const std::string sign = "listening on ";
      if (line.rfind(sign, 0) == 0) return line.substr(sign.size());
    }
    return "";
  }
  std::string RestOfOutput() {
    std::string line, all = seen_;
    while (ReadLine(line)) all += line + "\n";
    return all;
  }
  void Signal(int signal) const { kill(id_, signal); }
  // How many of its threads have each niceness.
  std::map<int, int> Nicenesses() const {
    std::map<int, int> threads;
    const std::string folder = absl::StrCat("/proc/", id_, "/task");
    for (const auto& task : std::filesystem::directory_iterator(folder)) {
      const int thread = std::stoi(task.path().filename());
      ++threads[getpriority(PRIO_PROCESS, static_cast<id_t>(thread))];
    }
    return threads;
  }
  // The exit code; -1 if a signal ended it.
  int Wait() {
    int status = 0;
    waitpid(id_, &status, 0);
    ended_ = true;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  static std::vector<char*> Pointers(std::vector<std::string>& texts) {
    std::vector<char*> pointers;
    for (std::string& text : texts) pointers.push_back(text.data());
    pointers.push_back(nullptr);
    return pointers;
  }
  bool ReadLine(std::string& line) {
    line.clear();
    for (int c = fgetc(output_); c != EOF; c = fgetc(output_)) {
      if (c == '\n') {
        seen_ += line + "\n";
        return true;
      }
      line += static_cast<char>(c);
    }
    return false;
  }

  pid_t id_ = 0;
  FILE* output_ = nullptr;
  std::string seen_;
  bool ended_ = false;
};

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
  EXPECT_TRUE(stream->Read(&answer));
  stream->WritesDone();
  EXPECT_TRUE(stream->Finish().ok());
  grpc::Slice bytes;
  EXPECT_TRUE(answer.DumpToSingleSlice(&bytes).ok());
  return {reinterpret_cast<const char*>(bytes.begin()), bytes.size()};
}

TEST(ServerProcess, NamesItsServicesByReflection) {
  Process dut({"--listen", "127.0.0.1:0"});
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

TEST(ServerProcess, ServesTls) {
  const TemporaryFolder folder;
  const std::string cert = (folder / "cert.pem").string(), key = (folder / "key.pem").string();
  const std::string make =
      "openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -days 2 -subj "
      "/CN=localhost -addext subjectAltName=DNS:localhost,IP:127.0.0.1 -keyout " +
      key + " -out " + cert + " 2>/dev/null";
  if (std::system(make.c_str()) != 0) {
    std::printf("openssl is missing: TLS was not tried\n");
    return;
  }
  Process dut({"--listen", "0.0.0.0:0", "--tls-cert", cert, "--tls-key", key});
  const std::string address = dut.Address();
  ASSERT_FALSE(address.empty()) << dut.RestOfOutput();
  const std::string port = address.substr(address.rfind(':'));
  ConnectionOptions options;
  options.retry_for = std::chrono::milliseconds(200);
  const auto refusal = [&](const std::string& where) {
    const absl::Status status = Connection::Open(where, options).status();
    EXPECT_TRUE(absl::IsUnavailable(status)) << status;
    EXPECT_EQ(DetailsOf(status).reason, "TLS");
    return std::string(status.message());
  };
  EXPECT_THAT(refusal("localhost" + port), testing::HasSubstr("it seems to expect TLS"));
  options.tls_root_certificates_file = cert;
  const auto connection = Connection::Open("localhost" + port, options);
  ASSERT_TRUE(connection.ok()) << connection.status();
  EXPECT_TRUE(SceneClient(*connection).GetStatus().ok());
  EXPECT_THAT(refusal("127.0.0.2" + port), testing::HasSubstr("is not for the host 127.0.0.2"));
  Process plain({"--listen", "127.0.0.1:0"});
  EXPECT_THAT(refusal(plain.Address()), testing::HasSubstr("it seems not to speak TLS"));
  ASSERT_EQ(std::system(absl::StrCat("openssl req -x509 -newkey ec -pkeyopt ",
                                     "ec_paramgen_curve:P-256 -nodes -subj /CN=other -keyout ", key,
                                     "2 -out ", cert, "2 2>/dev/null")
                            .c_str()),
            0);
  options.tls_root_certificates_file = cert + "2";
  EXPECT_THAT(refusal("localhost" + port), testing::HasSubstr("was not signed by an authority of"));
  const std::string whole = BytesOf(cert);
  for (const auto& [bytes, part] : std::vector<std::pair<std::string, std::string>>{
           {"words", "holds no certificate in PEM"},
           {BytesOf(key), "holds a private key and no certificate"},
           {whole.substr(0, whole.size() / 2), "certificate 1 cannot be read"}}) {
    options.tls_root_certificates_file = folder.Write("roots.pem", bytes).string();
    const absl::Status status = Connection::Open(address, options).status();
    EXPECT_TRUE(absl::IsInvalidArgument(status)) << status;
    EXPECT_THAT(std::string(status.message()), testing::HasSubstr(part));
  }
  options.tls_root_certificates_file = (folder / "missing.pem").string();
  EXPECT_TRUE(absl::IsNotFound(Connection::Open(address, options).status()));
}

TEST(ServerProcess, ClientsSayThatItsCertificateHasExpired) {
  const TemporaryFolder folder;
  const std::string cert = (folder / "cert.pem").string(), key = (folder / "key.pem").string();
  const std::string request = (folder / "request.pem").string();
  const std::string make =
      "openssl req -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -subj /CN=localhost "
      "-keyout " +
      key + " -out " + request + " 2>/dev/null && openssl x509 -req -in " + request + " -signkey " +
      key + " -days -1 -out " + cert + " 2>/dev/null";
  if (std::system(make.c_str()) != 0) GTEST_SKIP() << "openssl is missing";
  Process dut({"--listen", "127.0.0.1:0", "--tls-cert", cert, "--tls-key", key});
  const std::string address = dut.Address();
  ASSERT_FALSE(address.empty()) << dut.RestOfOutput();
  ConnectionOptions options;
  options.retry_for = std::chrono::milliseconds(200);
  options.tls_root_certificates_file = cert;
  const std::string port = address.substr(address.rfind(':'));
  EXPECT_THAT(std::string(Connection::Open("localhost" + port, options).status().message()),
              testing::HasSubstr("has expired"));
}

TEST(ServerProcess, RefusesAKeyOfAnotherCertificate) {
  const TemporaryFolder folder;
  for (const char* name : {"ours", "other"}) {
    const std::string path = (folder / name).string();
    const std::string make =
        "openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -subj /CN=localhost "
        "-keyout " +
        path + ".key -out " + path + ".cert 2>/dev/null";
    if (std::system(make.c_str()) != 0) GTEST_SKIP() << "openssl is missing";
  }
  Process dut({"--listen", "127.0.0.1:0", "--tls-cert", (folder / "ours.cert").string(),
               "--tls-key", (folder / "other.key").string()});
  EXPECT_EQ(dut.Address(), "");
  EXPECT_THAT(dut.RestOfOutput(), testing::HasSubstr("other.key does not belong to tls_cert"));
  EXPECT_EQ(dut.Wait(), 1);
}

TEST(ServerProcess, RefusesCertificatesThatCannotBeRead) {
  Process dut({"--listen", "0.0.0.0:0", "--tls-cert", "/nowhere", "--tls-key", "/nowhere"});
  EXPECT_NE(dut.RestOfOutput().find("tls_cert"), std::string::npos);
  EXPECT_EQ(dut.Wait(), 1);
}

TEST(ServerProcess, PrintsItsConfiguration) {
  Process dut({"--print-config", "--threads", "3"});
  EXPECT_NE(dut.RestOfOutput().find("threads = 3"), std::string::npos);
  EXPECT_EQ(dut.Wait(), 0);
}

}  // namespace
}  // namespace clearway
