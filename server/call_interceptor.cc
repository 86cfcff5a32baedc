#include "server/call_interceptor.h"

#include "server/handler.h"

namespace clearway {
namespace {

absl::Status Explained(const grpc::Status& status) {
  if (status.error_code() == grpc::StatusCode::INTERNAL) {
    return GarbageError();
  }
  return {static_cast<absl::StatusCode>(status.error_code()), status.error_message()};
}

class CallInterceptor : public grpc::experimental::Interceptor {
 public:
  CallInterceptor(OpenCalls& calls, const grpc::ServerContextBase* context)
      : calls_(calls), context_(context) {}
  ~CallInterceptor() override { calls_.Ended(context_); }

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

 private:
  OpenCalls& calls_;
  const grpc::ServerContextBase* const context_;
};

class Factory : public grpc::experimental::ServerInterceptorFactoryInterface {
 public:
  explicit Factory(OpenCalls& calls) : calls_(calls) {}
  grpc::experimental::Interceptor* CreateServerInterceptor(
      grpc::experimental::ServerRpcInfo* info) override {
    return new CallInterceptor(calls_, info->server_context());  // gRPC takes it over
  }

 private:
  OpenCalls& calls_;
};

}  // namespace

std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface> MakeCallInterceptor(
    OpenCalls& calls) {
  return std::make_unique<Factory>(calls);
}

}  // namespace clearway
