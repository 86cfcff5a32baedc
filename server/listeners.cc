#include "server/listeners.h"

#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>

#include "absl/strings/str_cat.h"

namespace clearway {
namespace {

constexpr int kAttempts = 10;  // to find a port that is free at all addresses of a host

absl::Status ErrorOf(int error, const std::string& what) {
  return absl::Status(absl::ErrnoToStatusCode(error), absl::StrCat("listen: ", what));
}

absl::Status BindError(int error, const ListenAddress& address) {
  const std::string text = address.ToString();
  switch (error) {
    case EADDRINUSE:
      return absl::AlreadyExistsError(
          absl::StrCat("listen: ", text, " is in use: another program listens there"));
    case EADDRNOTAVAIL:
      return absl::NotFoundError(
          absl::StrCat("listen: ", address.host, " is not an address of this machine"));
    case EACCES:
    case EPERM:
      return ErrorOf(error,
                     absl::StrCat("no permission to listen on port ", address.port,
                                  address.port < 1024 ? "; those below 1024 are root's" : ""));
    default:
      return ErrorOf(error, absl::StrCat("cannot listen on ", text, ": ", std::strerror(error)));
  }
}

void SetOption(int fd, int level, int option, int value) {
  setsockopt(fd, level, option, &value, sizeof value);
}

void SetPort(sockaddr& address, int port) {
  const auto number = htons(static_cast<std::uint16_t>(port));
  if (address.sa_family == AF_INET) {
    reinterpret_cast<sockaddr_in&>(address).sin_port = number;
  } else if (address.sa_family == AF_INET6) {
    reinterpret_cast<sockaddr_in6&>(address).sin6_port = number;
  }
}

int PortOf(int fd) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  if (getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size) != 0) return 0;
  return ntohs(address.ss_family == AF_INET6
                   ? reinterpret_cast<const sockaddr_in6&>(address).sin6_port
                   : reinterpret_cast<const sockaddr_in&>(address).sin_port);
}

// One that listens; what goes wrong is in errno. Connections inherit its options.
Descriptor ListenAt(const addrinfo& info, const ListenOptions& options) {
  Descriptor listener(socket(info.ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!listener.ok()) return listener;
  const int fd = listener.get();
  SetOption(fd, SOL_SOCKET, SO_REUSEADDR, 1);  // a port in TIME_WAIT may be taken over
  if (info.ai_family == AF_INET6) SetOption(fd, IPPROTO_IPV6, IPV6_V6ONLY, 0);  // [::] is IPv4, too
  SetOption(fd, IPPROTO_TCP, TCP_NODELAY, 1);
  SetOption(fd, IPPROTO_TCP, TCP_USER_TIMEOUT,
            static_cast<int>(options.unread_timeout.count() / 1'000'000));
  const bool listens = bind(fd, info.ai_addr, info.ai_addrlen) == 0 && listen(fd, SOMAXCONN) == 0;
  return listens ? std::move(listener) : Descriptor();
}

// Files of hosts may name an address twice.
bool IsRepeated(const addrinfo* infos, const addrinfo* info) {
  for (; infos != info; infos = infos->ai_next) {
    if (infos->ai_addrlen == info->ai_addrlen &&
        std::memcmp(infos->ai_addr, info->ai_addr, info->ai_addrlen) == 0) {
      return true;
    }
  }
  return false;
}

// The first of them chooses the port if it is 0. On failure `error` is what the address that is in
// use said, or the first.
std::vector<Descriptor> ListenAtAll(const addrinfo* infos, int& port, const ListenOptions& options,
                                    int& error) {
  std::vector<Descriptor> listeners;
  error = 0;
  for (const addrinfo* info = infos; info != nullptr; info = info->ai_next) {
    SetPort(*info->ai_addr, port);
    if (IsRepeated(infos, info)) continue;
    Descriptor listener = ListenAt(*info, options);
    const int failure = listener.ok() ? 0 : errno;
    if (error == 0) error = failure;
    if (failure == EADDRINUSE) {  // clients of a name that two servers share would reach either
      error = failure;
      return {};
    }
    if (!listener.ok()) continue;
    port = PortOf(listener.get());
    listeners.push_back(std::move(listener));
  }
  return listeners;
}

absl::StatusOr<std::vector<Descriptor>> ListenAtHost(ListenAddress& address,
                                                     const ListenOptions& options) {
  const auto infos = Resolve(address);
  if (!infos.ok()) return infos.status();
  int error = 0;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    int port = address.port;
    std::vector<Descriptor> listeners = ListenAtAll(infos->get(), port, options, error);
    if (!listeners.empty()) {
      address.port = port;
      return listeners;
    }
    if (address.port != 0 || error != EADDRINUSE) break;
  }
  return BindError(error, address);
}

