#include "client/credentials.h"

#include <grpcpp/support/client_interceptor.h>

#include <algorithm>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "clearway/base/file.h"
#include "clearway/base/secret_file.h"
#include "wire/pem.h"

namespace clearway {
namespace {

constexpr std::uint64_t kMaxBytes = 16'000'000;
constexpr std::size_t kMaxToken = 1024;

absl::Status Bad(const char* option, const std::string& what) {
  return absl::InvalidArgumentError(absl::StrCat(option, ": ", what));
}

absl::StatusOr<std::string> ReadNamed(const char* option, const std::string& path,
                                      absl::StatusOr<std::string> bytes) {
  if (!bytes.ok()) {
    return absl::Status(bytes.status().code(),
                        absl::StrCat(option, ": ", bytes.status().message()));
  }
  if (bytes->empty()) return Bad(option, absl::StrCat(path, ": is empty"));
  return bytes;
}

absl::StatusOr<std::string> ReadCertificateFile(const char* option, const std::string& path) {
  auto pem = ReadNamed(option, path, ReadWholeFile(path, kMaxBytes));
  if (!pem.ok()) return pem;
  const auto certificates = ReadCertificates(absl::StrCat(option, ": ", path), *pem);
  return certificates.ok() ? pem : certificates.status();
}

absl::StatusOr<std::string> ReadToken(const std::string& path) {
  const auto text = ReadNamed("token_file", path, ReadSecretFile(path, kMaxBytes));
  if (!text.ok()) return text;
  std::string token(absl::StripAsciiWhitespace(*text));
  if (!token.empty() && token.size() <= kMaxToken &&
      std::ranges::all_of(token, [](unsigned char c) { return absl::ascii_isgraph(c); })) {
    return token;
  }
  return Bad("token_file", absl::StrCat(path, ": must hold one token, and nothing else"));
}

absl::StatusOr<std::shared_ptr<grpc::ChannelCredentials>> ReadTls(
    const ConnectionOptions& options) {
  grpc::SslCredentialsOptions tls;
  auto roots =
      ReadCertificateFile("tls_root_certificates_file", options.tls_root_certificates_file);
  if (!roots.ok()) return roots.status();
  tls.pem_root_certs = *std::move(roots);
  if (options.tls_certificate_file.empty()) return grpc::SslCredentials(tls);
  auto certificate = ReadCertificateFile("tls_certificate_file", options.tls_certificate_file);
  if (!certificate.ok()) return certificate.status();
  auto key = ReadNamed("tls_key_file", options.tls_key_file,
                       ReadSecretFile(options.tls_key_file, kMaxBytes));
  if (!key.ok()) return key.status();
  tls.pem_cert_chain = *std::move(certificate);
  tls.pem_private_key = *std::move(key);
  return grpc::SslCredentials(tls);
}

class ShowToken : public grpc::experimental::Interceptor {
 public:
  explicit ShowToken(const std::string& authorization) : authorization_(authorization) {}
  void Intercept(grpc::experimental::InterceptorBatchMethods* methods) override {
    using grpc::experimental::InterceptionHookPoints;
    if (methods->QueryInterceptionHookPoint(InterceptionHookPoints::PRE_SEND_INITIAL_METADATA)) {
      methods->GetSendInitialMetadata()->emplace("authorization", authorization_);
    }
    methods->Proceed();
  }

 private:
  const std::string& authorization_;
};

class ShowTokenFactory : public grpc::experimental::ClientInterceptorFactoryInterface {
 public:
  explicit ShowTokenFactory(const std::string& token) : authorization_("Bearer " + token) {}
  grpc::experimental::Interceptor* CreateClientInterceptor(
      grpc::experimental::ClientRpcInfo*) override {
    return new ShowToken(authorization_);  // gRPC takes it over; the channel outlives its calls
  }

 private:
  const std::string authorization_;
};

}  // namespace

bool IsThisMachine(const ServerAddress& address) {
  return !address.socket_path.empty() || address.host == "localhost" || address.host == "::1" ||
         address.host.starts_with("127.");
}

absl::StatusOr<ClientCredentials> ReadCredentials(const ConnectionOptions& options,
                                                  const ServerAddress& address) {
  const bool plain = options.tls_root_certificates_file.empty();
  if (options.tls_certificate_file.empty() != options.tls_key_file.empty()) {
    return Bad("tls_key_file", "tls_certificate_file and tls_key_file belong together");
  }
  if (plain && !options.tls_certificate_file.empty()) {
    return Bad("tls_certificate_file", "needs TLS: tls_root_certificates_file is not given");
  }
  ClientCredentials credentials{grpc::InsecureChannelCredentials(), ""};
  if (!plain) {
    auto tls = ReadTls(options);
    if (!tls.ok()) return tls.status();
    credentials.channel = *std::move(tls);
  }
  if (options.token_file.empty()) return credentials;
  if (plain && !options.insecure && !IsThisMachine(address)) {
    return Bad("token_file", absl::StrCat("everybody on the way to ", address.ToString(),
                                          " could read the token: use TLS, or insecure if the "
                                          "network itself is safe"));
  }
  auto token = ReadToken(options.token_file);
  if (!token.ok()) return token.status();
  credentials.token = *std::move(token);
  return credentials;
}

std::vector<std::unique_ptr<grpc::experimental::ClientInterceptorFactoryInterface>> InterceptorsFor(
    const std::string& token) {
  std::vector<std::unique_ptr<grpc::experimental::ClientInterceptorFactoryInterface>> all;
  if (!token.empty()) all.push_back(std::make_unique<ShowTokenFactory>(token));
  return all;
}

}  // namespace clearway
