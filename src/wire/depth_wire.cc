#include "wire/depth_wire.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "wire/geometry_wire.h"
#include "wire/status.h"

namespace clearway {
namespace {

constexpr std::uint64_t kDepthBytes = 2, kDepthMetreBytes = 4;  // of a pixel

static_assert(std::endian::native == std::endian::little, "floats travel little endian");

// Little endian, whatever the machine is.
std::vector<std::uint16_t> ReadWords(const std::string& bytes) {
  std::vector<std::uint16_t> words(bytes.size() / 2);
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  for (std::size_t i = 0; i < words.size(); ++i) {
    words[i] = static_cast<std::uint16_t>(byte(2 * i) | byte(2 * i + 1) << 8);
  }
  return words;
}

void WriteWords(const std::vector<std::uint16_t>& words, std::string* bytes) {
  bytes->resize(2 * words.size());
  for (std::size_t i = 0; i < words.size(); ++i) {
    (*bytes)[2 * i] = static_cast<char>(words[i] & 0xff);
    (*bytes)[2 * i + 1] = static_cast<char>(words[i] >> 8);
  }
}

std::vector<float> ReadFloats(const std::string& bytes) {
  std::vector<float> floats(bytes.size() / sizeof(float));
  if (!floats.empty()) std::memcpy(floats.data(), bytes.data(), floats.size() * sizeof(float));
  return floats;
}

// Everything but the arrays of pixels.
DepthImage ReadCamera(const v1::DepthImage& proto, FieldReader& read) {
  const bool metres = !proto.depth_m().empty();
  read.Require(metres || proto.has_depth_unit_m(), "depth_unit_m", "is missing");
  read.Require(!metres || !proto.has_depth_unit_m(), "depth_unit_m",
               "is for depth; depth_m is in metres");
  read.Require(!metres || proto.depth().empty(), "depth_m",
               "is given beside depth; only one of them may be");
  read.Require(proto.has_fx(), "fx", "is missing");
  read.Require(proto.has_fy(), "fy", "is missing");
  read.Require(proto.has_cx(), "cx", "is missing");
  read.Require(proto.has_cy(), "cy", "is missing");
  constexpr std::uint64_t kMaxMaskValues = 65'536;
  read.AtMost("mask_labels", proto.mask_labels_size(), kMaxMaskValues);
  DepthImage image;
  if (!read.ok()) return image;
  image.width = proto.width();
  image.height = proto.height();
  if (!metres) image.depth_unit_m = proto.depth_unit_m();
  image.fx = proto.fx();
  image.fy = proto.fy();
  image.cx = proto.cx();
  image.cy = proto.cy();
  image.mask_labels.assign(proto.mask_labels().begin(), proto.mask_labels().end());
  image.stride = std::max<std::uint32_t>(1, proto.stride());
  if (proto.has_max_depth_m()) image.max_depth_m = proto.max_depth_m();
  return image;
}

void CheckBytes(const v1::DepthImage& proto, std::uint64_t pixels, FieldReader& read) {
  const std::string size = absl::StrCat(proto.width(), " x ", proto.height(), " pixels need ");
  const bool metres = !proto.depth_m().empty();
  const std::uint64_t depth_bytes = metres ? proto.depth_m().size() : proto.depth().size();
  const std::uint64_t needed = pixels * (metres ? kDepthMetreBytes : kDepthBytes);
  if (depth_bytes != needed) {
    read.Fail(metres ? "depth_m" : "depth",
              absl::StrCat("has ", depth_bytes, " bytes; ", size, needed));
  }
  const std::uint64_t bytes = proto.instance_mask().size();
  if (bytes != 0 && bytes != pixels && bytes != 2 * pixels) {
    read.Fail("instance_mask", absl::StrCat("has ", bytes, " bytes; ", size, pixels, " or ",
                                            2 * pixels, ", or none"));
  }
}

}  // namespace

void Write(const DepthImage& image, v1::DepthImage* proto) {
  proto->set_width(image.width);
  proto->set_height(image.height);
  if (image.depth_m.empty()) {
    WriteWords(image.depth, proto->mutable_depth());
    proto->set_depth_unit_m(image.depth_unit_m);
  } else {
    proto->set_depth_m(image.depth_m.data(), image.depth_m.size() * sizeof(float));
  }
  proto->set_fx(image.fx);
  proto->set_fy(image.fy);
  proto->set_cx(image.cx);
  proto->set_cy(image.cy);
  const std::vector<std::uint16_t>& mask = image.instance_mask;
  if (std::ranges::all_of(mask, [](std::uint16_t value) { return value <= 0xff; })) {
    proto->mutable_instance_mask()->assign(mask.begin(), mask.end());
  } else {
    WriteWords(mask, proto->mutable_instance_mask());
  }
  proto->mutable_mask_labels()->Add(image.mask_labels.begin(), image.mask_labels.end());
  proto->set_stride(image.stride);
  if (image.max_depth_m) proto->set_max_depth_m(*image.max_depth_m);
}

absl::StatusOr<DepthImage> ReadDepthImage(const v1::DepthImage& proto, std::size_t max_points) {
  FieldReader read("depth_image.");
  DepthImage image = ReadCamera(proto, read);
  if (!read.ok()) return read.status();
  if (auto status = ValidateCamera(image, max_points); !status.ok()) return status;
  CheckBytes(proto, PixelCount(image), read);
  if (!read.ok()) return read.status();
  image.depth = ReadWords(proto.depth());
  image.depth_m = ReadFloats(proto.depth_m());
  const std::string& mask = proto.instance_mask();
  if (mask.size() == PixelCount(image)) {
    image.instance_mask.reserve(mask.size());
    for (const char value : mask) image.instance_mask.push_back(static_cast<unsigned char>(value));
  } else {
    image.instance_mask = ReadWords(mask);
  }
  if (auto status = Validate(image, max_points); !status.ok()) return status;
  return image;
}

}  // namespace clearway
