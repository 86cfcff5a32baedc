// The program itself with TLS, and what clients are told of certificates.
#include <gmock/gmock.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "clearway/client/error_details.h"
#include "clearway/client/scene_client.h"
#include "clearway/v1/server_service.grpc.pb.h"
#include "server/certificates.h"
#include "server/process.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using testing_support::Process;

TEST(ServerTls, ServesTls) {
  const TemporaryFolder folder;
  const std::string cert = (folder / "cert.pem").string(), key = (folder / "key.pem").string();
  const std::string make =
      "openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -days 2 -subj "
      "/CN=localhost -addext subjectAltName=DNS:localhost,IP:127.0.0.1 -keyout " +
      key + " -out " + cert + " 2>/dev/null";
  if (std::system(make.c_str()) != 0) GTEST_SKIP() << "openssl is missing";
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

TEST(ServerTls, ClientsSayThatItsCertificateHasExpired) {
  if (!testing_support::Certificates::CanBeMade()) GTEST_SKIP() << "openssl is missing";
  const testing_support::Certificates files;
  files.MakeAuthority("ours");
  files.Make("expired", "ours", -1);
  // Our own server would not start with it, but may be running when it expires.
  grpc::SslServerCredentialsOptions tls;
  tls.pem_key_cert_pairs.push_back({BytesOf(files.Key("expired")), BytesOf(files.Cert("expired"))});
  int port = 0;
  v1::ServerService::Service service;
  grpc::ServerBuilder builder;
  builder.RegisterService(&service);
  builder.AddListeningPort("localhost:0", grpc::SslServerCredentials(tls), &port);
  const auto server = builder.BuildAndStart();
  ASSERT_NE(server, nullptr);
  ConnectionOptions options;
  options.retry_for = std::chrono::milliseconds(200);
  options.tls_root_certificates_file = files.Cert("ours");
  const auto connection = Connection::Open(absl::StrCat("localhost:", port), options);
  EXPECT_THAT(std::string(connection.status().message()), testing::HasSubstr("has expired"));
}

TEST(ServerTls, RefusesAKeyOfAnotherCertificate) {
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

TEST(ServerTls, RefusesCertificatesThatCannotBeRead) {
  Process dut({"--listen", "0.0.0.0:0", "--tls-cert", "/nowhere", "--tls-key", "/nowhere"});
  EXPECT_NE(dut.RestOfOutput().find("tls_cert"), std::string::npos);
  EXPECT_EQ(dut.Wait(), 1);
}

}  // namespace
}  // namespace clearway
