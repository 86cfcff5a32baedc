#include "clearway/scene/depth_image.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"

namespace clearway {
namespace {

constexpr std::uint32_t kMaxSide = 65'535;  // pixels; their number then fits any integer here
constexpr std::size_t kMaxMaskValues = 65'536;

absl::Status Invalid(const char* field, const std::string& what) {
  return absl::InvalidArgumentError(absl::StrCat("depth_image.", field, ": ", what));
}

absl::Status CheckSide(const char* field, std::uint32_t pixels) {
  if (pixels >= 1 && pixels <= kMaxSide) return absl::OkStatus();
  return Invalid(field, absl::StrCat("is ", pixels, "; it must be from 1 to ", kMaxSide));
}

absl::Status CheckFinite(const char* field, double value) {
  return std::isfinite(value) ? absl::OkStatus() : Invalid(field, "is not finite");
}

absl::Status CheckPositive(const char* field, double value) {
  if (!std::isfinite(value)) return CheckFinite(field, value);
  if (value > 0) return absl::OkStatus();
  return Invalid(field, absl::StrCat("is ", NumberText(value), "; it must be above 0"));
}

absl::Status CheckMaskLabels(const std::vector<ObjectId>& labels) {
  if (labels.size() > kMaxMaskValues) {
    return absl::ResourceExhaustedError(absl::StrCat("depth_image.mask_labels: has ", labels.size(),
                                                     " entries; the limit is ", kMaxMaskValues));
  }
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] >= kIgnoreLabel) continue;
    return Invalid(absl::StrCat("mask_labels[", i, "]").c_str(),
                   absl::StrCat("is ", labels[i], "; the lowest label is -1"));
  }
  return absl::OkStatus();
}

std::string SizeOf(const DepthImage& image) {
  return absl::StrCat(image.width, " x ", image.height, " pixels");
}

absl::Status CheckDepth(const DepthImage& image) {
  if (!image.depth.empty() && !image.depth_m.empty()) {
    return Invalid("depth_m", "is given beside depth; only one of them may be");
  }
  const bool metres = !image.depth_m.empty();
  const std::size_t entries = metres ? image.depth_m.size() : image.depth.size();
  if (entries == PixelCount(image)) return absl::OkStatus();
  return Invalid(
      metres ? "depth_m" : "depth",
      absl::StrCat("has ", entries, " entries; ", SizeOf(image), " need ", PixelCount(image)));
}

absl::Status CheckMask(const DepthImage& image) {
  const std::vector<std::uint16_t>& mask = image.instance_mask;
  if (mask.empty() && !image.mask_labels.empty()) {
    return Invalid("mask_labels", "there is no instance_mask that they could be of");
  }
  if (!mask.empty() && mask.size() != PixelCount(image)) {
    return Invalid("instance_mask", absl::StrCat("has ", mask.size(), " entries; ", SizeOf(image),
                                                 " need ", PixelCount(image), ", or none"));
  }
  if (image.mask_labels.empty()) return absl::OkStatus();
  const auto bad = std::find_if(mask.begin(), mask.end(), [&](std::uint16_t value) {
    return value >= image.mask_labels.size();
  });
  if (bad == mask.end()) return absl::OkStatus();
  const auto at = static_cast<std::uint64_t>(bad - mask.begin());
  return Invalid("instance_mask",
                 absl::StrCat("the pixel in column ", at % image.width, ", row ", at / image.width,
                              " is ", *bad, "; mask_labels has ", image.mask_labels.size(),
                              " entries, the first of them for 0"));
}

std::uint64_t UsedOf(std::uint32_t side, std::uint32_t stride) {
  return stride == 0 ? 0 : (std::uint64_t{side} + stride - 1) / stride;
}

// Of the rays through each used column (row), x (y) at z = 1.
std::vector<double> Slopes(std::uint32_t side, std::uint32_t stride, double focal, double center) {
  std::vector<double> slopes;
  slopes.reserve(UsedOf(side, stride));
  for (std::uint64_t i = 0; i < side; i += stride) {
    slopes.push_back((static_cast<double>(i) - center) / focal);
  }
  return slopes;
}

// 0 if there is no measurement.
double DepthOf(const DepthImage& image, std::size_t pixel) {
  if (image.depth_m.empty()) return image.depth[pixel] * image.depth_unit_m;
  const float z_m = image.depth_m[pixel];
  return std::isfinite(z_m) && z_m > 0 ? z_m : 0;
}

ObjectId LabelOf(const DepthImage& image, std::size_t pixel) {
  if (image.instance_mask.empty()) return kStaticLabel;
  const std::uint16_t value = image.instance_mask[pixel];
  return image.mask_labels.empty() ? ObjectId{value} : image.mask_labels[value];
}

}  // namespace

std::uint64_t PixelCount(const DepthImage& image) {
  return std::uint64_t{image.width} * image.height;
}

std::uint64_t UsedPixelCount(const DepthImage& image) {
  return UsedOf(image.width, image.stride) * UsedOf(image.height, image.stride);
}

absl::Status ValidateCamera(const DepthImage& image, std::size_t max_points) {
  for (const absl::Status& status :
       {CheckSide("width", image.width), CheckSide("height", image.height),
        image.stride == 0 ? Invalid("stride", "is 0; the least is 1") : absl::OkStatus(),
        CheckPositive("depth_unit_m", image.depth_unit_m), CheckPositive("fx", image.fx),
        CheckPositive("fy", image.fy), CheckFinite("cx", image.cx), CheckFinite("cy", image.cy),
        CheckPositive("max_depth_m", image.max_depth_m.value_or(1)),
        CheckMaskLabels(image.mask_labels)}) {
    if (!status.ok()) return status;
  }
  if (const std::uint64_t used = UsedPixelCount(image); used > max_points) {
    return absl::ResourceExhaustedError(absl::StrCat("depth_image: uses ", used, " of ",
                                                     SizeOf(image), " as points; the limit is ",
                                                     max_points, " (a larger stride uses fewer)"));
  }
  return absl::OkStatus();
}

absl::Status Validate(const DepthImage& image, std::size_t max_points) {
  if (auto status = ValidateCamera(image, max_points); !status.ok()) return status;
  if (auto status = CheckDepth(image); !status.ok()) return status;
  return CheckMask(image);
}

void SetPoints(const DepthImage& image, Frame& frame) {
  const std::vector<double> right = Slopes(image.width, image.stride, image.fx, image.cx);
  const std::vector<double> down = Slopes(image.height, image.stride, image.fy, image.cy);
  const double farthest_m = image.max_depth_m.value_or(std::numeric_limits<double>::infinity());
  frame.points_S.clear();
  frame.labels.clear();
  frame.no_return.clear();
  frame.origins_S.clear();
  frame.points_S.reserve(UsedPixelCount(image));
  frame.labels.reserve(UsedPixelCount(image));
  for (std::size_t j = 0; j < down.size(); ++j) {
    const std::size_t row = j * image.stride * image.width;
    for (std::size_t i = 0; i < right.size(); ++i) {
      const std::size_t pixel = row + i * image.stride;
      const double z_m = DepthOf(image, pixel);
      if (z_m == 0 || z_m > farthest_m) continue;
      frame.points_S.push_back(Eigen::Vector3d(right[i] * z_m, down[j] * z_m, z_m).cast<float>());
      frame.labels.push_back(LabelOf(image, pixel));
    }
  }
}

}  // namespace clearway
