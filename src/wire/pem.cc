#include "wire/pem.h"

#include <openssl/err.h>
#include <openssl/pem.h>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"

namespace clearway {
namespace {

struct BioDeleter {
  void operator()(BIO* bio) const { BIO_free(bio); }
};

}  // namespace

std::string OpenSslReason() {
  const char* reason = ERR_reason_error_string(ERR_peek_last_error());
  ERR_clear_error();
  return reason == nullptr ? "OpenSSL refuses it" : reason;
}

absl::StatusOr<std::vector<Certificate>> ReadCertificates(const std::string& name,
                                                          const std::string& pem) {
  ERR_clear_error();
  std::vector<Certificate> certificates;
  const std::unique_ptr<BIO, BioDeleter> bio(
      BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())));
  while (X509* certificate = PEM_read_bio_X509(bio.get(), nullptr, nullptr, nullptr)) {
    certificates.emplace_back(certificate);
  }
  const bool at_end = ERR_GET_REASON(ERR_peek_last_error()) == PEM_R_NO_START_LINE;
  const std::string reason = OpenSslReason();
  if (!at_end) {
    return absl::InvalidArgumentError(
        absl::StrCat(name, " certificate ", certificates.size() + 1, " cannot be read: ", reason));
  }
  if (!certificates.empty()) return certificates;
  return absl::InvalidArgumentError(absl::StrCat(
      name, absl::StrContains(pem, "PRIVATE KEY-----") ? " holds a private key and no certificate"
                                                       : " holds no certificate in PEM"));
}

}  // namespace clearway
