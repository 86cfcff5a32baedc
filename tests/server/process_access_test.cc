// Who may do what on the program itself.
#include <gmock/gmock.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "absl/strings/str_cat.h"
#include "clearway/base/secret_file.h"
#include "clearway/client/error_details.h"
#include "clearway/client/scene_client.h"
#include "clearway/client/scene_mirror.h"
#include "clearway/v1/server_service.pb.h"
#include "clearway/wire/token_table.h"
#include "server/certificates.h"
#include "server/process.h"
#include "support/eventually.h"
#include "support/raw_call.h"

namespace clearway {
namespace {

using testing::HasSubstr;
using testing_support::Certificates;
using testing_support::Eventually;
using testing_support::Process;

// A client's name, role and token.
struct Client {
  Client(const std::string& name, Role may) : role(may), made(*MakeToken(name, may)) {}
  Role role;
  NewToken made;
};

class Access : public testing::Test {
 protected:
  void WriteTokens(const std::vector<const Client*>& clients) const {
    std::string text;
    for (const Client* client : clients) absl::StrAppend(&text, client->made.line, "\n");
    ASSERT_TRUE(WriteSecretFile(tokens_, text).ok());
  }
  void Start(std::vector<std::string> more = {}) {
    std::vector<std::string> flags{"--listen", "127.0.0.1:0", "--tokens", tokens_};
    flags.insert(flags.end(), more.begin(), more.end());
    dut_ = std::make_unique<Process>(flags);
    address_ = dut_->Address();
    ASSERT_FALSE(address_.empty()) << dut_->RestOfOutput();
  }
  absl::StatusOr<std::shared_ptr<Connection>> Connect(const Client& client) const {
    const std::string file = (folder_ / "token").string();
    EXPECT_TRUE(WriteSecretFile(file, client.made.token + "\n").ok());
    ConnectionOptions options;
    options.token_file = file;
    return Connection::Open(address_, options);
  }

