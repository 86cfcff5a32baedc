// Who may do what on a server: the file of its tokens.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"

namespace clearway {

// What a client may do; each role includes those before it. docs/security.md lists the calls.
enum class Role {
  kRead,   // queries, robots, leases, following, planning
  kPush,   // frames, objects, futures
  kAdmin,  // reset, prior maps, regions, keep-out zones
};
const char* ToText(Role role);
std::optional<Role> ParseRole(const std::string& text);  // "read", "push" or "admin"

using Sha256 = std::array<std::uint8_t, 32>;

// One client. A plain value.
struct TokenEntry {
  std::string name;
  Role role = Role::kRead;
  // Of its token; none: its name is that of its TLS certificate.
  std::optional<Sha256> token_hash;
};

// The entries of a token file: a line each, "NAME ROLE sha256:HEX" or "NAME ROLE certificate"; what
// follows # is a comment. Tokens are 256 random bits, so a hash without salt tells nobody which
// token it is of. Const methods: any thread.
class TokenTable {
 public:
  // INVALID_ARGUMENT begins with `path` and the line. `text` is the whole file.
  static absl::StatusOr<TokenTable> Parse(const std::string& path, const std::string& text);
  // A secret file (ReadSecretFile) of at most 1 MB; other errors as Parse.
  static absl::StatusOr<TokenTable> Read(const std::string& path);

  const std::vector<TokenEntry>& entries() const { return entries_; }

  // The entry that the token belongs to, or null. How long it takes does not depend on the token.
  const TokenEntry* FindToken(const std::string& token) const;
  // The entry for certificates of that name, or null.
  const TokenEntry* FindCertificate(const std::string& name) const;

 private:
  std::vector<TokenEntry> entries_;
};

// A token nobody can guess, and its line of the file without the line's end. INVALID_ARGUMENT for a
// name that is not of 1 to 64 letters, digits and the signs . _ - @ (which no line or log can
// confuse).
struct NewToken {
  std::string token;
  std::string line;
};
absl::StatusOr<NewToken> MakeToken(const std::string& name, Role role);

}  // namespace clearway
