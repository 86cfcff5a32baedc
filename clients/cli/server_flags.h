// Flags that choose a server, and the connection to it.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "clearway/client/connection.h"

namespace clearway::cli {

struct ServerFlags {
  std::string address = "127.0.0.1:50151";
  double timeout_s = 10;
  std::string tls_root_certificates_file, tls_certificate_file, tls_key_file;
  std::string token_file;
  bool insecure = false;
};

// --server (or CLEARWAY_ADDRESS), --timeout, --tls-roots, --tls-cert, --tls-key, --token-file (or
// CLEARWAY_TOKEN_FILE), --insecure.
void AddServerFlags(CLI::App* command, ServerFlags* flags);

// An error says which server did not answer and what to do about it.
absl::StatusOr<std::shared_ptr<Connection>> Connect(const ServerFlags& flags);

}  // namespace clearway::cli
