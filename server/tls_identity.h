// The server's side of TLS, replaceable while it runs.
#pragma once

#include <grpcpp/security/server_credentials.h>

#include <memory>

#include "absl/status/statusor.h"
#include "server/memory_file.h"
#include "server/tls_files.h"

namespace clearway {

// gRPC can follow files that change, but takes a pair that does not belong together, and one that
// is half written. So it follows files of this class's own, in memory, whose content has been
// checked. One thread.
class TlsIdentity {
 public:
  // UNAVAILABLE if the system has no memory files.
  static absl::StatusOr<std::unique_ptr<TlsIdentity>> Create(const TlsFiles& files);

  // For builders. Clients must show a certificate if the files had a client_ca.
  const std::shared_ptr<grpc::ServerCredentials>& credentials() const { return credentials_; }

  // For connections from a second or two later on; those that there are go on. Whether clients must
  // show a certificate stays as it was.
  absl::Status Replace(const TlsFiles& files);

 private:
  TlsIdentity() = default;

  MemoryFile key_and_cert_;  // one file, so that they change together
  MemoryFile client_ca_;
  bool asks_for_certificates_ = false;
  std::shared_ptr<grpc::ServerCredentials> credentials_;
};

}  // namespace clearway
