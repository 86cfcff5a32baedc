// The server's certificate and key.
#pragma once

#include <string>

#include "absl/status/statusor.h"

namespace clearway {

// PEM texts that OpenSSL accepts and that belong together. A plain value.
struct TlsFiles {
  std::string cert, key;
  std::string client_ca;  // empty: clients show no certificates
  std::string warning;    // not empty: the certificate is not valid yet
};

// Reads the certificate chain, its private key and, if a path is given, the authorities of clients'
// certificates. Errors begin with tls_cert, tls_key or tls_client_ca and tell what is wrong:
// NOT_FOUND or PERMISSION_DENIED for a file that cannot be read, INVALID_ARGUMENT for one that is
// no PEM, holds something else, is encrypted, or is the key of another certificate,
// FAILED_PRECONDITION for a certificate that has expired and a key that others can read.
absl::StatusOr<TlsFiles> ReadTlsFiles(const std::string& cert_path, const std::string& key_path,
                                      const std::string& client_ca_path = "");

}  // namespace clearway
