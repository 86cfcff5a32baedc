// The server's certificate and key.
#pragma once

#include <string>

#include "absl/status/statusor.h"

namespace clearway {

// PEM texts that OpenSSL accepts and that belong together. A plain value.
struct TlsFiles {
  std::string cert, key;
  std::string warning;  // not empty: the certificate is not valid now
};

// Reads the certificate chain and its private key. Errors begin with tls_cert or tls_key and tell
// what is wrong: NOT_FOUND or PERMISSION_DENIED for a file that cannot be read, INVALID_ARGUMENT
// for one that is no PEM, holds something else, is encrypted, or is the key of another certificate.
absl::StatusOr<TlsFiles> ReadTlsFiles(const std::string& cert_path, const std::string& key_path);

}  // namespace clearway
