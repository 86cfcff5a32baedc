// A call by its name, with bytes for messages.
#pragma once

#include <grpcpp/grpcpp.h>
#include <grpcpp/impl/client_unary_call.h>

namespace clearway::testing_support {

inline grpc::Status RawCall(grpc::Channel& channel, const char* method,
                            const grpc::ByteBuffer& request, grpc::ByteBuffer& response) {
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(30));
  context.set_wait_for_ready(true);
  return grpc::internal::BlockingUnaryCall(
      &channel, grpc::internal::RpcMethod(method, grpc::internal::RpcMethod::NORMAL_RPC), &context,
      request, &response);
}

// Sends one message through a stream of any kind and returns what it ends with.
inline grpc::Status RawStream(grpc::Channel& channel, const char* method,
                              const grpc::ByteBuffer& request) {
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(30));
  const std::unique_ptr<grpc::ClientReaderWriter<grpc::ByteBuffer, grpc::ByteBuffer>> stream(
      grpc::internal::ClientReaderWriterFactory<grpc::ByteBuffer, grpc::ByteBuffer>::Create(
          &channel, grpc::internal::RpcMethod(method, grpc::internal::RpcMethod::BIDI_STREAMING),
          &context));
  stream->Write(request);
  stream->WritesDone();
  grpc::ByteBuffer response;
  while (stream->Read(&response)) {
  }
  return stream->Finish();
}

}  // namespace clearway::testing_support
