#include "clearway/scene/depth_image.h"

#include <gmock/gmock.h>

#include <Eigen/LU>
#include <functional>
#include <limits>

#include "support/random.h"

namespace clearway {
namespace {

using ::testing::HasSubstr;
using testing_support::Random;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kAny = 1'000'000;

// 4 x 3 pixels, 12 depths of 1 m and on.
DepthImage Small() {
  DepthImage image;
  image.width = 4;
  image.height = 3;
  for (std::uint16_t i = 0; i < 12; ++i) image.depth.push_back(1000 + i);
  image.fx = image.fy = 2;
  image.cx = 1.5;
  image.cy = 1;
  return image;
}

DepthImage AnyImage(Random& random) {
  DepthImage image;
  image.width = random.Integer(1, 40);
  image.height = random.Integer(1, 40);
  image.depth_unit_m = random.Uniform(1e-4, 1e-2);
  image.fx = random.Uniform(1, 600);
  image.fy = random.Uniform(1, 600);
  image.cx = random.Uniform(-5, 45);
  image.cy = random.Uniform(-5, 45);
  image.stride = random.Integer(1, 7);
  const bool masked = random.Integer(0, 1) == 1;
  for (std::uint32_t i = 0; i < image.width * image.height; ++i) {
    image.depth.push_back(random.Integer(0, 3) == 0 ? 0 : random.Integer(1, 65'535));
    if (masked) image.instance_mask.push_back(random.Integer(0, 4));
  }
  if (masked && random.Integer(0, 1) == 1) image.mask_labels = {0, 70'000, kIgnoreLabel, 3, 3};
  if (random.Integer(0, 1) == 1) image.max_depth_m = random.Uniform(1, 65'535 * image.depth_unit_m);
  return image;
}

// Every pixel by the camera's matrix.
void ExpectPointsOf(const DepthImage& image, const Frame& frame) {
  Eigen::Matrix3d K;
  K << image.fx, 0, image.cx, 0, image.fy, image.cy, 0, 0, 1;
  std::size_t count = 0;
  for (std::uint32_t v = 0; v < image.height; ++v) {
    for (std::uint32_t u = 0; u < image.width; ++u) {
      const std::size_t pixel = v * image.width + u;
      const double z_m = image.depth[pixel] * image.depth_unit_m;
      if (u % image.stride != 0 || v % image.stride != 0 || image.depth[pixel] == 0) continue;
      if (image.max_depth_m && z_m > *image.max_depth_m) continue;
      ASSERT_LT(count, frame.points_S.size());
      const Eigen::Vector3d p_S = z_m * (K.inverse() * Eigen::Vector3d(u, v, 1));
      EXPECT_LE((frame.points_S[count].cast<double>() - p_S).norm(), 1e-6 * p_S.norm());
      int label = image.instance_mask.empty() ? 0 : image.instance_mask[pixel];
      if (!image.mask_labels.empty()) label = image.mask_labels[label];
      EXPECT_EQ(frame.labels[count], label);
      ++count;
    }
  }
  EXPECT_EQ(frame.points_S.size(), count);
  EXPECT_EQ(frame.labels.size(), count);
}

TEST(DepthImage, Empty) {
  EXPECT_TRUE(absl::IsInvalidArgument(Validate(DepthImage{}, kAny)));
  DepthImage dut = Small();
  dut.depth.assign(12, 0);
  ASSERT_TRUE(Validate(dut, kAny).ok());
  Frame frame;
  SetPoints(dut, frame);
  EXPECT_TRUE(frame.points_S.empty() && frame.labels.empty());
}

TEST(DepthImage, APixelIsAPointOfTheOpticalFrame) {
  DepthImage dut = Small();
  dut.depth.assign(12, 0);
  dut.depth[1 * 4 + 3] = 2500;  // column 3, row 1
  dut.depth[2 * 4 + 0] = 2000;  // column 0, row 2
  Frame frame;
  SetPoints(dut, frame);
  const std::vector<Eigen::Vector3f> expected = {{1.875F, 0, 2.5F}, {-1.5F, 1, 2}};
  EXPECT_EQ(frame.points_S, expected);
  EXPECT_EQ(frame.labels, (std::vector<ObjectId>{0, 0}));
}

TEST(DepthImage, DepthsInMetres) {
  constexpr float kNanF = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinityF = std::numeric_limits<float>::infinity();
  DepthImage dut = Small();
  dut.depth.clear();
  // Column 3, row 1 and column 0, row 2 are measurements.
  dut.depth_m = {0, -1, kNanF, kInfinityF, -kInfinityF, -0.0f, 0, 2.5f, 2.0f, 9, 9.5f, kNanF};
  dut.max_depth_m = 8;
  ASSERT_TRUE(Validate(dut, kAny).ok()) << Validate(dut, kAny);
  Frame frame;
  SetPoints(dut, frame);
  const std::vector<Eigen::Vector3f> expected = {{1.875F, 0, 2.5F}, {-1.5F, 1, 2}};
  EXPECT_EQ(frame.points_S, expected);
}

TEST(DepthImage, DepthsInMetresAreThoseInCounts) {
  Random random(4);
  for (int i = 0; i < 100; ++i) {
    DepthImage counts = AnyImage(random);
    counts.depth_unit_m = 1.0 / 1024;  // exact in single precision
    DepthImage dut = counts;
    dut.depth.clear();
    for (const std::uint16_t depth : counts.depth) dut.depth_m.push_back(depth / 1024.0f);
    ASSERT_TRUE(Validate(dut, kAny).ok());
    Frame frame, expected;
    SetPoints(dut, frame);
    SetPoints(counts, expected);
    EXPECT_EQ(frame.points_S, expected.points_S);
    EXPECT_EQ(frame.labels, expected.labels);
  }
}

TEST(DepthImage, MasksSayWhatPixelsBelongTo) {
  DepthImage dut = Small();
  dut.instance_mask = {0, 0, 1, 2, 0, 0, 1, 2, 0, 0, 0, 65'535};
  Frame frame;
  SetPoints(dut, frame);
  EXPECT_EQ(frame.labels, (std::vector<ObjectId>{0, 0, 1, 2, 0, 0, 1, 2, 0, 0, 0, 65'535}));
  dut.instance_mask[11] = 2;
  dut.mask_labels = {0, 90'000, kIgnoreLabel};
  ASSERT_TRUE(Validate(dut, kAny).ok());
  SetPoints(dut, frame);
  EXPECT_EQ(frame.labels, (std::vector<ObjectId>{0, 0, 90'000, -1, 0, 0, 90'000, -1, 0, 0, 0, -1}));
}

TEST(DepthImage, WhatAFrameHadIsGone) {
  Frame frame;
  frame.points_S = {{1, 2, 3}};
  frame.labels = {7};
  frame.no_return = {1};
  frame.origins_S = {{0, 0, 1}};
  SetPoints(Small(), frame);
  EXPECT_EQ(frame.points_S.size(), 12u);
  EXPECT_TRUE(Validate(frame, FrameLimits{}).ok());
}

TEST(DepthImage, PointsAreThoseOfBruteForce) {
  Random random(3);
  for (int i = 0; i < 300; ++i) {
    const DepthImage dut = AnyImage(random);
    ASSERT_TRUE(Validate(dut, kAny).ok()) << Validate(dut, kAny);
    Frame frame;
    SetPoints(dut, frame);
    ExpectPointsOf(dut, frame);
    EXPECT_LE(frame.points_S.size(), UsedPixelCount(dut));
    EXPECT_TRUE(Validate(dut, UsedPixelCount(dut)).ok());
    EXPECT_TRUE(absl::IsResourceExhausted(Validate(dut, UsedPixelCount(dut) - 1)));
  }
}

TEST(DepthImage, StridesBeyondTheImageLeaveItsFirstPixel) {
  for (const std::uint32_t stride : {4u, 4'294'967'295u}) {
    DepthImage dut = Small();
    dut.stride = stride;
    EXPECT_EQ(UsedPixelCount(dut), 1u);
    Frame frame;
    SetPoints(dut, frame);
    EXPECT_EQ(frame.points_S.size(), 1u);
  }
}

TEST(DepthImage, RefusesNamingTheField) {
  const struct {
    std::function<void(DepthImage&)> spoil;
    const char* message;
  } cases[] = {
      {[](auto& i) { i.width = 0; }, "depth_image.width: is 0; it must be from 1 to 65535"},
      {[](auto& i) { i.height = 65'536; }, "depth_image.height: is 65536"},
      {[](auto& i) { i.stride = 0; }, "depth_image.stride: is 0"},
      {[](auto& i) { i.depth_unit_m = 0; }, "depth_image.depth_unit_m: is 0; it must be above 0"},
      {[](auto& i) { i.depth_unit_m = kNan; }, "depth_image.depth_unit_m: is not finite"},
      {[](auto& i) { i.fx = -1; }, "depth_image.fx: is -1"},
      {[](auto& i) { i.fy = kInfinity; }, "depth_image.fy: is not finite"},
      {[](auto& i) { i.cx = kNan; }, "depth_image.cx: is not finite"},
      {[](auto& i) { i.cy = -kInfinity; }, "depth_image.cy: is not finite"},
      {[](auto& i) { i.max_depth_m = 0; }, "depth_image.max_depth_m: is 0"},
      {[](auto& i) { i.max_depth_m = kInfinity; }, "depth_image.max_depth_m: is not finite"},
      {[](auto& i) { i.depth.pop_back(); },
       "depth_image.depth: has 11 entries; 4 x 3 pixels need 12"},
      {[](auto& i) { i.instance_mask.resize(13); }, "depth_image.instance_mask: has 13 entries"},
      {[](auto& i) { i.mask_labels = {0}; }, "depth_image.mask_labels: there is no"},
      {[](auto& i) {
         i.instance_mask.resize(12);
         i.mask_labels = {0, -2};
       },
       "depth_image.mask_labels[1]: is -2"},
      {[](auto& i) {
         i.instance_mask.resize(12);
         i.instance_mask[6] = i.instance_mask[9] = 2;
         i.mask_labels = {0, 1};
       },
       "depth_image.instance_mask: the pixel in column 2, row 1 is 2; mask_labels has 2 entries"},
  };
  ASSERT_TRUE(Validate(Small(), kAny).ok());
  for (const auto& bad : cases) {
    DepthImage dut = Small();
    bad.spoil(dut);
    const absl::Status status = Validate(dut, kAny);
    EXPECT_TRUE(absl::IsInvalidArgument(status)) << status;
    EXPECT_THAT(std::string(status.message()), HasSubstr(bad.message));
  }
  DepthImage dut = Small();
  dut.instance_mask.resize(12);
  dut.mask_labels.resize(65'537);
  EXPECT_TRUE(absl::IsResourceExhausted(Validate(dut, kAny))) << Validate(dut, kAny);
}

TEST(DepthImage, SizesDoNotOverflow) {
  DepthImage dut = Small();
  dut.stride = 0;
  EXPECT_EQ(UsedPixelCount(dut), 0u);
  dut.stride = 1;
  dut.width = dut.height = 65'535;
  const absl::Status status = ValidateCamera(dut, kAny);
  EXPECT_TRUE(absl::IsResourceExhausted(status)) << status;
  EXPECT_THAT(std::string(status.message()), HasSubstr("4294836225"));
  dut.width = dut.height = 4'294'967'295;
  EXPECT_TRUE(absl::IsInvalidArgument(ValidateCamera(dut, kAny)));
}

}  // namespace
}  // namespace clearway
