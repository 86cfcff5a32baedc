#include "server/transport.h"

#include <algorithm>
#include <limits>

#include "server/pollers.h"

namespace clearway {
namespace {

constexpr int kMaxPingStrikes = 2;  // pings that come too early before a client is disconnected
constexpr int kSpareThreads = 64;   // of gRPC's own, beyond one per call

void SetLimits(const ServerLimits& limits, grpc::ServerBuilder& builder) {
  // Handlers refuse what is above max_message_bytes, and name the field; the transport cannot, so
  // it only keeps the rest from being taken in.
  constexpr std::uint64_t kMostOfGrpc = std::numeric_limits<int>::max();
  builder.SetMaxReceiveMessageSize(
      static_cast<int>(std::min(2 * limits.max_message_bytes, kMostOfGrpc)));
  builder.SetMaxSendMessageSize(-1);  // replies are bounded by the limits on questions
  constexpr std::uint64_t kMostStreams = 1 << 30;
  builder.AddChannelArgument(GRPC_ARG_MAX_CONCURRENT_STREAMS,
                             static_cast<int>(std::min(limits.max_calls, kMostStreams)));
  SetPollers(builder);
  grpc::ResourceQuota quota("clearway");
  quota.SetMaxThreads(static_cast<int>(limits.max_calls) + kSpareThreads);
  builder.SetResourceQuota(quota);
}

// A peer that vanished without a word is found by pings, and its streams end.
void SetKeepalive(const KeepaliveConfig& keepalive, grpc::ServerBuilder& builder) {
  const auto set = [&](const char* argument, Duration duration) {
    builder.AddChannelArgument(argument, static_cast<int>(duration.count() / 1'000'000));
  };
  set(GRPC_ARG_KEEPALIVE_TIME_MS, keepalive.time);
  set(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, keepalive.timeout);
  // Connections without calls and streams without data are pinged as well, and may ping.
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);
  set(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS, keepalive.min_client_ping);
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MAX_PING_STRIKES, kMaxPingStrikes);
  // Likewise one that connects and says nothing.
  set(GRPC_ARG_SERVER_HANDSHAKE_TIMEOUT_MS, keepalive.time + keepalive.timeout);
}

// A small message that is compressed may hold any number of bytes, and gRPC would unpack them all.
void RefuseCompression(grpc::ServerBuilder& builder) {
  for (const auto algorithm : {GRPC_COMPRESS_DEFLATE, GRPC_COMPRESS_GZIP}) {
    builder.SetCompressionAlgorithmSupportStatus(algorithm, false);
  }
  builder.AddChannelArgument(GRPC_ARG_ENABLE_PER_MESSAGE_DECOMPRESSION, 0);
  builder.AddChannelArgument(GRPC_ARG_ENABLE_PER_MESSAGE_COMPRESSION, 0);
}

}  // namespace

void SetTransport(const ServerConfig& config, grpc::ServerBuilder& builder) {
  SetLimits(config.limits, builder);
  SetKeepalive(config.keepalive, builder);
  RefuseCompression(builder);
}

}  // namespace clearway
