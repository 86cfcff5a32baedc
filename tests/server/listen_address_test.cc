#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "server/listeners.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string Refusal(const std::string& text) {
  const absl::Status status = ParseListenAddress(text).status();
  EXPECT_TRUE(absl::IsInvalidArgument(status)) << text << ": " << status;
  EXPECT_THAT(std::string(status.message()), StartsWith("listen: "));
  return std::string(status.message());
}

absl::Status Check(const std::string& text) {
  auto address = ParseListenAddress(text);
  EXPECT_TRUE(address.ok()) << address.status();
  const absl::Status status = address.ok() ? Listen(*address, {}).status() : address.status();
  EXPECT_TRUE(status.ok() || std::string(status.message()).starts_with("listen: ")) << status;
  return status;
}

void ExpectError(const absl::Status& status, absl::StatusCode code, const std::string& part) {
  EXPECT_EQ(status.code(), code) << status;
  EXPECT_THAT(std::string(status.message()), HasSubstr(part));
}

// A socket that listens, until the end of the test.
class Listener {
 public:
  // On a free port of the address.
  explicit Listener(const char* address) {
    sockaddr_in ipv4{};
    ipv4.sin_family = AF_INET;
    EXPECT_EQ(inet_pton(AF_INET, address, &ipv4.sin_addr), 1);
    Listen(AF_INET, ipv4);
    socklen_t size = sizeof ipv4;
    getsockname(fd_, reinterpret_cast<sockaddr*>(&ipv4), &size);
    port_ = ntohs(ipv4.sin_port);
  }
  explicit Listener(const std::filesystem::path& path) {
    sockaddr_un local{};
    local.sun_family = AF_UNIX;
    path.string().copy(local.sun_path, sizeof local.sun_path - 1);
    Listen(AF_UNIX, local);
  }
  ~Listener() { close(fd_); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  std::string port() const { return std::to_string(port_); }

 private:
  template <class Address>
  void Listen(int family, const Address& address) {
    fd_ = socket(family, SOCK_STREAM | SOCK_CLOEXEC, 0);
    EXPECT_EQ(bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(listen(fd_, 1), 0);
  }

  int fd_ = -1;
  int port_ = 0;
};

TEST(ListenAddress, Empty) { EXPECT_THAT(Refusal(""), HasSubstr("missing")); }

TEST(ListenAddress, IsWrittenAsGrpcWritesIt) {
  for (const auto& [text, written] : std::vector<std::pair<std::string, std::string>>{
           {"127.0.0.1:50151", "127.0.0.1:50151"},
           {"ipv4:127.0.0.1:50200", "127.0.0.1:50200"},
           {"ipv6:[::1]:7", "[::1]:7"},
           {"[::]:0", "[::]:0"},
           {"dns:localhost:65535", "localhost:65535"},
           {"dns:///localhost:1", "localhost:1"},
           {"unix:/run/a b.sock", "unix:/run/a b.sock"},
           {"unix:///run/a:1", "unix:/run/a:1"},
           {"unix:relative", "unix:relative"}}) {
    const auto dut = ParseListenAddress(text);
    ASSERT_TRUE(dut.ok()) << text << ": " << dut.status();
    EXPECT_EQ(dut->ToString(), written);
  }
}

TEST(ListenAddress, RefusesWhatIsNone) {
  EXPECT_THAT(Refusal("nonsense"), HasSubstr("neither host:port nor unix:/path"));
  EXPECT_THAT(Refusal("50151"), HasSubstr("neither host:port nor unix:/path"));
  EXPECT_THAT(Refusal("http://localhost:1"), HasSubstr("neither host:port nor unix:/path"));
  EXPECT_THAT(Refusal("/run/clearway.sock"), HasSubstr("neither host:port nor unix:/path"));
  EXPECT_THAT(Refusal("http://localhost:1/x"), HasSubstr("write localhost:1"));
  EXPECT_THAT(Refusal("/run/clearway.sock"), HasSubstr("write unix:/run/clearway.sock"));
  EXPECT_THAT(Refusal("local host:1"), HasSubstr("the host holds a blank"));
  EXPECT_THAT(Refusal("localhost:70000"),
              HasSubstr("port 70000 is out of range; the limit is 65535"));
  EXPECT_THAT(Refusal("localhost:99999999999"), HasSubstr("out of range"));
  for (const char* port : {"", "http", "-1", "+1", " 1", "1 ", "0x10", "1.5"}) {
    EXPECT_THAT(Refusal(std::string("localhost:") + port), HasSubstr("is not a number"));
  }
  EXPECT_THAT(Refusal(":50151"), HasSubstr("names no host"));
  EXPECT_THAT(Refusal("ipv4::50151"), HasSubstr("names no host"));
  for (const char* ipv6 : {"::1:5", "[::1]", "[::1:5", "::1]:5", "[127.0.0.1]:5"}) {
    EXPECT_THAT(Refusal(ipv6), HasSubstr("[address]:port")) << ipv6;
  }
  for (const char* host : {"256.1.1.1", "127.1", "2130706433", "1.2.3.4.5", "1.2.3."}) {
    EXPECT_THAT(Refusal(std::string(host) + ":5"),
                HasSubstr(std::string(host) + " is not an IPv4 address"))
        << host;
  }
  EXPECT_THAT(Refusal("unix:"), HasSubstr("names no path"));
  EXPECT_THAT(Refusal("unix://run/x"), HasSubstr("unix:/absolute"));
  const std::string most = "/" + std::string(106, 'x');
  EXPECT_TRUE(ParseListenAddress("unix:" + most).ok());
  EXPECT_THAT(Refusal("unix:" + most + "x"), HasSubstr("has 108 bytes; the limit is 107"));
}

TEST(ListenAddress, KnowsWhatOnlyThisMachineReaches) {
  for (const char* local :
       {"127.0.0.1:0", "ipv4:127.0.0.2:0", "localhost:1", "LocalHost:1", "[::1]:5",
        "ipv6:[0:0:0:0:0:0:0:1]:5", "[::ffff:127.0.0.1]:5", "unix:/tmp/x"}) {
    EXPECT_TRUE(ParseListenAddress(local)->IsLocal()) << local;
  }
  for (const char* open : {"0.0.0.0:1", "[::]:1", "127.example.org:1", "10.0.0.1:1",
                           "example.org:1", "[::ffff:10.0.0.1]:1"}) {
    EXPECT_FALSE(ParseListenAddress(open)->IsLocal()) << open;
  }
}

TEST(ListenAddress, FreeOnesCanBeListenedOn) {
  const TemporaryFolder folder;
  EXPECT_TRUE(Check("127.0.0.1:0").ok());
  EXPECT_TRUE(Check("localhost:0").ok());
  EXPECT_TRUE(Check("unix:" + (folder / "socket").string()).ok());
}

TEST(ListenAddress, PortsInUse) {
  const Listener other("127.0.0.1");
  for (const char* host : {"127.0.0.1", "0.0.0.0", "localhost"}) {
    ExpectError(Check(std::string(host) + ":" + other.port()), absl::StatusCode::kAlreadyExists,
                "is in use");
  }
}

TEST(ListenAddress, HostsThatAreNotOurs) {
  // Of the range for documentation: nobody's.
  ExpectError(Check("192.0.2.1:0"), absl::StatusCode::kNotFound,
              "192.0.2.1 is not an address of this machine");
  ExpectError(Check("nobody.invalid:0"), absl::StatusCode::kNotFound,
              "cannot resolve host nobody.invalid");
}

TEST(ListenAddress, FoldersOfSockets) {
  const TemporaryFolder folder;
  ExpectError(Check("unix:" + (folder / "missing/socket").string()), absl::StatusCode::kNotFound,
              "No such file or directory");
  const std::string file = folder.Write("file", "x").string();
  EXPECT_THAT(std::string(Check("unix:" + file + "/socket").message()), HasSubstr("not a "));
  ExpectError(Check("unix:" + file), absl::StatusCode::kAlreadyExists,
              "exists and is not a socket");
  ExpectError(Check("unix:" + (folder / "").string()), absl::StatusCode::kAlreadyExists,
              "exists and is not a socket");
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const std::filesystem::path closed = folder / "closed";
  ASSERT_EQ(mkdir(closed.c_str(), 0500), 0);
  ExpectError(Check("unix:" + (closed / "socket").string()), absl::StatusCode::kPermissionDenied,
              "Permission denied");
}

TEST(ListenAddress, SocketsOfOtherServersAreLeftAloneAndOldOnesReplaced) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "socket";
  {
    const Listener other(path);
    ExpectError(Check("unix:" + path.string()), absl::StatusCode::kAlreadyExists,
                "another server listens on unix:" + path.string());
  }
  ASSERT_TRUE(std::filesystem::exists(path));
  EXPECT_TRUE(Check("unix:" + path.string()).ok());
}

TEST(ListenAddress, SocketsOfOtherProgramsAreLeftAlone) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "socket";
  sockaddr_un local{};
  local.sun_family = AF_UNIX;
  path.string().copy(local.sun_path, sizeof local.sun_path - 1);
  const int datagrams = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  ASSERT_EQ(bind(datagrams, reinterpret_cast<const sockaddr*>(&local), sizeof local), 0);
  ExpectError(Check("unix:" + path.string()), absl::StatusCode::kAlreadyExists,
              "another program holds unix:" + path.string());
  close(datagrams);
  EXPECT_TRUE(Check("unix:" + path.string()).ok());
}

// A connection that had to wait for them would wait for ever.
TEST(ListenAddress, AListenerThatIsBusyListens) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "socket";
  const Listener other(path);
  sockaddr_un local{};
  local.sun_family = AF_UNIX;
  path.string().copy(local.sun_path, sizeof local.sun_path - 1);
  std::vector<int> waiting;
  int connected = 0;
  while (connected == 0) {
    waiting.push_back(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    connected = connect(waiting.back(), reinterpret_cast<const sockaddr*>(&local), sizeof local);
  }
  ExpectError(Check("unix:" + path.string()), absl::StatusCode::kAlreadyExists,
              "another server listens on unix:" + path.string());
  for (const int client : waiting) close(client);
}

}  // namespace
}  // namespace clearway