// OK for a socket that nobody holds any more.
absl::Status CheckLeftOver(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path.copy(address.sun_path, sizeof address.sun_path - 1);
  const int client = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (client < 0) return ErrorOf(errno, absl::StrCat("no socket: ", std::strerror(errno)));
  const bool answers =
      connect(client, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
  const int error = answers ? 0 : errno;
  close(client);
  switch (error) {
    case ECONNREFUSED:
    case ENOENT:
      return absl::OkStatus();
    case 0:
    case EAGAIN:  // more than it takes up are waiting
      return absl::AlreadyExistsError(
          absl::StrCat("listen: another server listens on unix:", path));
    case EPROTOTYPE:
      return absl::AlreadyExistsError(
          absl::StrCat("listen: another program holds unix:", path, ", a socket of another kind"));
    default:
      return ErrorOf(error, absl::StrCat("cannot tell whether someone listens on unix:", path, ": ",
                                         std::strerror(error)));
  }
}

absl::Status CheckSocket(const std::string& path) {
  const std::string parent = std::filesystem::path(path).parent_path().string();
  const std::string folder = parent.empty() ? std::string(".") : parent;
  struct stat info {};
  if (stat(folder.c_str(), &info) != 0) {
    return ErrorOf(errno,
                   absl::StrCat("the folder of the socket ", path, ": ", std::strerror(errno)));
  }
  if (!S_ISDIR(info.st_mode)) return ErrorOf(ENOTDIR, absl::StrCat(folder, " is not a folder"));
  if (faccessat(AT_FDCWD, folder.c_str(), W_OK | X_OK, AT_EACCESS) != 0) {
    return ErrorOf(errno,
                   absl::StrCat("cannot create a socket in ", folder, ": ", std::strerror(errno)));
  }
  if (lstat(path.c_str(), &info) != 0) return absl::OkStatus();
  if (!S_ISSOCK(info.st_mode)) {
    return absl::AlreadyExistsError(absl::StrCat("listen: ", path, " exists and is not a socket"));
  }
  return CheckLeftOver(path);
}

// What is created meanwhile only its owner can use.
class OwnersOnly {
 public:
  OwnersOnly() : before_(umask(S_IRWXG | S_IRWXO | S_IXUSR)) {}
  ~OwnersOnly() { umask(before_); }
  OwnersOnly(const OwnersOnly&) = delete;
  OwnersOnly& operator=(const OwnersOnly&) = delete;

 private:
  const mode_t before_;
};

absl::StatusOr<std::vector<Descriptor>> ListenAtSocket(const ListenAddress& address,
                                                       const ListenOptions& options) {
  const std::string& path = address.socket_path;
  if (auto status = CheckSocket(path); !status.ok()) return status;
  unlink(path.c_str());
  sockaddr_un local{};
  local.sun_family = AF_UNIX;
  path.copy(local.sun_path, sizeof local.sun_path - 1);
  Descriptor listener(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  const auto* const name = reinterpret_cast<const sockaddr*>(&local);
  const OwnersOnly owners_only;  // until it has its mode
  if (!listener.ok() || bind(listener.get(), name, sizeof local) != 0 ||
      chmod(path.c_str(), options.socket_mode) != 0 || listen(listener.get(), SOMAXCONN) != 0) {
    return BindError(errno, address);
  }
  std::vector<Descriptor> listeners;
  listeners.push_back(std::move(listener));
  return listeners;
}

}  // namespace

absl::StatusOr<std::vector<Descriptor>> Listen(ListenAddress& address,
                                               const ListenOptions& options) {
  return address.socket_path.empty() ? ListenAtHost(address, options)
                                     : ListenAtSocket(address, options);
}

}  // namespace clearway