  const TemporaryFolder folder_;
  const std::string tokens_ = (folder_ / "tokens").string();
  const Client reader_{"reader", Role::kRead}, pusher_{"pusher", Role::kPush},
      admin_{"admin", Role::kAdmin}, revoked_{"revoked", Role::kAdmin};
  std::unique_ptr<Process> dut_;
  std::string address_;
};

Role NeededFor(const std::string& method) {
  static const std::set<std::string> kPush = {"PushFrame", "PushFrames", "AddObjects",
                                              "RemoveObjects", "SetFutures"};
  static const std::set<std::string> kAdmin = {"Reset", "LoadPrior", "ClearRegion", "SetKeepOut"};
  return kAdmin.count(method) > 0  ? Role::kAdmin
         : kPush.count(method) > 0 ? Role::kPush
                                   : Role::kRead;
}

// All services of clearway.v1, by the files that define them.
std::vector<const google::protobuf::MethodDescriptor*> AllMethods() {
  std::vector<const google::protobuf::MethodDescriptor*> methods;
  for (const char* name :
       {"Check", "Follow", "Ingest", "Lease", "Map", "Object", "Occupancy", "Plan", "Server"}) {
    const auto* service = google::protobuf::DescriptorPool::generated_pool()->FindServiceByName(
        absl::StrCat("clearway.v1.", name, "Service"));
    EXPECT_NE(service, nullptr) << name;
    for (int i = 0; service != nullptr && i < service->method_count(); ++i) {
      methods.push_back(service->method(i));
    }
  }
  return methods;
}

grpc::StatusCode CodeOf(grpc::Channel& channel, const google::protobuf::MethodDescriptor& method,
                        const std::string& authorization) {
  const std::string path = absl::StrCat("/", method.service()->full_name(), "/", method.name());
  const grpc::Slice nothing;
  grpc::ByteBuffer request(&nothing, 1), response;
  if (method.client_streaming() || method.server_streaming()) {
    return testing_support::RawStream(channel, path.c_str(), request, authorization,
                                      std::chrono::milliseconds(500))
        .error_code();
  }
  return testing_support::RawCall(channel, path.c_str(), request, response, authorization)
      .error_code();
}

TEST_F(Access, EachMethodByRoleAndToken) {
  WriteTokens({&reader_, &pusher_, &admin_});
  Start();
  const auto channel = grpc::CreateChannel(address_, grpc::InsecureChannelCredentials());
  const auto methods = AllMethods();
  EXPECT_GE(methods.size(), 29u);
  for (const auto* method : methods) {
    for (const std::string& authorization :
         {std::string(), std::string("Bearer wrong"), "Bearer " + revoked_.made.token}) {
      EXPECT_EQ(CodeOf(*channel, *method, authorization), grpc::StatusCode::UNAUTHENTICATED)
          << method->full_name() << " " << authorization;
    }
    for (const Client* client : {&reader_, &pusher_, &admin_}) {
      const auto code = CodeOf(*channel, *method, "Bearer " + client->made.token);
      const bool may = client->role >= NeededFor(method->name());
      EXPECT_EQ(code == grpc::StatusCode::PERMISSION_DENIED, !may)
          << method->full_name() << " " << ToText(client->role) << " " << code;
      EXPECT_NE(code, grpc::StatusCode::UNAUTHENTICATED) << method->full_name();
    }
  }
  dut_->Signal(SIGTERM);
  EXPECT_EQ(dut_->Wait(), 0);
  const std::string log = dut_->RestOfOutput();
  EXPECT_THAT(log, HasSubstr("audit: Reset by admin (ipv4:127.0.0.1:"));
  EXPECT_THAT(log, HasSubstr("Reset needs the role admin; pusher has push"));
  EXPECT_THAT(log, testing::Not(HasSubstr(admin_.made.token)));
}

TEST_F(Access, ARevokedTokenEndsItsStreamsAndNoOthers) {
  WriteTokens({&reader_, &revoked_});
  Start();
  const auto kept = Connect(reader_), lost = Connect(revoked_);
  ASSERT_TRUE(kept.ok() && lost.ok()) << kept.status() << lost.status();
  const auto kept_mirror = SceneMirror::Follow(*kept), lost_mirror = SceneMirror::Follow(*lost);
  ASSERT_TRUE(kept_mirror.ok() && lost_mirror.ok());
  WriteTokens({&reader_});
  dut_->Signal(SIGHUP);
  EXPECT_TRUE(Eventually([&] { return !(*lost_mirror)->state().connected; }));
  EXPECT_TRUE(absl::IsUnauthenticated(SceneClient(*lost).GetStatus().status()));
  EXPECT_TRUE(SceneClient(*kept).GetStatus().ok());
  EXPECT_TRUE((*kept_mirror)->state().connected);
  EXPECT_EQ((*kept_mirror)->state().reconnects, 0u);
  const absl::Status again = Connect(revoked_).status();
  EXPECT_TRUE(absl::IsUnauthenticated(again)) << again;
  EXPECT_EQ(DetailsOf(again).reason, "WRONG_TOKEN");
}

TEST_F(Access, AFileThatCannotBeReadAgainChangesNothing) {
  WriteTokens({&reader_});
  Start();
  folder_.Write("tokens", "nonsense\n");
  dut_->Signal(SIGHUP);
  EXPECT_TRUE(Connect(reader_).ok());
  dut_->Signal(SIGTERM);
  EXPECT_EQ(dut_->Wait(), 0);
  EXPECT_THAT(dut_->RestOfOutput(), HasSubstr("nothing has changed: tokens: "));
}

TEST_F(Access, TokensThatOthersCanReadAreRefused) {
  WriteTokens({&reader_});
  ASSERT_EQ(chmod(tokens_.c_str(), 0644), 0);
  Process dut({"--listen", "127.0.0.1:0", "--tokens", tokens_});
  EXPECT_EQ(dut.Address(), "");
  EXPECT_EQ(dut.Wait(), 1);
  Process none({"--listen", "127.0.0.1:0", "--tokens", "/nowhere"});
  EXPECT_THAT(none.RestOfOutput(), HasSubstr("tokens: /nowhere: no such file"));
}

TEST_F(Access, TokensGoOutInPlainTextToThisMachineOnly) {
  const std::string file = (folder_ / "token").string();
  ASSERT_TRUE(WriteSecretFile(file, reader_.made.token).ok());
  ConnectionOptions options;
  options.token_file = file;
  options.deadline = options.retry_for = std::chrono::milliseconds(200);
  const absl::Status status = Connection::Open("192.0.2.1:50151", options).status();
  EXPECT_TRUE(absl::IsInvalidArgument(status)) << status;
  EXPECT_THAT(std::string(status.message()), HasSubstr("could read the token"));
  options.insecure = true;
  EXPECT_FALSE(absl::IsInvalidArgument(Connection::Open("192.0.2.1:50151", options).status()));
}

TEST_F(Access, PlainListeningElsewhereIsAskedForByName) {
  Process refused({"--listen", "0.0.0.0:0"});
  EXPECT_THAT(refused.RestOfOutput(), HasSubstr("or insecure if the network itself is safe"));
  EXPECT_EQ(refused.Wait(), 2);
  Process dut({"--listen", "0.0.0.0:0", "--insecure", "true"});
  EXPECT_NE(dut.Address(), "");
}

TEST_F(Access, ASocketsModeIsItsOwnersUnlessGiven) {
  const std::string path = (folder_ / "socket").string();
  const auto mode = [&] {
    struct stat status {};
    return stat(path.c_str(), &status) == 0 ? status.st_mode & 0777 : 0;
  };
  {
    Process dut({"--listen", "unix:" + path});
    ASSERT_NE(dut.Address(), "");
    EXPECT_EQ(mode(), 0600u);
  }
  Process dut({"--listen", "unix:" + path, "--socket-mode", "0660"});
  ASSERT_NE(dut.Address(), "");
  EXPECT_EQ(mode(), 0660u);
  Process wrong({"--socket-mode", "rw"});
  EXPECT_THAT(wrong.RestOfOutput(), HasSubstr("socket_mode: \"rw\" is not three octal digits"));
}

class MutualTls : public testing::Test {
 protected:
  void SetUp() override {
    if (!Certificates::CanBeMade()) GTEST_SKIP() << "the openssl program is missing";
    files_.MakeAuthority("ours");
    files_.MakeAuthority("other");
    files_.Make("server", "ours");
    files_.Make("robot", "ours");
    files_.Make("stranger", "other");
    files_.Make("expired", "ours", -1);
  }
  void Start(std::vector<std::string> more = {}) {
    std::vector<std::string> flags{
        "--listen",  "localhost:0",        "--tls-cert",      files_.Cert("server"),
        "--tls-key", files_.Key("server"), "--tls-client-ca", files_.Cert("ours")};
    flags.insert(flags.end(), more.begin(), more.end());
    dut_ = std::make_unique<Process>(flags);
    const std::string address = dut_->Address();
    ASSERT_FALSE(address.empty()) << dut_->RestOfOutput();
    address_ = "localhost" + address.substr(address.rfind(':'));
  }
  absl::StatusOr<std::shared_ptr<Connection>> Connect(const std::string& certificate,
                                                      const std::string& roots = "ours") const {
    ConnectionOptions options;
    options.retry_for = std::chrono::milliseconds(100);
    options.deadline = std::chrono::seconds(5);
    options.tls_root_certificates_file = files_.Cert(roots);
    if (!certificate.empty()) {
      options.tls_certificate_file = files_.Cert(certificate);
      options.tls_key_file = files_.Key(certificate);
    }
    return Connection::Open(address_, options);
  }

