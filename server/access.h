// Who calls, and what they may do.
#pragma once

#include <grpcpp/server_context.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/wire/token_table.h"

namespace clearway {

// What a call shows of who makes it. A plain value.
struct Caller {
  std::string connection;                      // as gRPC writes it: "ipv4:127.0.0.1:50312"
  std::vector<std::string> authorizations;     // of its metadata
  std::vector<std::string> certificate_names;  // common name first; none without a certificate
};
Caller CallerOf(const grpc::ServerContext& context);

// One client. A plain value.
struct Peer {
  std::string name;  // of its token or certificate; without either, its connection
  Role role = Role::kAdmin;
};

// The role that a method needs, by its name without the service's. kAdmin for one that is not
// known.
Role RoleFor(const std::string& method);

// Any thread may call any method.
class AccessControl {
 public:
  // Whether connections may show certificates. Called before the first call.
  void ExpectCertificates(bool expect) { certificates_ = expect; }
  // Without a table everybody may do everything that the transport lets in.
  void Replace(std::optional<TokenTable> table);

  // UNAUTHENTICATED for a caller that shows neither a token nor a certificate of the table, or a
  // wrong token whatever else it shows.
  absl::StatusOr<Peer> Identify(const Caller& caller) const;
  absl::StatusOr<Peer> Identify(const grpc::ServerContext& context) const;
  // The name of a peer that was let in.
  std::string NameOf(const grpc::ServerContext& context) const;

 private:
  std::shared_ptr<const TokenTable> Table() const;

  bool certificates_ = false;
  mutable std::mutex mutex_;
  std::shared_ptr<const TokenTable> table_;
};

// PERMISSION_DENIED if the peer's role does not include what the method needs.
absl::Status CheckRole(const Peer& peer, const std::string& method);

}  // namespace clearway
