#include "server/tls_identity.h"

#include <grpcpp/security/tls_certificate_provider.h>
#include <grpcpp/security/tls_credentials_options.h>

namespace clearway {
namespace {

constexpr unsigned kLookEvery_s = 1;  // gRPC's shortest

}  // namespace

absl::StatusOr<std::unique_ptr<TlsIdentity>> TlsIdentity::Create(const TlsFiles& files) {
  std::unique_ptr<TlsIdentity> identity(new TlsIdentity);
  identity->asks_for_certificates_ = !files.client_ca.empty();
  if (auto status = identity->Replace(files); !status.ok()) return status;
  using grpc::experimental::FileWatcherCertificateProvider;
  const std::string pair = identity->key_and_cert_.path();
  const bool ask = identity->asks_for_certificates_;
  const auto provider = std::make_shared<FileWatcherCertificateProvider>(
      pair, pair, ask ? identity->client_ca_.path() : std::string(), kLookEvery_s);
  grpc::experimental::TlsServerCredentialsOptions options(provider);
  options.watch_identity_key_cert_pairs();
  if (ask) options.watch_root_certs();
  options.set_cert_request_type(ask ? GRPC_SSL_REQUEST_AND_REQUIRE_CLIENT_CERTIFICATE_AND_VERIFY
                                    : GRPC_SSL_DONT_REQUEST_CLIENT_CERTIFICATE);
  identity->credentials_ = grpc::experimental::TlsServerCredentials(options);
  return identity;
}

absl::Status TlsIdentity::Replace(const TlsFiles& files) {
  if (asks_for_certificates_) {
    if (auto status = client_ca_.Replace(files.client_ca); !status.ok()) return status;
  }
  return key_and_cert_.Replace(files.key + "\n" + files.cert);
}

}  // namespace clearway
