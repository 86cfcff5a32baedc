// A hash of everything that a message holds.
#pragma once

#include <cstdint>

#include "google/protobuf/message_lite.h"

namespace clearway {

// XXH3-64 of the message's deterministic bytes, unknown fields included: equal for equal messages
// of one build of the server. Takes 64 KB whatever the message's size, and no more than two passes
// over its bytes.
std::uint64_t ContentHash(const google::protobuf::MessageLite& message);

}  // namespace clearway
