// Calls by their names, with bytes for messages. `authorization` is sent as metadata, unless empty.
#pragma once

#include <grpcpp/grpcpp.h>
#include <grpcpp/impl/client_unary_call.h>
#include <grpcpp/support/sync_stream.h>

#include <chrono>
#include <memory>
#include <string>

namespace clearway::testing_support {

inline void Prepare(grpc::ClientContext& context, const std::string& authorization,
                    std::chrono::milliseconds patience) {
  context.set_deadline(std::chrono::system_clock::now() + patience);
  if (!authorization.empty()) context.AddMetadata("authorization", authorization);
}

inline grpc::Status RawCall(grpc::Channel& channel, const char* method,
                            const grpc::ByteBuffer& request, grpc::ByteBuffer& response,
                            const std::string& authorization = "") {
  grpc::ClientContext context;
  Prepare(context, authorization, std::chrono::seconds(30));
  context.set_wait_for_ready(true);
  return grpc::internal::BlockingUnaryCall(
      &channel, grpc::internal::RpcMethod(method, grpc::internal::RpcMethod::NORMAL_RPC), &context,
      request, &response);
}

// Sends one message through a stream of any kind and returns what it ends with.
inline grpc::Status RawStream(grpc::Channel& channel, const char* method,
                              const grpc::ByteBuffer& request,
                              const std::string& authorization = "",
                              std::chrono::milliseconds patience = std::chrono::seconds(30)) {
  grpc::ClientContext context;
  Prepare(context, authorization, patience);
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
