// Certificates in PEM.
#pragma once

#include <openssl/x509.h>

#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"

namespace clearway {

struct CertificateDeleter {
  void operator()(X509* certificate) const { X509_free(certificate); }
};
using Certificate = std::unique_ptr<X509, CertificateDeleter>;

// All certificates of a text, at least one, in their order. INVALID_ARGUMENT begins with `name` and
// tells a private key, other words and a certificate that is cut off apart.
absl::StatusOr<std::vector<Certificate>> ReadCertificates(const std::string& name,
                                                          const std::string& pem);

// What OpenSSL noted last; clears its notes.
std::string OpenSslReason();

}  // namespace clearway
