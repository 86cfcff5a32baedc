#include "server/status_interceptor.h"

#include "server/handler.h"

namespace clearway {
namespace {

absl::Status Explained(const grpc::Status& status) {
  if (status.error_code() == grpc::StatusCode::INTERNAL) {
    return GarbageError();
  }
  return {static_cast<absl::StatusCode>(status.error_code()), status.error_message()};
}

class StatusInterceptor : public grpc::experimental::Interceptor {
 public:
  void Intercept(grpc::experimental::InterceptorBatchMethods* methods) override {
    using grpc::experimental::InterceptionHookPoints;
    if (methods->QueryInterceptionHookPoint(InterceptionHookPoints::PRE_SEND_STATUS)) {
      const grpc::Status status = methods->GetSendStatus();
      if (!status.ok() && status.error_details().empty()) {
        methods->ModifySendStatus(ToGrpc(Explained(status)));
      }
    }
    methods->Proceed();
  }
};

class Factory : public grpc::experimental::ServerInterceptorFactoryInterface {
 public:
  grpc::experimental::Interceptor* CreateServerInterceptor(
      grpc::experimental::ServerRpcInfo*) override {
    return new StatusInterceptor;  // gRPC takes it over
  }
};

}  // namespace

std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface> MakeStatusInterceptor() {
  return std::make_unique<Factory>();
}

}  // namespace clearway
