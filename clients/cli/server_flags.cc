#include "cli/server_flags.h"

#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "clearway/client/error_details.h"
#include "cli/cli.h"

namespace clearway::cli {

void AddServerFlags(CLI::App* command, ServerFlags* flags) {
  command->add_option("--server", flags->address, "Address of the server, host:port or unix:/path")
      ->envname("CLEARWAY_ADDRESS")
      ->capture_default_str()
      ->group("Server");
  command->add_option("--timeout", flags->timeout_s, "Longest wait for an answer, in seconds")
      ->check(Between(0.001, 1e6))
      ->capture_default_str()
      ->group("Server");
  command
      ->add_option("--tls-roots", flags->tls_root_certificates_file,
                   "Talk TLS; trust the root certificates of this PEM file")
      ->check(CLI::ExistingFile.description(""))
      ->group("Server");
  command
      ->add_option("--tls-cert", flags->tls_certificate_file,
                   "Show the server the certificate of this PEM file")
      ->group("Server");
  command->add_option("--tls-key", flags->tls_key_file, "PEM file of its private key")
      ->group("Server");
  command
      ->add_option("--token-file", flags->token_file,
                   "File of the token to show (clearway token add)")
      ->envname("CLEARWAY_TOKEN_FILE")
      ->group("Server");
  command
      ->add_flag("--insecure", flags->insecure,
                 "Send the token without TLS, though others may read it")
      ->group("Server");
}

absl::StatusOr<std::shared_ptr<Connection>> Connect(const ServerFlags& flags) {
  ConnectionOptions options;
  options.deadline = FromSeconds(flags.timeout_s);
  options.retry_for = std::min(options.retry_for, options.deadline / 2);
  options.tls_root_certificates_file = flags.tls_root_certificates_file;
  options.tls_certificate_file = flags.tls_certificate_file;
  options.tls_key_file = flags.tls_key_file;
  options.token_file = flags.token_file;
  options.insecure = flags.insecure;
  auto connection = Connection::Open(flags.address, options);
  const absl::Status& status = connection.status();
  const std::string message(status.message());
  for (const auto& [field, flag] :
       {std::pair<std::string, std::string>{"address: ", "--server or CLEARWAY_ADDRESS: "},
        {"tls_root_certificates_file: ", "--tls-roots: "},
        {"tls_certificate_file: ", "--tls-cert: "},
        {"tls_key_file: ", "--tls-key: "},
        {"token_file: ", "--token-file or CLEARWAY_TOKEN_FILE: "}}) {
    if (!message.starts_with(field)) continue;
    return absl::Status(status.code(), absl::StrCat(flag, message.substr(field.size())));
  }
  if (DetailsOf(status).reason == "TLS") {
    return absl::Status(status.code(),
                        absl::StrCat(std::string(status.message()),
                                     ".\n--tls-roots names the root certificates of a server that "
                                     "talks TLS."));
  }
  if (absl::IsUnauthenticated(status)) {
    return absl::Status(status.code(), absl::StrCat(message,
                                                    ".\n--token-file names a file of the "
                                                    "token; 'clearway token add' makes one."));
  }
  if (absl::IsUnavailable(status) || absl::IsDeadlineExceeded(status)) {
    return absl::Status(status.code(),
                        absl::StrCat("no server answers at ", flags.address, " (", message,
                                     ").\nStart one with 'clearway-server', or name another with "
                                     "--server or CLEARWAY_ADDRESS."));
  }
  return connection;
}

}  // namespace clearway::cli
