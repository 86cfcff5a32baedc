#include "server/access_matrix.h"

#include <gtest/gtest.h>

#include <chrono>
#include <set>

#include "absl/strings/str_cat.h"
#include "support/raw_call.h"

namespace clearway::testing_support {

std::vector<const google::protobuf::MethodDescriptor*> AllMethods() {
  std::vector<const google::protobuf::MethodDescriptor*> methods;
  for (const char* name :
       {"Check", "Follow", "Ingest", "Lease", "Map", "Object", "Occupancy", "Plan", "Server"}) {
    const auto* service = google::protobuf::DescriptorPool::generated_pool()->FindServiceByName(
        absl::StrCat("clearway.v1.", name, "Service"));
    EXPECT_NE(service, nullptr) << name;
    for (int i = 0; service != nullptr && i < service->method_count(); ++i) {
      methods.push_back(service->method(i));
    }
  }
  EXPECT_GE(methods.size(), 29u);
  return methods;
}

Role NeededFor(const std::string& method) {
  static const std::set<std::string> kPush = {"PushFrame", "PushFrames", "AddObjects",
                                              "RemoveObjects", "SetFutures"};
  static const std::set<std::string> kAdmin = {"Reset", "LoadPrior", "ClearRegion", "SetKeepOut"};
  return kAdmin.count(method) > 0  ? Role::kAdmin
         : kPush.count(method) > 0 ? Role::kPush
                                   : Role::kRead;
}

grpc::StatusCode CodeOf(grpc::Channel& channel, const google::protobuf::MethodDescriptor& method,
                        const std::string& authorization) {
  const std::string path = absl::StrCat("/", method.service()->full_name(), "/", method.name());
  const grpc::Slice nothing;
  const grpc::ByteBuffer request(&nothing, 1);
  const bool streams = method.client_streaming() || method.server_streaming();
  return RawStream(channel, path.c_str(), request, authorization,
                   std::chrono::milliseconds(streams ? 500 : 10'000))
      .error_code();
}

bool IsCodeFor(Role role, const google::protobuf::MethodDescriptor& method, grpc::StatusCode code) {
  const bool may = role >= NeededFor(method.name());
  return code != grpc::StatusCode::UNAUTHENTICATED && code != grpc::StatusCode::UNAVAILABLE &&
         (code == grpc::StatusCode::PERMISSION_DENIED) == !may;
}

}  // namespace clearway::testing_support
