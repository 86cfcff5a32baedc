#include "wire/depth_wire.h"

#include <gmock/gmock.h>

#include <functional>
#include <limits>

#include "support/frames.h"
#include "support/random.h"
#include "wire/frame_wire.h"
#include "wire/status.h"

namespace clearway {
namespace {

using ::testing::HasSubstr;
using testing_support::Random;

constexpr std::size_t kAny = 1'000'000;

// An image that has everything: 5 x 4 pixels.
DepthImage FullImage() {
  DepthImage image;
  image.width = 5;
  image.height = 4;
  for (int i = 0; i < 20; ++i) {
    image.depth.push_back(static_cast<std::uint16_t>(0x1203 + 0x111 * i));
    image.instance_mask.push_back(i % 3);
  }
  image.depth_unit_m = 0.0002;
  image.fx = 4;
  image.fy = 5;
  image.cx = 2;
  image.cy = 0;
  image.mask_labels = {0, -1, 70'000};
  image.stride = 2;
  image.max_depth_m = 1.5;
  return image;
}

v1::DepthImage FullProto() {
  v1::DepthImage proto;
  Write(FullImage(), &proto);
  return proto;
}

void ExpectEqual(const DepthImage& a, const DepthImage& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.depth, b.depth);
  EXPECT_EQ(a.depth_unit_m, b.depth_unit_m);
  EXPECT_EQ(a.depth_m, b.depth_m);
  EXPECT_EQ(a.fx, b.fx);
  EXPECT_EQ(a.fy, b.fy);
  EXPECT_EQ(a.cx, b.cx);
  EXPECT_EQ(a.cy, b.cy);
  EXPECT_EQ(a.instance_mask, b.instance_mask);
  EXPECT_EQ(a.mask_labels, b.mask_labels);
  EXPECT_EQ(a.stride, b.stride);
  EXPECT_EQ(a.max_depth_m, b.max_depth_m);
}

TEST(DepthWire, Empty) {
  const auto dut = ReadDepthImage(v1::DepthImage(), kAny);
  EXPECT_TRUE(absl::IsInvalidArgument(dut.status()));
  EXPECT_EQ(FieldOf(dut.status()), "depth_image.depth_unit_m");
}

TEST(DepthWire, ComesBackThroughBytes) {
  v1::DepthImage parsed;
  ASSERT_TRUE(parsed.ParseFromString(FullProto().SerializeAsString()));
  const auto dut = ReadDepthImage(parsed, kAny);
  ASSERT_TRUE(dut.ok()) << dut.status();
  ExpectEqual(*dut, FullImage());
}

// In metres; the last pixels have no measurement.
DepthImage MetreImage() {
  DepthImage image = FullImage();
  image.depth.clear();
  image.depth_unit_m = DepthImage().depth_unit_m;
  for (int i = 0; i < 18; ++i) image.depth_m.push_back(0.1f * static_cast<float>(i));
  image.depth_m.insert(image.depth_m.end(), {-1, std::numeric_limits<float>::infinity()});
  return image;
}

TEST(DepthWire, MetresComeBackThroughBytes) {
  v1::DepthImage proto, parsed;
  Write(MetreImage(), &proto);
  EXPECT_EQ(proto.depth_m().size(), 80u);
  EXPECT_FALSE(proto.has_depth_unit_m());
  EXPECT_TRUE(proto.depth().empty());
  EXPECT_EQ(proto.depth_m().substr(4, 4), std::string("\xcd\xcc\xcc\x3d"));
  ASSERT_TRUE(parsed.ParseFromString(proto.SerializeAsString()));
  const auto dut = ReadDepthImage(parsed, kAny);
  ASSERT_TRUE(dut.ok()) << dut.status();
  ExpectEqual(*dut, MetreImage());
}

TEST(DepthWire, RefusesMetresThatDisagree) {
  v1::DepthImage good;
  Write(MetreImage(), &good);
  const auto field = [&](const std::function<void(v1::DepthImage&)>& spoil) {
    v1::DepthImage proto = good;
    spoil(proto);
    const auto dut = ReadDepthImage(proto, kAny);
    EXPECT_TRUE(absl::IsInvalidArgument(dut.status())) << dut.status();
    return FieldOf(dut.status());
  };
  EXPECT_EQ(field([](auto& i) { i.mutable_depth_m()->pop_back(); }), "depth_image.depth_m");
  EXPECT_EQ(field([](auto& i) { i.set_depth(std::string(40, 1)); }), "depth_image.depth_m");
  EXPECT_EQ(field([](auto& i) { i.set_depth_unit_m(0.001); }), "depth_image.depth_unit_m");
  EXPECT_EQ(field([](auto& i) { i.clear_depth_m(); }), "depth_image.depth_unit_m");
}

TEST(DepthWire, NumbersAreLittleEndian) {
  const v1::DepthImage proto = FullProto();
  EXPECT_EQ(proto.depth().substr(0, 4), std::string("\x03\x12\x14\x13"));
}

TEST(DepthWire, MasksAreAsSmallAsTheyCanBe) {
  EXPECT_EQ(FullProto().instance_mask().size(), 20u);
  DepthImage image = FullImage();
  image.mask_labels.clear();
  image.instance_mask[7] = 0x102;
  v1::DepthImage proto;
  Write(image, &proto);
  EXPECT_EQ(proto.instance_mask().size(), 40u);
  EXPECT_EQ(proto.instance_mask().substr(14, 2), std::string("\x02\x01"));
  const auto dut = ReadDepthImage(proto, kAny);
  ASSERT_TRUE(dut.ok()) << dut.status();
  ExpectEqual(*dut, image);
}

TEST(DepthWire, HighBytesAreNotNegative) {
  v1::DepthImage proto = FullProto();
  proto.clear_mask_labels();
  proto.set_instance_mask(std::string(20, '\xff'));
  proto.set_depth(std::string(40, '\xff'));
  const auto dut = ReadDepthImage(proto, kAny);
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->instance_mask[19], 0xff);
  EXPECT_EQ(dut->depth[19], 0xffff);
}

TEST(DepthWire, WhatMayBeLeftOut) {
  v1::DepthImage proto = FullProto();
  proto.clear_instance_mask();
  proto.clear_mask_labels();
  proto.clear_stride();
  proto.clear_max_depth_m();
  const auto dut = ReadDepthImage(proto, kAny);
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->stride, 1u);
  EXPECT_FALSE(dut->max_depth_m.has_value());
  EXPECT_TRUE(dut->instance_mask.empty());
}

