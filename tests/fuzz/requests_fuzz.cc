// Requests. The first line is the method, as in "/clearway.v1.MapService/Reset", the rest the bytes
// of the one message that it gets. Nothing is answered with INTERNAL or UNKNOWN, and what refuses a
// request changes no scene.
#include <google/protobuf/descriptor.h>

#include <map>

#include "absl/strings/str_cat.h"
#include "fuzz/fuzz.h"
#include "fuzz/scratch_server.h"

namespace clearway::fuzz {
namespace {

using google::protobuf::DescriptorPool;
using google::protobuf::MethodDescriptor;
using std::chrono::milliseconds;

// By the name that a call has.
const std::map<std::string, const MethodDescriptor*>& Methods() {
  static const auto* const kMethods = [] {
    auto* methods = new std::map<std::string, const MethodDescriptor*>;
    for (const char* name :
         {"Check", "Follow", "Ingest", "Lease", "Map", "Object", "Occupancy", "Plan", "Server"}) {
      const std::string full_name = absl::StrCat("clearway.v1.", name, "Service");
      const auto* const service = DescriptorPool::generated_pool()->FindServiceByName(full_name);
      Require(service != nullptr, full_name + ": no such service");
      for (int i = 0; i < service->method_count(); ++i) {
        const MethodDescriptor* const method = service->method(i);
        methods->emplace(absl::StrCat("/", full_name, "/", method->name()), method);
      }
    }
    return methods;
  }();
  return *kMethods;
}

// Streams that go on until the client leaves.
bool IsEndless(const MethodDescriptor& method) {
  return method.name() == "FollowScene" || method.name() == "WatchMotions";
}

// Whether the scene may be another one after that: what a client gave up may still be applied.
bool MayHaveChanged(const grpc::Status& status) {
  return status.ok() || status.error_code() == grpc::StatusCode::DEADLINE_EXCEEDED ||
         status.error_code() == grpc::StatusCode::CANCELLED;
}

void Run(std::string_view input) {
  static auto* const server = new ScratchServer;  // as long as the process
  const std::string name(TakeLine(input));
  const auto found = Methods().find(name);
  if (found == Methods().end()) return;
  const std::uint64_t version = server->version();
  const milliseconds patience(IsEndless(*found->second) ? 20 : 20'000);
  const grpc::Status status = server->Call(name, input, patience);
  const std::string text =
      absl::StrCat(name, ": ", status.error_code(), " ", status.error_message());
  Require(status.error_code() != grpc::StatusCode::INTERNAL &&
              status.error_code() != grpc::StatusCode::UNKNOWN,
          text);
  const bool changed = server->version() != version;
  Require(!changed || MayHaveChanged(status), text + ": changed the scene");
  static int calls = 0;  // robots are evicted without a new version
  if (changed || ++calls % 100 == 0) server->Restore();
}

}  // namespace
}  // namespace clearway::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  clearway::fuzz::Run(clearway::fuzz::TextOf(data, size));
  return 0;
}
