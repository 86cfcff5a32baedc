// What a client shows a server of who it is.
#pragma once

#include <grpcpp/grpcpp.h>

#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/client/connection.h"
#include "wire/server_address.h"

namespace clearway {

struct ClientCredentials {
  std::shared_ptr<grpc::ChannelCredentials> channel;
  std::string token;  // empty: none
};

bool IsThisMachine(const ServerAddress& address);

// Reads the files that the options name. Errors begin with the option's name.
absl::StatusOr<ClientCredentials> ReadCredentials(const ConnectionOptions& options,
                                                  const ServerAddress& address);

// Of a channel whose calls all show the token.
std::vector<std::unique_ptr<grpc::experimental::ClientInterceptorFactoryInterface>> InterceptorsFor(
    const std::string& token);

}  // namespace clearway
