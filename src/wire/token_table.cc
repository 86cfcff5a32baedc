#include "clearway/wire/token_table.h"

#include <openssl/crypto.h>
#include <openssl/rand.h>
#include <openssl/sha.h>

#include <algorithm>

#include "absl/strings/ascii.h"
#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "absl/strings/strip.h"
#include "clearway/base/secret_file.h"

namespace clearway {
namespace {

constexpr std::uint64_t kMaxBytes = 1 << 20;
constexpr std::size_t kMaxName = 64;
constexpr std::size_t kTokenBytes = 32;
constexpr char kTokenPrefix[] = "cw_";  // so that scanners for secrets can find them
constexpr char kHashPrefix[] = "sha256:";

Sha256 HashOf(const std::string& token) {
  Sha256 hash;
  SHA256(reinterpret_cast<const unsigned char*>(token.data()), token.size(), hash.data());
  return hash;
}

std::string ToHex(const Sha256& hash) {
  return absl::BytesToHexString({reinterpret_cast<const char*>(hash.data()), hash.size()});
}

std::optional<Sha256> ParseHash(absl::string_view text) {
  Sha256 hash;
  if (!absl::ConsumePrefix(&text, kHashPrefix) || text.size() != 2 * hash.size()) return {};
  if (!std::all_of(text.begin(), text.end(), absl::ascii_isxdigit)) return {};
  const std::string bytes = absl::HexStringToBytes(text);
  std::copy(bytes.begin(), bytes.end(), hash.begin());
  return hash;
}

bool IsName(absl::string_view text) {
  return !text.empty() && text.size() <= kMaxName && std::ranges::all_of(text, [](unsigned char c) {
    return absl::ascii_isalnum(c) || std::string_view("._-@").find(char(c)) != std::string::npos;
  });
}

absl::Status BadName(absl::string_view name) {
  return absl::InvalidArgumentError(
      absl::StrCat("\"", absl::CHexEscape(name.substr(0, kMaxName)),
                   "\" is not a name: 1 to 64 letters, digits and the signs . _ - @"));
}

absl::StatusOr<TokenEntry> ParseLine(absl::string_view line) {
  const std::vector<std::string> words =
      absl::StrSplit(line, absl::ByAnyChar(" \t"), absl::SkipEmpty());
  if (words.size() != 3) {
    return absl::InvalidArgumentError(
        absl::StrCat("has ", words.size(),
                     " words; it must be NAME ROLE sha256:HEX, or NAME ROLE "
                     "certificate"));
  }
  if (!IsName(words[0])) return BadName(words[0]);
  const std::optional<Role> role = ParseRole(words[1]);
  if (!role) {
    return absl::InvalidArgumentError(
        absl::StrCat("\"", absl::CHexEscape(words[1]), "\" is not a role: read, push or admin"));
  }
  if (words[2] == "certificate") return TokenEntry{words[0], *role, std::nullopt};
  const std::optional<Sha256> hash = ParseHash(words[2]);
  if (hash) return TokenEntry{words[0], *role, *hash};
  return absl::InvalidArgumentError(
      "the third word must be sha256: and 64 hexadecimal digits, or certificate");
}

}  // namespace

const char* ToText(Role role) {
  switch (role) {
    case Role::kRead:
      return "read";
    case Role::kPush:
      return "push";
    case Role::kAdmin:
      break;
  }
  return "admin";
}

std::optional<Role> ParseRole(const std::string& text) {
  for (const Role role : {Role::kRead, Role::kPush, Role::kAdmin}) {
    if (text == ToText(role)) return role;
  }
  return std::nullopt;
}

absl::StatusOr<TokenTable> TokenTable::Parse(const std::string& path, const std::string& text) {
  TokenTable table;
  int number = 0;
  for (absl::string_view line : absl::StrSplit(text, '\n')) {
    ++number;
    line = absl::StripAsciiWhitespace(line.substr(0, line.find('#')));
    if (line.empty()) continue;
    absl::StatusOr<TokenEntry> entry = ParseLine(line);
    const bool twice = entry.ok() && std::ranges::any_of(table.entries_, [&](const auto& other) {
                         return other.name == entry->name;
                       });
    if (twice) {
      entry = absl::InvalidArgumentError(absl::StrCat("\"", entry->name, "\" is there twice"));
    }
    if (!entry.ok()) {
      return absl::InvalidArgumentError(
          absl::StrCat(path, ", line ", number, ": ", entry.status().message()));
    }
    table.entries_.push_back(*std::move(entry));
  }
  return table;
}

absl::StatusOr<TokenTable> TokenTable::Read(const std::string& path) {
  const absl::StatusOr<std::string> text = ReadSecretFile(path, kMaxBytes);
  return text.ok() ? Parse(path, *text) : text.status();
}

const TokenEntry* TokenTable::FindToken(const std::string& token) const {
  const Sha256 hash = HashOf(token);
  const TokenEntry* found = nullptr;
  for (const TokenEntry& entry : entries_) {
    if (!entry.token_hash) continue;
    if (CRYPTO_memcmp(entry.token_hash->data(), hash.data(), hash.size()) == 0) found = &entry;
  }
  return found;
}

const TokenEntry* TokenTable::FindCertificate(const std::string& name) const {
  const auto found = std::ranges::find_if(
      entries_, [&](const TokenEntry& entry) { return !entry.token_hash && entry.name == name; });
  return found == entries_.end() ? nullptr : &*found;
}

absl::StatusOr<NewToken> MakeToken(const std::string& name, Role role) {
  if (!IsName(name)) return BadName(name);
  std::array<unsigned char, kTokenBytes> random;
  if (RAND_bytes(random.data(), static_cast<int>(random.size())) != 1) {
    return absl::UnavailableError("the system has no random numbers");
  }
  const std::string token = absl::StrCat(
      kTokenPrefix,
      absl::WebSafeBase64Escape({reinterpret_cast<const char*>(random.data()), random.size()}));
  return NewToken{token,
                  absl::StrCat(name, " ", ToText(role), " ", kHashPrefix, ToHex(HashOf(token)))};
}

}  // namespace clearway
