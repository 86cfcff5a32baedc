// Depth images of a pinhole camera, and the points that they are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "absl/status/status.h"
#include "clearway/scene/frame.h"

namespace clearway {

// A depth image with a mask of what its pixels belong to. S is the camera's optical frame: x right,
// y down, z forward. Plain data: Validate says whether it is well formed.
struct DepthImage {
  std::uint32_t width = 0, height = 0;  // pixels
  // Row by row from the top left, in counts along z; 0: no measurement.
  std::vector<std::uint16_t> depth;
  double depth_unit_m = 0.001;  // of a count
  // Or, instead of `depth`, metres along z; NaN, infinity, 0 and what is below: no measurement.
  std::vector<float> depth_m;

  // The pinhole, in pixels; the middle of the top left pixel is (0, 0). Lenses are undistorted.
  double fx = 0, fy = 0, cx = 0, cy = 0;

  // Empty (all is static), or a value per pixel.
  std::vector<std::uint16_t> instance_mask;
  // Empty (a value is the label), or the label of each value: 0 static, -1 leave out.
  std::vector<ObjectId> mask_labels;

  std::uint32_t stride = 1;           // uses every n-th column and row, from the first ones
  std::optional<double> max_depth_m;  // what is farther along z is left out
};

// Pixels in an image, and those of them that its stride uses: the most points that it can be.
std::uint64_t PixelCount(const DepthImage& image);
std::uint64_t UsedPixelCount(const DepthImage& image);

// All that can be known before there is memory for the pixels: INVALID_ARGUMENT or
// RESOURCE_EXHAUSTED, naming the field as in the wire format ("depth_image.fx") and the limit:
// sizes of 0 or above 65,535, more used pixels than `max_points`, numbers that are not finite or
// not above 0, a stride of 0, more than 65,536 labels or one below -1.
absl::Status ValidateCamera(const DepthImage& image, std::size_t max_points);

// All of it: also depths in both units or none, arrays that do not have a value per pixel, labels
// without a mask, and a mask's value without a label, be its pixel used or not.
absl::Status Validate(const DepthImage& image, std::size_t max_points);

// Makes the used pixels that have a depth the frame's points, row by row, instead of what points,
// labels, no-return marks and origins it had: z = depth * depth_unit_m or depth_m, x = (column -
// cx) / fx * z, y = (row - cy) / fy * z, computed in double and kept as float. The image is valid.
void SetPoints(const DepthImage& image, Frame& frame);

}  // namespace clearway