TEST(DepthWire, RefusesNamingTheField) {
  const struct {
    std::function<void(v1::DepthImage&)> spoil;
    const char* message;
  } cases[] = {
      {[](auto& i) { i.clear_depth_unit_m(); }, "depth_image.depth_unit_m: is missing"},
      {[](auto& i) { i.clear_fx(); }, "depth_image.fx: is missing"},
      {[](auto& i) { i.clear_fy(); }, "depth_image.fy: is missing"},
      {[](auto& i) { i.clear_cx(); }, "depth_image.cx: is missing"},
      {[](auto& i) { i.clear_cy(); }, "depth_image.cy: is missing"},
      {[](auto& i) { i.clear_width(); }, "depth_image.width: is 0"},
      {[](auto& i) { i.set_height(70'000); }, "depth_image.height: is 70000"},
      {[](auto& i) { i.set_fx(0); }, "depth_image.fx: is 0; it must be above 0"},
      {[](auto& i) { i.set_cy(std::numeric_limits<double>::quiet_NaN()); },
       "depth_image.cy: is not finite"},
      {[](auto& i) { i.set_max_depth_m(-1); }, "depth_image.max_depth_m: is -1"},
      {[](auto& i) { i.set_depth("0123456789"); },
       "depth_image.depth: has 10 bytes; 5 x 4 pixels need 40"},
      {[](auto& i) { i.clear_depth(); }, "depth_image.depth: has 0 bytes"},
      {[](auto& i) { i.set_instance_mask(std::string(21, 0)); },
       "depth_image.instance_mask: has 21 bytes; 5 x 4 pixels need 20 or 40, or none"},
      {[](auto& i) { i.clear_instance_mask(); }, "depth_image.mask_labels: there is no"},
      {[](auto& i) { i.set_mask_labels(2, -9); }, "depth_image.mask_labels[2]: is -9"},
      {[](auto& i) { i.mutable_mask_labels()->RemoveLast(); },
       "depth_image.instance_mask: the pixel in column 2, row 0 is 2"},
  };
  for (const auto& bad : cases) {
    v1::DepthImage proto = FullProto();
    bad.spoil(proto);
    const absl::Status dut = ReadDepthImage(proto, kAny).status();
    EXPECT_TRUE(absl::IsInvalidArgument(dut)) << dut;
    EXPECT_THAT(std::string(dut.message()), HasSubstr(bad.message));
  }
  v1::DepthImage proto = FullProto();
  proto.mutable_mask_labels()->Resize(65'537, 0);
  EXPECT_TRUE(absl::IsResourceExhausted(ReadDepthImage(proto, kAny).status()));
  // 5 x 4 pixels, every second column and row.
  EXPECT_TRUE(ReadDepthImage(FullProto(), 6).ok());
  EXPECT_TRUE(absl::IsResourceExhausted(ReadDepthImage(FullProto(), 5).status()));
}

// Sizes and byte fields that have nothing to do with each other, some of them absurd.
TEST(DepthWire, AnySizesAreAnErrorOrAnImage) {
  Random random(11);
  const std::uint32_t sides[] = {0, 1, 1, 2, 2, 3, 255, 65'535, 65'536, 4'294'967'295};
  const auto side = [&] { return sides[random.Integer(0, 9)]; };
  int good = 0;
  for (int i = 0; i < 20'000; ++i) {
    v1::DepthImage proto = FullProto();
    proto.set_width(side());
    proto.set_height(side());
    proto.set_stride(side());
    proto.set_depth(std::string(random.Integer(0, 12), 'd'));
    proto.set_instance_mask(std::string(random.Integer(0, 12), 'm'));
    if (random.Integer(0, 1) == 1) proto.clear_mask_labels();
    const auto dut = ReadDepthImage(proto, kAny);
    if (!dut.ok()) {
      EXPECT_TRUE(FieldOf(dut.status()).starts_with("depth_image")) << dut.status();
      continue;
    }
    ++good;
    EXPECT_EQ(2 * PixelCount(*dut), proto.depth().size());
    Frame frame;
    SetPoints(*dut, frame);
    EXPECT_EQ(frame.points_S.size(), frame.labels.size());
  }
  EXPECT_GT(good, 20);
}

TEST(DepthWire, AFramesImageBecomesItsPoints) {
  Frame frame = testing_support::FrameAt(3);
  v1::Frame proto;
  Write(frame, FullImage(), &proto);
  const auto dut = ReadFrame("frame", proto, FrameLimits{});
  ASSERT_TRUE(dut.ok()) << dut.status();
  SetPoints(FullImage(), frame);
  EXPECT_GT(frame.points_S.size(), 3u);
  EXPECT_EQ(dut->points_S, frame.points_S);
  EXPECT_EQ(dut->labels, frame.labels);
  EXPECT_TRUE(dut->no_return.empty() && dut->origins_S.empty());
}

TEST(DepthWire, AFrameHasPointsOrAnImage) {
  const std::function<void(v1::Frame&)> additions[] = {
      [](auto& f) { f.mutable_points_m()->Resize(3, 1); }, [](auto& f) { f.add_labels(0); },
      [](auto& f) { f.set_no_return("x"); }, [](auto& f) { f.mutable_origins_m()->Resize(3, 0); }};
  for (const auto& add : additions) {
    v1::Frame proto;
    Write(testing_support::FrameAt(3), FullImage(), &proto);
    add(proto);
    const absl::Status dut = ReadFrame("frame", proto, FrameLimits{}).status();
    EXPECT_TRUE(absl::IsInvalidArgument(dut)) << dut;
    EXPECT_EQ(FieldOf(dut), "frame.depth_image") << dut;
  }
}

}  // namespace
}  // namespace clearway
