#include "server/listen_address.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netdb.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"

namespace clearway {
namespace {

absl::Status ErrorOf(int error, const std::string& what) {
  return absl::Status(absl::ErrnoToStatusCode(error), absl::StrCat("listen: ", what));
}

// What bind says about one of a host's addresses; 0 if nothing.
int TryToBind(const addrinfo& info) {
  const int fd = socket(info.ai_family, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (fd < 0) return errno;
  // As gRPC does: a port in TIME_WAIT may be taken over, and [::] stands for IPv4, too.
  const int on = 1, off = 0;
  setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (info.ai_family == AF_INET6) setsockopt(fd, IPPROTO_IPV6, IPV6_V6ONLY, &off, sizeof off);
  const int error = bind(fd, info.ai_addr, info.ai_addrlen) == 0 ? 0 : errno;
  close(fd);
  return error;
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

using AddrInfos = std::unique_ptr<addrinfo, decltype(&freeaddrinfo)>;

absl::StatusOr<AddrInfos> Resolve(const ListenAddress& address) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
  addrinfo* infos = nullptr;
  const std::string port = absl::StrCat(address.port);
  if (const int fault = getaddrinfo(address.host.c_str(), port.c_str(), &hints, &infos)) {
    return absl::NotFoundError(
        absl::StrCat("listen: cannot resolve host ", address.host, ": ", gai_strerror(fault)));
  }
  return AddrInfos(infos, freeaddrinfo);
}

absl::Status CheckHost(const ListenAddress& address) {
  const auto infos = Resolve(address);
  if (!infos.ok()) return infos.status();
  int first_error = 0;
  bool any = false;
  for (const addrinfo* info = infos->get(); info != nullptr; info = info->ai_next) {
    const int error = TryToBind(*info);
    // Clients of a name that two servers share would reach either.
    if (error == EADDRINUSE) return BindError(error, address);
    any = any || error == 0;
    if (first_error == 0) first_error = error;
  }
  return any || first_error == 0 ? absl::OkStatus() : BindError(first_error, address);
}

// OK for a socket that nobody holds any more: gRPC removes it. It would also take it from whoever
// listens there.
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

}  // namespace

bool ListenAddress::IsLocal() const {
  if (!socket_path.empty() || absl::EqualsIgnoreCase(host, "localhost")) return true;
  in_addr ipv4;
  if (inet_pton(AF_INET, host.c_str(), &ipv4) == 1) return ntohl(ipv4.s_addr) >> 24 == 127;
  in6_addr ipv6;
  if (inet_pton(AF_INET6, host.c_str(), &ipv6) != 1) return false;
  return IN6_IS_ADDR_LOOPBACK(&ipv6) || (IN6_IS_ADDR_V4MAPPED(&ipv6) && ipv6.s6_addr[12] == 127);
}

absl::StatusOr<ListenAddress> ParseListenAddress(const std::string& text) {
  static const auto* const kUse =
      new AddressUse{"listen", 0, "0.0.0.0 stands for all of this machine's"};
  auto address = ParseServerAddress(text, *kUse);
  if (!address.ok()) return address.status();
  return ListenAddress{*std::move(address)};
}

absl::Status CheckResolves(const ListenAddress& address) {
  const auto infos = Resolve(address);
  return infos.ok() ? absl::OkStatus() : absl::InvalidArgumentError(infos.status().message());
}

absl::Status CheckCanListen(const ListenAddress& address) {
  return address.socket_path.empty() ? CheckHost(address) : CheckSocket(address.socket_path);
}

}  // namespace clearway
