// The answer to a pushed frame.
#pragma once

#include "clearway/scene/scene_builder.h"
#include "clearway/wire/server_info.h"

namespace clearway {

// How far a frame has come.
enum class AckLevel { kAccepted = 1, kApplied = 2, kDurable = 3 };

// The server's answer to a frame. Version: once applied, the first one with the frame in it;
// before, the newest.
struct PushAck : Versioned {
  AckLevel reached = AckLevel::kAccepted;
  FrameReport report;            // once applied
  bool repeated_answer = false;  // the remembered answer to an earlier push of the same frame
};

}  // namespace clearway