  const Certificates files_;
  std::unique_ptr<Process> dut_;
  std::string address_;
};

TEST_F(MutualTls, OnlyCertificatesOfTheAuthority) {
  Start();
  const auto robot = Connect("robot");
  ASSERT_TRUE(robot.ok()) << robot.status();
  EXPECT_TRUE(SceneClient(*robot).Reset().ok());
  for (const char* certificate : {"", "stranger", "expired"}) {
    const absl::Status status = Connect(certificate).status();
    EXPECT_TRUE(absl::IsUnavailable(status)) << certificate << status;
    EXPECT_EQ(DetailsOf(status).reason, "TLS");
    EXPECT_THAT(std::string(status.message()), HasSubstr("asks for a client's certificate"));
  }
}

TEST_F(MutualTls, TheFileOfTokensNamesCertificates) {
  const std::string tokens = (files_.folder() / "tokens").string();
  ASSERT_TRUE(WriteSecretFile(tokens, "robot push certificate\n").ok());
  files_.Make("unknown", "ours");
  Start({"--tokens", tokens});
  const auto robot = Connect("robot");
  ASSERT_TRUE(robot.ok()) << robot.status();
  EXPECT_TRUE(SceneClient(*robot).GetStatus().ok());
  EXPECT_TRUE(absl::IsPermissionDenied(SceneClient(*robot).Reset().status()));
  EXPECT_TRUE(absl::IsUnauthenticated(Connect("unknown").status()));
}

TEST_F(MutualTls, CertificatesAreReplacedWhileStreamsGoOn) {
  Start();
  const auto before = Connect("robot");
  ASSERT_TRUE(before.ok()) << before.status();
  const auto mirror = SceneMirror::Follow(*before);
  ASSERT_TRUE(mirror.ok()) << mirror.status();
  EXPECT_FALSE(Connect("robot", "other").ok());
  files_.Make("server", "other");
  dut_->Signal(SIGHUP);
  EXPECT_TRUE(Eventually([&] { return Connect("robot", "other").ok(); }));
  EXPECT_FALSE(Connect("robot", "ours").ok());
  EXPECT_TRUE((*mirror)->state().connected);
  EXPECT_EQ((*mirror)->state().reconnects, 0u);
  EXPECT_TRUE(SceneClient(*before).GetStatus().ok());
  // A pair that does not belong together is not taken.
  std::filesystem::copy_file(files_.Key("robot"), files_.Key("server"),
                             std::filesystem::copy_options::overwrite_existing);
  dut_->Signal(SIGHUP);
  std::this_thread::sleep_for(std::chrono::seconds(2));
  EXPECT_TRUE(Connect("robot", "other").ok());
}

TEST_F(MutualTls, ExpiredCertificatesAndOpenKeysAreRefused) {
  const auto refusal = [&](const std::string& cert, const std::string& key, const std::string& ca) {
    Process dut({"--tls-cert", cert, "--tls-key", key, "--tls-client-ca", ca});
    EXPECT_EQ(dut.Address(), "");
    const std::string output = dut.RestOfOutput();
    EXPECT_EQ(dut.Wait(), 1);
    return output;
  };
  const std::string ca = files_.Cert("ours");
  EXPECT_THAT(refusal(files_.Cert("expired"), files_.Key("expired"), ca),
              HasSubstr("tls_cert: " + files_.Cert("expired") + " has expired"));
  EXPECT_THAT(refusal(files_.Cert("server"), files_.Key("server"), files_.Cert("expired")),
              HasSubstr("tls_client_ca: " + files_.Cert("expired") + " has expired"));
  ASSERT_EQ(chmod(files_.Key("server").c_str(), 0644), 0);
  EXPECT_THAT(refusal(files_.Cert("server"), files_.Key("server"), ca),
              HasSubstr("others can read it; run 'chmod 6"));
}

}  // namespace
}  // namespace clearway
