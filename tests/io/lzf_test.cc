#include "io/lzf.h"

#include <gtest/gtest.h>

#include <random>

#include "io/pcd_example.h"

namespace clearway {
namespace {

TEST(Lzf, Empty) { EXPECT_EQ(UnpackLzf("", 0), ""); }

TEST(Lzf, Literals) {
  EXPECT_EQ(UnpackLzf(std::string("\x02") + "abc", 3), "abc");
  const std::string text(100, 'x');
  EXPECT_EQ(UnpackLzf(LiteralLzf(text), 100), text);
}

// Control bytes by hand: a repetition of length (upper 3 bits + 2) from back (lower bits, byte)
// + 1.
TEST(Lzf, Repetitions) {
  EXPECT_EQ(UnpackLzf(std::string("\x02") + "abc" + "\x20" + std::string(1, '\x02'), 6), "abcabc");
  // Into itself: one byte back, 5 times.
  EXPECT_EQ(UnpackLzf(std::string("\x00"
                                  "a"
                                  "\x60"
                                  "\x00",
                                  4),
                      6),
            "aaaaaa");
  // Long: 7 + 2 + next byte.
  EXPECT_EQ(UnpackLzf(std::string("\x00"
                                  "a"
                                  "\xe0"
                                  "\xff"
                                  "\x00",
                                  5),
                      265),
            std::string(265, 'a'));
}

// What liblzf 3.6 makes of "The quick brown fox. The quick brown dog." and sixty zeros.
TEST(Lzf, AsItsOwnLibraryPacks) {
  const unsigned char packed[] = {0x15, 0x54, 0x68, 0x65, 0x20, 0x71, 0x75, 0x69, 0x63, 0x6b,
                                  0x20, 0x62, 0x72, 0x6f, 0x77, 0x6e, 0x20, 0x66, 0x6f, 0x78,
                                  0x2e, 0x20, 0x54, 0xe0, 0x06, 0x14, 0x04, 0x64, 0x6f, 0x67,
                                  0x2e, 0x00, 0xe0, 0x30, 0x00, 0x01, 0x00, 0x00};
  const auto dut =
      UnpackLzf(std::string_view(reinterpret_cast<const char*>(packed), sizeof packed), 41 + 60);
  ASSERT_TRUE(dut.has_value());
  EXPECT_EQ(*dut, "The quick brown fox. The quick brown dog." + std::string(60, '\0'));
}

TEST(Lzf, RefusesWhatIsDamaged) {
  EXPECT_FALSE(UnpackLzf("", 1));
  EXPECT_FALSE(UnpackLzf(std::string("\x02") + "ab", 3));   // a literal is missing
  EXPECT_FALSE(UnpackLzf(std::string("\x02") + "abc", 2));  // more than there should be
  EXPECT_FALSE(UnpackLzf(std::string("\x02") + "abc", 4));  // less
  EXPECT_FALSE(UnpackLzf(std::string("\x00"
                                     "a"
                                     "\x20"
                                     "\x01",
                                     4),
                         4));  // from before the begin
  EXPECT_FALSE(UnpackLzf(std::string("\x00"
                                     "a"
                                     "\x20",
                                     3),
                         4));  // no second byte
  EXPECT_FALSE(UnpackLzf(std::string("\x00"
                                     "a"
                                     "\xe0"
                                     "\x01",
                                     4),
                         11));                           // no third
  EXPECT_FALSE(UnpackLzf("abc", std::size_t{1} << 32));  // takes no memory
}

TEST(Lzf, GarbageIsAnErrorOrBytes) {
  std::mt19937 random(3);
  for (int i = 0; i < 2000; ++i) {
    std::string packed(random() % 40, '\0');
    for (char& c : packed) c = static_cast<char>(random());
    const auto dut = UnpackLzf(packed, random() % 100);
    EXPECT_TRUE(!dut || dut->size() < 100);
  }
}

}  // namespace
}  // namespace clearway
