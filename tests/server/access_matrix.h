// Every method, and who may call it.
#pragma once

#include <grpcpp/grpcpp.h>

#include <string>
#include <vector>

#include "clearway/wire/token_table.h"
#include "google/protobuf/descriptor.h"

namespace clearway::testing_support {

// A client's role and token, and its line in the server's file.
struct TokenHolder {
  TokenHolder(const std::string& name, Role may) : role(may), made(*MakeToken(name, may)) {}
  std::string authorization() const { return "Bearer " + made.token; }

  Role role;
  NewToken made;
};

// Of all services of clearway.v1.
std::vector<const google::protobuf::MethodDescriptor*> AllMethods();

Role NeededFor(const std::string& method);

// What a call of the method with an empty message ends with; DEADLINE_EXCEEDED for streams that go
// on.
grpc::StatusCode CodeOf(grpc::Channel& channel, const google::protobuf::MethodDescriptor& method,
                        const std::string& authorization);

// Whether the code is that of a client of this role, which may or may not call the method.
bool IsCodeFor(Role role, const google::protobuf::MethodDescriptor& method, grpc::StatusCode code);

}  // namespace clearway::testing_support
