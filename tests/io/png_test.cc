#include "io/png.h"

#include <gmock/gmock.h>
#include <zlib.h>

#include <algorithm>

#include "io/png_example.h"
#include "support/random.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Png : public testing::Test {
 protected:
  absl::StatusOr<GrayImage> Read(const std::string& bytes) {
    return ReadGrayPng(folder_.Write("image.png", bytes));
  }
  std::string ErrorOf(const std::string& bytes) {
    const absl::Status status = Read(bytes).status();
    EXPECT_TRUE(absl::IsInvalidArgument(status)) << status;
    EXPECT_THAT(std::string(status.message()), HasSubstr("image.png: "));
    return std::string(status.message());
  }

  TemporaryFolder folder_;
};

// A header that says so, and no more of an image.
std::string OnlyHeader(std::uint32_t width, std::uint32_t height) {
  std::string bytes = PngBytes(1, 1, {0}).substr(0, 33);  // up to the end of IHDR
  for (int i = 0; i < 4; ++i) {
    bytes[16 + i] = static_cast<char>(width >> (24 - 8 * i));
    bytes[20 + i] = static_cast<char>(height >> (24 - 8 * i));
  }
  const auto crc = crc32(0, reinterpret_cast<const Bytef*>(bytes.data()) + 12, 17);
  for (int i = 0; i < 4; ++i) bytes[29 + i] = static_cast<char>(crc >> (24 - 8 * i));
  return bytes + PngBytes(1, 1, {0}).substr(33);
}

TEST_F(Png, Empty) {
  EXPECT_TRUE(absl::IsNotFound(ReadGrayPng(folder_ / "none.png").status()));
  EXPECT_THAT(ErrorOf(""), HasSubstr("no PNG image"));
  EXPECT_THAT(ErrorOf("P5 1 1 255 x and some more"), HasSubstr("no PNG image"));
}

TEST_F(Png, ValuesAreAsStored) {
  for (const bool interlaced : {false, true}) {
    const auto deep =
        Read(PngBytes(3, 2, {0, 1, 255, 256, 5000, 65'535}, {.interlaced = interlaced}));
    ASSERT_TRUE(deep.ok()) << deep.status();
    EXPECT_EQ(deep->width, 3u);
    EXPECT_EQ(deep->height, 2u);
    EXPECT_EQ(deep->bits, 16);
    EXPECT_THAT(deep->pixels, ElementsAre(0, 1, 255, 256, 5000, 65'535));
    const auto bytes =
        Read(PngBytes(2, 2, {0, 1, 128, 255}, {.bits = 8, .interlaced = interlaced}));
    ASSERT_TRUE(bytes.ok()) << bytes.status();
    EXPECT_EQ(bytes->bits, 8);
    EXPECT_THAT(bytes->pixels, ElementsAre(0, 1, 128, 255));
  }
}

TEST_F(Png, FewBitsAreNotScaled) {
  const auto bit = Read(PngBytes(5, 1, {0, 1, 0, 1, 1}, {.bits = 1}));
  ASSERT_TRUE(bit.ok()) << bit.status();
  EXPECT_THAT(bit->pixels, ElementsAre(0, 1, 0, 1, 1));
  const auto four = Read(PngBytes(3, 1, {0, 9, 15}, {.bits = 4}));
  ASSERT_TRUE(four.ok()) << four.status();
  EXPECT_THAT(four->pixels, ElementsAre(0, 9, 15));
}

TEST_F(Png, APalettesValuesAreItsIndices) {
  const auto dut =
      Read(PngBytes(3, 1, {0, 3, 200}, {.bits = 8, .color_type = PNG_COLOR_TYPE_PALETTE}));
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_THAT(dut->pixels, ElementsAre(0, 3, 200));
}

TEST_F(Png, OtherKindsAreRefused) {
  EXPECT_THAT(ErrorOf(PngBytes(1, 1, {1, 2, 3}, {.bits = 8, .color_type = PNG_COLOR_TYPE_RGB})),
              HasSubstr("an image of colours, expected a grey one"));
  EXPECT_THAT(ErrorOf(PngBytes(1, 1, {1, 2}, {.bits = 8, .color_type = PNG_COLOR_TYPE_GRAY_ALPHA})),
              HasSubstr("grey with alpha"));
}

TEST_F(Png, SizesAreLimitedBeforeMemoryIsTaken) {
  EXPECT_THAT(ErrorOf(OnlyHeader(65'535, 65'535)), HasSubstr("the limit is 20000000"));
  EXPECT_THAT(ErrorOf(OnlyHeader(65'536, 1)), HasSubstr("no PNG image"));
  EXPECT_THAT(ErrorOf(OnlyHeader(2'147'483'648, 1)), HasSubstr("no PNG image"));
  EXPECT_THAT(ErrorOf(OnlyHeader(0, 1)), HasSubstr("no PNG image"));
  EXPECT_THAT(ErrorOf(OnlyHeader(4'000, 4'000)), HasSubstr("damaged"));
}

TEST_F(Png, EveryCutIsAnError) {
  std::vector<int> values(40 * 30);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<int>(i * i % 65'536);
  const std::string whole = PngBytes(40, 30, values);
  ASSERT_TRUE(Read(whole).ok());
  for (std::size_t size = 0; size < whole.size(); ++size) ErrorOf(whole.substr(0, size));
}

TEST_F(Png, DamageIsAnErrorOrHarmless) {
  std::vector<int> values(20 * 10);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<int>(i * i % 256);
  testing_support::Random random(5);
  for (const PngKind& kind :
       {PngKind{}, PngKind{.bits = 8}, PngKind{.bits = 8, .color_type = PNG_COLOR_TYPE_PALETTE},
        PngKind{.interlaced = true}}) {
    const std::string whole = PngBytes(20, 10, values, kind);
    for (int i = 0; i < 500; ++i) {
      std::string bytes = whole;
      for (int k = random.Integer(1, 4); k > 0; --k) {
        bytes[random.Integer(0, static_cast<int>(bytes.size()) - 1)] ^=
            static_cast<char>(1 << random.Integer(0, 7));
      }
      const auto dut = Read(bytes);
      if (!dut.ok()) continue;
      EXPECT_EQ(dut->pixels.size(), std::size_t{dut->width} * dut->height);
    }
  }
}

}  // namespace
}  // namespace clearway
