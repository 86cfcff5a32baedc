#include "client/tls_diagnosis.h"

#include <netdb.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <openssl/x509v3.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <memory>
#include <utility>

#include "absl/strings/str_cat.h"

namespace clearway {
namespace {

constexpr std::chrono::milliseconds kPatience(2000);

struct ContextDeleter {
  void operator()(SSL_CTX* context) const { SSL_CTX_free(context); }
};
struct SslDeleter {
  void operator()(SSL* ssl) const { SSL_free(ssl); }
};

// A socket that does not block, or none. One thread.
class Socket {
 public:
  explicit Socket(int file = -1) : file_(file) {}
  Socket(Socket&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
  Socket& operator=(Socket&&) = delete;
  ~Socket() {
    if (file_ >= 0) close(file_);
  }
  int get() const { return file_; }
  bool WaitFor(short events) const {
    pollfd polled{file_, events, 0};
    return poll(&polled, 1, static_cast<int>(kPatience.count())) == 1;
  }

 private:
  int file_;
};

Socket ConnectTo(int family, const sockaddr* address, socklen_t size) {
  Socket client(socket(family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (connect(client.get(), address, size) == 0) return client;
  if (errno != EINPROGRESS || !client.WaitFor(POLLOUT)) return Socket();
  int error = 0;
  socklen_t length = sizeof error;
  getsockopt(client.get(), SOL_SOCKET, SO_ERROR, &error, &length);
  return error == 0 ? std::move(client) : Socket();
}

Socket ConnectTo(const ServerAddress& address) {
  if (!address.socket_path.empty()) {
    sockaddr_un local{};
    local.sun_family = AF_UNIX;
    address.socket_path.copy(local.sun_path, sizeof local.sun_path - 1);
    return ConnectTo(AF_UNIX, reinterpret_cast<const sockaddr*>(&local), sizeof local);
  }
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* infos = nullptr;
  if (getaddrinfo(address.host.c_str(), absl::StrCat(address.port).c_str(), &hints, &infos) != 0) {
    return Socket();
  }
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> owner(infos, freeaddrinfo);
  for (; infos != nullptr; infos = infos->ai_next) {
    Socket client = ConnectTo(infos->ai_family, infos->ai_addr, infos->ai_addrlen);
    if (client.get() >= 0) return client;
  }
  return Socket();
}

// What OpenSSL wants to send. OpenSSL itself would raise SIGPIPE if the server has gone.
bool Send(BIO* from, const Socket& socket) {
  std::array<char, 4096> bytes;
  for (int size; (size = BIO_read(from, bytes.data(), bytes.size())) > 0;) {
    for (int sent = 0; sent < size;) {
      if (!socket.WaitFor(POLLOUT)) return false;
      const ssize_t part = send(socket.get(), bytes.data() + sent, size - sent, MSG_NOSIGNAL);
      if (part <= 0) return false;
      sent += static_cast<int>(part);
    }
  }
  return true;
}

// Whether the handshake came to its end.
bool Shake(SSL* ssl, const Socket& socket) {
  BIO* const in = BIO_new(BIO_s_mem());
  BIO* const out = BIO_new(BIO_s_mem());
  SSL_set_bio(ssl, in, out);  // which owns them
  while (true) {
    const int done = SSL_connect(ssl);
    const bool sent = Send(out, socket);
    if (done == 1) return true;
    if (SSL_get_error(ssl, done) != SSL_ERROR_WANT_READ || !sent) return false;
    std::array<char, 4096> bytes;
    if (!socket.WaitFor(POLLIN)) return false;
    const ssize_t size = recv(socket.get(), bytes.data(), bytes.size(), 0);
    if (size <= 0 || BIO_write(in, bytes.data(), static_cast<int>(size)) != size) return false;
  }
}

// Of the server's certificate.
std::string WhyRefused(long error, const ServerAddress& address, const std::string& roots_file) {
  switch (error) {
    case X509_V_ERR_CERT_HAS_EXPIRED:
      return "the server's certificate, or one that signed it, has expired; renew it, or correct "
             "this machine's date";
    case X509_V_ERR_CERT_NOT_YET_VALID:
      return "the server's certificate, or one that signed it, is not valid yet; check this "
             "machine's date";
    case X509_V_ERR_DEPTH_ZERO_SELF_SIGNED_CERT:
    case X509_V_ERR_SELF_SIGNED_CERT_IN_CHAIN:
    case X509_V_ERR_UNABLE_TO_GET_ISSUER_CERT:
    case X509_V_ERR_UNABLE_TO_GET_ISSUER_CERT_LOCALLY:
    case X509_V_ERR_UNABLE_TO_VERIFY_LEAF_SIGNATURE:
    case X509_V_ERR_CERT_SIGNATURE_FAILURE:
      return absl::StrCat("the server's certificate was not signed by an authority of ",
                          roots_file);
    case X509_V_ERR_HOSTNAME_MISMATCH:
    case X509_V_ERR_IP_ADDRESS_MISMATCH:
      return absl::StrCat("the server's certificate is not for the host ", address.host,
                          "; connect by a name that it holds");
    default:
      return absl::StrCat("the server's certificate is refused: ",
                          X509_verify_cert_error_string(error));
  }
}

void ExpectHost(SSL* ssl, const std::string& host) {
  X509_VERIFY_PARAM* const wanted = SSL_get0_param(ssl);
  if (X509_VERIFY_PARAM_set1_ip_asc(wanted, host.c_str()) == 1) return;
  SSL_set_tlsext_host_name(ssl, host.c_str());
  X509_VERIFY_PARAM_set1_host(wanted, host.c_str(), host.size());
}

// Sets `asked` when the server asks for a certificate; none is given.
void NoteQuestion(SSL* ssl, bool* asked) {
  SSL_set_app_data(ssl, asked);
  SSL_set_cert_cb(
      ssl,
      [](SSL* self, void*) {
        *static_cast<bool*>(SSL_get_app_data(self)) = true;
        return 1;
      },
      nullptr);
}

}  // namespace

std::string DiagnoseTls(const ServerAddress& address, const std::string& roots_file) {
  const Socket socket = ConnectTo(address);
  if (socket.get() < 0) return "";
  const std::unique_ptr<SSL_CTX, ContextDeleter> context(SSL_CTX_new(TLS_client_method()));
  const bool with_tls = !roots_file.empty();
  if (with_tls) SSL_CTX_load_verify_file(context.get(), roots_file.c_str());
  const std::unique_ptr<SSL, SslDeleter> ssl(SSL_new(context.get()));
  constexpr unsigned char kHttp2[] = {2, 'h', '2'};  // what gRPC speaks
  SSL_set_alpn_protos(ssl.get(), kHttp2, sizeof kHttp2);
  if (with_tls && address.socket_path.empty()) ExpectHost(ssl.get(), address.host);
  bool asked_for_certificate = false;
  NoteQuestion(ssl.get(), &asked_for_certificate);
  // OpenSSL shakes hands with whoever signed; SSL_get_verify_result says whether it may be trusted.
  const bool shaken = Shake(ssl.get(), socket);
  const int reason = ERR_GET_REASON(ERR_peek_last_error());
  ERR_clear_error();
  if (!with_tls) {
    return shaken ? "it seems to expect TLS, which this client does not speak; name the root "
                    "certificates"
                  : "";
  }
  if (!shaken && reason == SSL_R_WRONG_VERSION_NUMBER) {
    return "it seems not to speak TLS; leave out the root certificates, if the network may be "
           "trusted";
  }
  const long refused = SSL_get_verify_result(ssl.get());
  if (shaken && refused != X509_V_OK) return WhyRefused(refused, address, roots_file);
  if (!asked_for_certificate) return "";
  return "it asks for a client's certificate, and none was given, or one that it does not accept "
         "(of another authority, or expired)";
}

}  // namespace clearway
