// Converters of frame.proto and ingest_service.proto.
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "clearway/scene/depth_image.h"
#include "clearway/scene/frame.h"
#include "clearway/v1/ingest_service.pb.h"
#include "clearway/wire/push_ack.h"

namespace clearway {

void Write(const Frame& frame, v1::Frame* proto);
// A frame without points, whose points are the image's.
void Write(const Frame& frame, const DepthImage& image, v1::Frame* proto);
// INVALID_ARGUMENT or RESOURCE_EXHAUSTED naming the field, after `field`: whatever Validate(frame)
// refuses, and what is missing; of a depth image, as ReadDepthImage. Its points are the frame's.
absl::StatusOr<Frame> ReadFrame(const std::string& field, const v1::Frame& proto,
                                const FrameLimits& limits);

v1::AckLevel ToProto(AckLevel level);
absl::StatusOr<AckLevel> ReadAckLevel(const std::string& field, int proto);

void Write(const PushAck& ack, v1::PushFrameResponse* proto);
PushAck ReadPushAck(const v1::PushFrameResponse& proto);

}  // namespace clearway
