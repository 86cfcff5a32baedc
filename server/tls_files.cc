#include "server/tls_files.h"

#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/ssl.h>

#include <memory>
#include <vector>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "clearway/base/file.h"
#include "clearway/base/secret_file.h"
#include "wire/pem.h"

namespace clearway {
namespace {

constexpr std::uint64_t kMaxBytes = 1 << 20;

template <class T, void (*free)(T*)>
struct Deleter {
  void operator()(T* value) const { free(value); }
};
using Key = std::unique_ptr<EVP_PKEY, Deleter<EVP_PKEY, EVP_PKEY_free>>;
using Context = std::unique_ptr<SSL_CTX, Deleter<SSL_CTX, SSL_CTX_free>>;
struct BioDeleter {
  void operator()(BIO* bio) const { BIO_free(bio); }
};
using Bio = std::unique_ptr<BIO, BioDeleter>;

Bio BytesOf(const std::string& pem) {
  return Bio(BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())));
}

absl::Status Bad(const char* field, const std::string& path, const std::string& what) {
  return absl::InvalidArgumentError(absl::StrCat(field, ": ", path, " ", what));
}

enum class Secrecy { kPublic, kSecret };

absl::StatusOr<std::string> ReadPem(const char* field, const std::string& path, Secrecy secrecy) {
  absl::StatusOr<std::string> text = secrecy == Secrecy::kSecret ? ReadSecretFile(path, kMaxBytes)
                                                                 : ReadWholeFile(path, kMaxBytes);
  if (!text.ok()) {
    return absl::Status(text.status().code(), absl::StrCat(field, ": ", text.status().message()));
  }
  if (text->empty()) return Bad(field, path, "is empty");
  return text;
}

// No passphrase: there is nobody to ask.
int NoPassphrase(char*, int, int, void* asked) {
  *static_cast<bool*>(asked) = true;
  return -1;
}

absl::StatusOr<Key> ReadKey(const std::string& pem, const std::string& path) {
  bool encrypted = false;
  Key key(PEM_read_bio_PrivateKey(BytesOf(pem).get(), nullptr, NoPassphrase, &encrypted));
  const std::string reason = OpenSslReason();
  if (key != nullptr) return key;
  if (encrypted)
    return Bad("tls_key", path, "is encrypted; the server needs a key without passphrase");
  if (!absl::StrContains(pem, "PRIVATE KEY-----")) {
    return Bad("tls_key", path,
               absl::StrContains(pem, "-----BEGIN CERTIFICATE-----")
                   ? "holds a certificate and no private key; are tls_cert and tls_key swapped?"
                   : "holds no private key in PEM");
  }
  return Bad("tls_key", path, absl::StrCat("holds a private key that cannot be read: ", reason));
}

// The whole chain; the server's own certificate comes first.
absl::StatusOr<std::vector<Certificate>> ReadChain(const std::string& pem,
                                                   const std::string& path) {
  auto chain = ReadCertificates(absl::StrCat("tls_cert: ", path), pem);
  if (chain.ok() || !absl::StrContains(chain.status().message(), "private key")) return chain;
  return absl::InvalidArgumentError(
      absl::StrCat(std::string(chain.status().message()), "; are tls_cert and tls_key swapped?"));
}

// What only TLS objects to, such as keys that are too short.
absl::Status CheckForTls(X509* certificate, EVP_PKEY* key, const std::string& cert_path,
                         const std::string& key_path) {
  const Context context(SSL_CTX_new(TLS_server_method()));
  if (context == nullptr)
    return absl::InternalError("tls: OpenSSL does not start: " + OpenSslReason());
  if (SSL_CTX_use_certificate(context.get(), certificate) != 1) {
    return Bad("tls_cert", cert_path, "cannot be used for TLS: " + OpenSslReason());
  }
  if (SSL_CTX_use_PrivateKey(context.get(), key) != 1) {
    return Bad("tls_key", key_path, "cannot be used for TLS: " + OpenSslReason());
  }
  return absl::OkStatus();
}

absl::Status CheckNotExpired(const X509* certificate, const char* field, const std::string& path) {
  if (X509_cmp_current_time(X509_get0_notAfter(certificate)) >= 0) return absl::OkStatus();
  return absl::FailedPreconditionError(absl::StrCat(field, ": ", path, " has expired"));
}

// A machine without a battery may not know the date yet, so this is no error.
std::string NotYetValidWarning(const X509* certificate, const std::string& path) {
  if (X509_cmp_current_time(X509_get0_notBefore(certificate)) <= 0) return "";
  return absl::StrCat("tls_cert: ", path, " is not valid yet; clients will refuse it");
}

absl::Status CheckPair(X509* own, EVP_PKEY* key, const std::string& cert_path,
                       const std::string& key_path) {
  if (X509_check_private_key(own, key) != 1) {
    ERR_clear_error();
    return Bad("tls_key", key_path,
               absl::StrCat("does not belong to tls_cert ", cert_path,
                            " (its first certificate must be the server's own)"));
  }
  if (auto s = CheckForTls(own, key, cert_path, key_path); !s.ok()) return s;
  return CheckNotExpired(own, "tls_cert", cert_path);
}

absl::StatusOr<std::string> ReadClientCa(const std::string& path) {
  constexpr char kField[] = "tls_client_ca";
  absl::StatusOr<std::string> pem = ReadPem(kField, path, Secrecy::kPublic);
  if (!pem.ok()) return pem;
  const auto authorities = ReadCertificates(absl::StrCat(kField, ": ", path), *pem);
  if (!authorities.ok()) return authorities.status();
  for (const Certificate& authority : *authorities) {
    if (auto s = CheckNotExpired(authority.get(), kField, path); !s.ok()) return s;
  }
  return pem;
}

}  // namespace

absl::StatusOr<TlsFiles> ReadTlsFiles(const std::string& cert_path, const std::string& key_path,
                                      const std::string& client_ca_path) {
  ERR_clear_error();
  absl::StatusOr<std::string> cert = ReadPem("tls_cert", cert_path, Secrecy::kPublic);
  if (!cert.ok()) return cert.status();
  absl::StatusOr<std::string> key = ReadPem("tls_key", key_path, Secrecy::kSecret);
  if (!key.ok()) return key.status();
  const absl::StatusOr<std::vector<Certificate>> chain = ReadChain(*cert, cert_path);
  if (!chain.ok()) return chain.status();
  const absl::StatusOr<Key> private_key = ReadKey(*key, key_path);
  if (!private_key.ok()) return private_key.status();
  X509* const own = chain->front().get();
  if (auto s = CheckPair(own, private_key->get(), cert_path, key_path); !s.ok()) return s;
  TlsFiles files{*std::move(cert), *std::move(key), "", NotYetValidWarning(own, cert_path)};
  if (client_ca_path.empty()) return files;
  absl::StatusOr<std::string> client_ca = ReadClientCa(client_ca_path);
  if (!client_ca.ok()) return client_ca.status();
  files.client_ca = *std::move(client_ca);
  return files;
}

}  // namespace clearway
