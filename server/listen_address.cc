#include "server/listen_address.h"

#include <arpa/inet.h>
#include <sys/socket.h>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"

namespace clearway {

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

absl::Status CheckResolves(const ListenAddress& address) {
  const auto infos = Resolve(address);
  return infos.ok() ? absl::OkStatus() : absl::InvalidArgumentError(infos.status().message());
}

}  // namespace clearway
