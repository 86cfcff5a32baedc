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
}

absl::StatusOr<std::shared_ptr<Connection>> Connect(const ServerFlags& flags) {
  ConnectionOptions options;
  options.deadline = FromSeconds(flags.timeout_s);
  options.retry_for = std::min(options.retry_for, options.deadline / 2);
  options.tls_root_certificates_file = flags.tls_root_certificates_file;
  auto connection = Connection::Open(flags.address, options);
  const absl::Status& status = connection.status();
  const std::string message(status.message());
  for (const auto& [field, flag] :
       {std::pair<std::string, std::string>{"address: ", "--server or CLEARWAY_ADDRESS: "},
        {"tls_root_certificates_file: ", "--tls-roots: "}}) {
    if (!message.starts_with(field)) continue;
    return absl::Status(status.code(), absl::StrCat(flag, message.substr(field.size())));
  }
  if (DetailsOf(status).reason == "TLS") {
    return absl::Status(status.code(),
                        absl::StrCat(std::string(status.message()),
                                     ".\n--tls-roots names the root certificates of a server that "
                                     "talks TLS."));
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
