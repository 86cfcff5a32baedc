// Clients that show certificates to the program itself.
#include <gmock/gmock.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "absl/strings/str_cat.h"
#include "clearway/base/secret_file.h"
#include "clearway/client/error_details.h"
#include "clearway/client/scene_client.h"
#include "clearway/client/scene_mirror.h"
#include "server/access_matrix.h"
#include "server/certificates.h"
#include "server/process.h"
#include "support/eventually.h"

namespace clearway {
namespace {

using testing::HasSubstr;
using testing_support::AllMethods;
using testing_support::Certificates;
using testing_support::CodeOf;
using testing_support::Eventually;
using testing_support::IsCodeFor;
using testing_support::Process;
using testing_support::TokenHolder;

std::string TextOf(const std::string& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
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

  // Empty: without a certificate.
  std::shared_ptr<grpc::Channel> ChannelOf(const std::string& certificate) const {
    grpc::SslCredentialsOptions options;
    options.pem_root_certs = TextOf(files_.Cert("ours"));
    if (!certificate.empty()) {
      options.pem_cert_chain = TextOf(files_.Cert(certificate));
      options.pem_private_key = TextOf(files_.Key(certificate));
    }
    return grpc::CreateChannel(address_, grpc::SslCredentials(options));
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

TEST_F(MutualTls, EachMethodByCertificateAndToken) {
  const TokenHolder reader("reader", Role::kRead), pusher("pusher", Role::kPush),
      admin("admin", Role::kAdmin), revoked("revoked", Role::kAdmin);
  const std::string tokens = (files_.folder() / "tokens").string();
  ASSERT_TRUE(
      WriteSecretFile(tokens, absl::StrCat(reader.made.line, "\n", pusher.made.line, "\n",
                                           admin.made.line, "\n", "robot push certificate\n"))
          .ok());
  files_.Make("unknown", "ours");
  Start({"--tokens", tokens});
  const std::vector<std::string> bad_tokens = {"Bearer wrong", revoked.authorization()};
  for (const char* certificate : {"", "stranger", "expired"}) {
    const auto channel = ChannelOf(certificate);
    for (const auto* method : AllMethods()) {
      for (const std::string& authorization :
           {std::string(), bad_tokens[0], bad_tokens[1], admin.authorization()}) {
        EXPECT_EQ(CodeOf(*channel, *method, authorization), grpc::StatusCode::UNAVAILABLE)
            << method->full_name() << " " << certificate;
      }
    }
  }
  for (const char* certificate : {"robot", "unknown"}) {
    const auto channel = ChannelOf(certificate);
    for (const auto* method : AllMethods()) {
      const auto by_line = CodeOf(*channel, *method, "");
      EXPECT_TRUE(certificate == std::string("robot")
                      ? IsCodeFor(Role::kPush, *method, by_line)
                      : by_line == grpc::StatusCode::UNAUTHENTICATED)
          << method->full_name() << " " << certificate << " " << by_line;
      for (const std::string& authorization : bad_tokens) {
        EXPECT_EQ(CodeOf(*channel, *method, authorization), grpc::StatusCode::UNAUTHENTICATED)
            << method->full_name() << " " << certificate;
      }
      for (const TokenHolder* holder : {&reader, &pusher, &admin}) {
        const auto code = CodeOf(*channel, *method, holder->authorization());
        EXPECT_TRUE(IsCodeFor(holder->role, *method, code))
            << method->full_name() << " " << certificate << " " << ToText(holder->role) << " "
            << code;
      }
    }
  }
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
