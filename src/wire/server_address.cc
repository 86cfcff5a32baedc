#include "wire/server_address.h"

#include <arpa/inet.h>
#include <sys/un.h>

#include <algorithm>

#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"

namespace clearway {
namespace {

constexpr int kMaxPort = 65535;
constexpr std::size_t kMaxSocketPath = sizeof(sockaddr_un::sun_path) - 1;

bool IsIpv4(const std::string& host) {
  in_addr ipv4;
  return inet_pton(AF_INET, host.c_str(), &ipv4) == 1;
}

// Reads one address; errors name the field.
class AddressParser {
 public:
  AddressParser(const std::string& text, const AddressUse& use) : text_(text), use_(use) {}

  absl::StatusOr<ServerAddress> Parse() const {
    if (text_.empty()) return Bad("is missing; write host:port or unix:/path");
    if (text_.find('\0') != std::string::npos) return Bad("holds a zero byte");
    if (text_.starts_with("unix:")) return ParseSocket(text_.substr(5));
    for (const std::string prefix : {"ipv4:", "ipv6:", "dns:///", "dns:"}) {
      if (text_.starts_with(prefix)) return ParseHost(text_.substr(prefix.size()));
    }
    return ParseHost(text_);
  }

 private:
  absl::Status Bad(const std::string& what) const {
    return absl::InvalidArgumentError(absl::StrCat(use_.field, ": ", what));
  }

  absl::StatusOr<ServerAddress> ParseSocket(const std::string& path) const {
    if (path.empty()) return Bad("unix: names no path");
    if (path.starts_with("//") && !path.starts_with("///")) {
      return Bad(absl::StrCat("unix:", path, " is no path; write unix:relative or unix:/absolute"));
    }
    if (path.size() > kMaxSocketPath) {
      return Bad(absl::StrCat("the socket's path has ", path.size(), " bytes; the limit is ",
                              kMaxSocketPath));
    }
    ServerAddress address;
    address.socket_path = path.starts_with("///") ? path.substr(2) : path;
    return address;
  }

  // What to write instead of an address with slashes.
  absl::Status NoHost(const std::string& rest) const {
    if (const std::size_t scheme = text_.find("://"); scheme != std::string::npos) {
      const std::string host = text_.substr(scheme + 3, text_.find('/', scheme + 3) - scheme - 3);
      return Bad(absl::StrCat(text_, " is a URL and neither host:port nor unix:/path",
                              host.empty() ? "" : absl::StrCat("; write ", host)));
    }
    return Bad(absl::StrCat(rest, " is neither host:port nor unix:/path; write unix:", rest,
                            " if it is a socket's path"));
  }

  absl::StatusOr<ServerAddress> ParseHost(const std::string& rest) const {
    if (absl::StrContains(rest, '/')) return NoHost(rest);
    const std::size_t colon = rest.rfind(':');
    if (colon == std::string::npos) {
      return Bad(absl::StrCat(text_, " is neither host:port nor unix:/path; it names no port"));
    }
    ServerAddress address;
    std::string& host = address.host = rest.substr(0, colon);
    const bool bracketed = host.starts_with('[') && host.ends_with(']');
    if (bracketed) host = host.substr(1, host.size() - 2);
    if (host.empty()) return Bad(absl::StrCat(text_, " names no host; ", use_.example));
    if (host.find_first_of("[]") != std::string::npos ||
        bracketed != absl::StrContains(host, ':')) {
      return Bad(absl::StrCat(text_, ": an IPv6 address is written [address]:port"));
    }
    if (std::any_of(host.begin(), host.end(), absl::ascii_isspace)) {
      return Bad(absl::StrCat(text_, ": the host holds a blank"));
    }
    // Resolvers also know "127.1" and "2130706433", which others read otherwise.
    if (host.find_first_not_of("0123456789.") == std::string::npos && !IsIpv4(host)) {
      return Bad(absl::StrCat(text_, ": ", host,
                              " is not an IPv4 address: four numbers from 0 to 255 with dots "
                              "between"));
    }
    const auto port = ParsePort(rest.substr(colon + 1));
    if (!port.ok()) return port.status();
    address.port = *port;
    return address;
  }

  absl::StatusOr<int> ParsePort(const std::string& digits) const {
    int port = 0;
    if (digits.empty() || !std::all_of(digits.begin(), digits.end(), absl::ascii_isdigit)) {
      return Bad(absl::StrCat(text_, ": port \"", digits, "\" is not a number from ", use_.min_port,
                              " to ", kMaxPort));
    }
    if (!absl::SimpleAtoi(digits, &port) || port > kMaxPort) {
      return Bad(
          absl::StrCat(text_, ": port ", digits, " is out of range; the limit is ", kMaxPort));
    }
    if (port < use_.min_port) {
      return Bad(
          absl::StrCat(text_, ": port ", digits, " is out of range; the least is ", use_.min_port));
    }
    return port;
  }

  const std::string& text_;
  const AddressUse& use_;
};

}  // namespace

std::string ServerAddress::ToString() const {
  if (!socket_path.empty()) return "unix:" + socket_path;
  const bool ipv6 = absl::StrContains(host, ':');
  return absl::StrCat(ipv6 ? "[" : "", host, ipv6 ? "]" : "", ":", port);
}

std::string ServerAddress::ToTarget() const {
  if (!socket_path.empty()) return ToString();
  if (absl::StrContains(host, ':')) return "ipv6:" + ToString();
  return absl::StrCat(IsIpv4(host) ? "ipv4:" : "dns:///", ToString());
}

absl::StatusOr<ServerAddress> ParseServerAddress(const std::string& text, const AddressUse& use) {
  return AddressParser(text, use).Parse();
}

}  // namespace clearway
