#include "server/access.h"

#include <grpc/grpc_security_constants.h>

#include <map>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/strip.h"
#include "wire/status.h"

namespace clearway {
namespace {

absl::Status Unauthenticated(const std::string& what, const std::string& reason) {
  return WithReason(absl::UnauthenticatedError(what), reason);
}

absl::StatusOr<std::string> TokenOf(const std::vector<std::string>& authorizations) {
  if (authorizations.size() > 1) {
    return Unauthenticated("authorization: is there twice", "WRONG_TOKEN");
  }
  absl::string_view text = authorizations.front();
  constexpr absl::string_view kScheme = "Bearer ";
  if (!absl::StartsWithIgnoreCase(text, kScheme)) {
    return Unauthenticated("authorization: must be \"Bearer\" and a token", "WRONG_TOKEN");
  }
  return std::string(text.substr(kScheme.size()));
}

// Every method that is not the administrator's.
const std::map<std::string, Role>& Roles() {
  static const auto* const kRoles = [] {
    auto* roles = new std::map<std::string, Role>;
    for (const char* method : {"AcquireLease",      "CastRays",
                               "CheckMotions",      "CheckStates",
                               "ExportMap",         "FindDepartureIntervals",
                               "FindSafeIntervals", "FollowScene",
                               "GetBoxOccupancy",   "GetObject",
                               "GetPointOccupancy", "GetServerInfo",
                               "GetSliceOccupancy", "GetStatus",
                               "ListObjects",       "Plan",
                               "PredictPoses",      "RegisterRobot",
                               "ReleaseLease",      "RenewLease",
                               "WatchMotions"}) {
      roles->emplace(method, Role::kRead);
    }
    for (const char* method :
         {"AddObjects", "PushFrame", "PushFrames", "RemoveObjects", "SetFutures"}) {
      roles->emplace(method, Role::kPush);
    }
    return roles;
  }();
  return *kRoles;
}

}  // namespace

Caller CallerOf(const grpc::ServerContext& context) {
  Caller caller{context.peer(), {}, {}};
  const auto [first, last] = context.client_metadata().equal_range("authorization");
  for (auto entry = first; entry != last; ++entry) {
    caller.authorizations.emplace_back(entry->second.data(), entry->second.size());
  }
  const auto auth = context.auth_context();
  if (auth == nullptr || !auth->IsPeerAuthenticated()) return caller;
  for (const char* property : {GRPC_X509_CN_PROPERTY_NAME, GRPC_X509_SAN_PROPERTY_NAME}) {
    for (const grpc::string_ref& name : auth->FindPropertyValues(property)) {
      caller.certificate_names.emplace_back(name.data(), name.size());
    }
  }
  return caller;
}

Role RoleFor(const std::string& method) {
  const auto found = Roles().find(method);
  return found == Roles().end() ? Role::kAdmin : found->second;
}

void AccessControl::Replace(std::optional<TokenTable> table) {
  auto fresh = table ? std::make_shared<const TokenTable>(*std::move(table)) : nullptr;
  const std::lock_guard lock(mutex_);
  table_ = std::move(fresh);
}

std::shared_ptr<const TokenTable> AccessControl::Table() const {
  const std::lock_guard lock(mutex_);
  return table_;
}

absl::StatusOr<Peer> AccessControl::Identify(const Caller& caller) const {
  const std::shared_ptr<const TokenTable> table = Table();
  if (table == nullptr) {
    const bool certified = !caller.certificate_names.empty();
    return Peer{certified ? caller.certificate_names.front() : caller.connection, Role::kAdmin};
  }
  if (!caller.authorizations.empty()) {
    const absl::StatusOr<std::string> token = TokenOf(caller.authorizations);
    if (!token.ok()) return token.status();
    const TokenEntry* const entry = table->FindToken(*token);
    if (entry != nullptr) return Peer{entry->name, entry->role};
    return Unauthenticated("authorization: the token is wrong, or was revoked", "WRONG_TOKEN");
  }
  for (const std::string& name : caller.certificate_names) {
    const TokenEntry* const entry = table->FindCertificate(name);
    if (entry != nullptr) return Peer{entry->name, entry->role};
  }
  return Unauthenticated("authorization: is missing; this server needs a token", "NO_TOKEN");
}

// Where nobody needs to show anything, nothing is looked at: each call passes here.
absl::StatusOr<Peer> AccessControl::Identify(const grpc::ServerContext& context) const {
  if (!certificates_ && Table() == nullptr) return Peer{context.peer(), Role::kAdmin};
  return Identify(CallerOf(context));
}

std::string AccessControl::NameOf(const grpc::ServerContext& context) const {
  const absl::StatusOr<Peer> peer = Identify(context);
  return peer.ok() ? peer->name : context.peer();  // whose token was revoked meanwhile
}

absl::Status CheckRole(const Peer& peer, const std::string& method) {
  const Role needed = RoleFor(method);
  if (peer.role >= needed) return absl::OkStatus();
  return WithReason(
      absl::PermissionDeniedError(absl::StrCat(method, " needs the role ", ToText(needed), "; ",
                                               peer.name, " has ", ToText(peer.role))),
      "ROLE");
}

}  // namespace clearway
