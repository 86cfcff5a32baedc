// Converter of DepthImage in frame.proto.
#pragma once

#include <cstddef>
#include <string>

#include "absl/status/statusor.h"
#include "clearway/scene/depth_image.h"
#include "clearway/v1/frame.pb.h"

namespace clearway {

// Masks whose values fit are written with a byte per pixel.
void Write(const DepthImage& image, v1::DepthImage* proto);

// A valid image. INVALID_ARGUMENT or RESOURCE_EXHAUSTED naming the field as "depth_image.fx":
// whatever Validate(image) refuses, what is missing, and bytes that are not those of width x height
// pixels. Memory for pixels is taken after their number and the bytes have been checked.
absl::StatusOr<DepthImage> ReadDepthImage(const v1::DepthImage& proto, std::size_t max_points);

}  // namespace clearway
