#include "io/ply_vertices.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

#include "absl/strings/str_cat.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr char kHeader[] =
    "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 2\n"
    "property float y\nproperty uchar red\nproperty float32 x\nproperty uint32 id\nend_header\n";
constexpr PlyProperty kXId[] = {{"x"}, {"id", /*is_index=*/true}};

class PlyVertices : public testing::Test {
 protected:
  absl::StatusOr<std::vector<double>> Read(const std::string& bytes) {
    return ReadPlyVertices(folder_.Write("cloud.ply", bytes), kXId);
  }
  std::string ErrorOf(const std::string& bytes) {
    const auto read = Read(bytes);
    EXPECT_TRUE(absl::IsInvalidArgument(read.status())) << read.status();
    EXPECT_THAT(std::string(read.status().message()), HasSubstr("cloud.ply"));
    return std::string(read.status().message());
  }

  TemporaryFolder folder_;
};

TEST_F(PlyVertices, Empty) {
  const auto dut = Read(
      "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty int id\nend_header\n");
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_THAT(*dut, IsEmpty());
}

TEST_F(PlyVertices, TakesPropertiesByName) {
  const auto dut = Read(absl::StrCat(kHeader, "1 255 -2.5 4294967295\n3e0 0  4.0001\t0 \n"));
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_THAT(*dut, ElementsAre(-2.5, 4294967295., 4.0001, 0));
}

TEST_F(PlyVertices, RefusesHeadersThatSayAThingTwice) {
  const std::string header = kHeader;
  const auto with = [&](const std::string& line, const std::string& before) {
    std::string bytes = header;
    return bytes.insert(bytes.find(before), line);
  };
  EXPECT_THAT(ErrorOf(with("format binary_little_endian 1.0\n", "comment")),
              HasSubstr("line 3: a second format"));
  EXPECT_THAT(ErrorOf(with("property float x\n", "end_header")), HasSubstr("has property x twice"));
}

// The header's two vertices as in TakesPropertiesByName.
std::string Binary(bool big_endian) {
  std::string bytes = kHeader;
  bytes.replace(bytes.find("ascii"), 5, big_endian ? "binary_big_endian" : "binary_little_endian");
  const auto put = [&](const auto value) {
    std::string part(reinterpret_cast<const char*>(&value), sizeof value);
    if (big_endian) std::reverse(part.begin(), part.end());
    bytes += part;
  };
  put(1.0f);
  put(std::uint8_t{255});
  put(-2.5f);
  put(std::uint32_t{4294967295});
  put(3.0f);
  put(std::uint8_t{0});
  put(4.5f);
  put(std::uint32_t{0});
  return bytes;
}

TEST_F(PlyVertices, TakesBinaryOnes) {
  for (const bool big_endian : {false, true}) {
    const auto dut = Read(Binary(big_endian));
    ASSERT_TRUE(dut.ok()) << dut.status();
    EXPECT_THAT(*dut, ElementsAre(-2.5, 4294967295., 4.5, 0));
  }
}

TEST_F(PlyVertices, RefusesBinaryOnesThatAreCutOff) {
  const std::string whole = Binary(false);
  for (std::size_t end = 0; end < whole.size(); ++end) {
    EXPECT_FALSE(Read(whole.substr(0, end)).ok()) << end;
  }
  EXPECT_THAT(ErrorOf(whole.substr(0, whole.size() - 1)),
              HasSubstr("25 bytes are left for 2 vertices of 13; the file is cut off"));
  EXPECT_THAT(ErrorOf(whole + "x"), HasSubstr("1 bytes follow the last of 2"));
  std::string nan = whole;
  nan.replace(whole.size() - 8, 4, "\xff\xff\xff\x7f");
  EXPECT_THAT(ErrorOf(nan), HasSubstr("vertex 1, property x: nan is not a finite number"));
}

TEST_F(PlyVertices, TakesNumbersThatAreNoneWhereAskedFor) {
  constexpr PlyProperty kAny[] = {{"x", false, /*may_be_nan=*/true}};
  std::vector<std::string> names;
  const auto dut = ReadPlyVertices(
      folder_.Write("cloud.ply", absl::StrCat(kHeader, "1 2 nan 4\n1 2 -inf 4\n")), kAny, &names);
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_TRUE(std::isnan((*dut)[0]));
  EXPECT_TRUE(std::isinf((*dut)[1]));
  EXPECT_THAT(names, ElementsAre("y", "red", "x", "id"));
}

TEST_F(PlyVertices, Refusals) {
  EXPECT_TRUE(absl::IsNotFound(ReadPlyVertices(folder_ / "none.ply", kXId).status()));
  const std::string header = kHeader;
  EXPECT_THAT(ErrorOf(""), EndsWith(".ply: the file is empty"));
  EXPECT_THAT(ErrorOf("\n"), HasSubstr("line 1: no PLY file"));
  EXPECT_THAT(ErrorOf("ply"), HasSubstr("its first line does not end; the file is cut off"));
  EXPECT_THAT(ErrorOf("plywood\n"), HasSubstr("line 1: no PLY file"));
  EXPECT_THAT(ErrorOf("ply\nformat binary_middle_endian 1.0\n"),
              HasSubstr("line 2: format binary_middle_endian; ascii, binary_little_endian and"));
  EXPECT_THAT(ErrorOf("ply\nelement vertex 0\nproperty float x\nproperty int id\nend_header\n"),
              HasSubstr("no line 'format ascii 1.0'"));
  EXPECT_THAT(ErrorOf("ply\nformat ascii 1.0\nproperty float x\n"), HasSubstr("of no element"));
  EXPECT_THAT(ErrorOf("ply\nformat ascii 1.0\nelement face 3\n"),
              HasSubstr("line 3: expected one"));
  EXPECT_THAT(ErrorOf("ply\nformat ascii 1.0\nelement vertex -3\n"), HasSubstr("'-3' is not a"));
  EXPECT_THAT(ErrorOf("ply\nformat ascii 1.0\nelement vertex 1\nproperty list uchar int id\n"),
              HasSubstr("line 4: expected a property that is one number, not 'list'"));
  EXPECT_THAT(ErrorOf("ply\nformat ascii 1.0\nend_header\n"), HasSubstr("no element vertex"));
  EXPECT_THAT(ErrorOf("ply\nformat ascii 1.0\nwhat is this\n"), HasSubstr("'what' in the header"));
  EXPECT_THAT(ErrorOf("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n"),
              HasSubstr("line 5: the header ends without a property id; it has x"));
  EXPECT_THAT(ErrorOf(header.substr(0, 40)), HasSubstr("the header does not end"));
  EXPECT_THAT(ErrorOf(header + "1 2 3 4\n1 2 3\n"),
              HasSubstr("line 11: 3 numbers; the header has"));
  EXPECT_THAT(ErrorOf(header + "1 2 x 4\n1 2 3 4\n"),
              HasSubstr("line 10: property x: 'x' is not a finite number"));
  EXPECT_THAT(ErrorOf(header + "1 2 nan 4\n1 2 3 4\n"), HasSubstr("'nan'"));
  EXPECT_THAT(ErrorOf(header + "1 2 3 4.5\n1 2 3 4\n"), HasSubstr("property id: '4.5' is not an"));
  EXPECT_THAT(ErrorOf(header + "1 2 3 4\n1 2 3 4"), HasSubstr("it has 1 of 2 vertices"));
  EXPECT_THAT(ErrorOf(header + "1 2 3 4\n1 2 3 4\n5"), HasSubstr("1 bytes follow the last of 2"));
}

TEST_F(PlyVertices, APromiseTakesNoMemory) {
  std::string bytes = kHeader;
  bytes.replace(bytes.find("vertex 2"), 8, "vertex 20000000");
  EXPECT_THAT(ErrorOf(bytes + "1 2 3 4\n"), HasSubstr("8 bytes are left for 20000000 vertices"));
  bytes.replace(bytes.find("20000000"), 8, "20000001");
  EXPECT_TRUE(absl::IsResourceExhausted(Read(bytes).status()));
}

TEST_F(PlyVertices, GarbageIsAnError) {
  std::mt19937 random(7);
  const std::string whole = absl::StrCat(kHeader, "1 255 -2.5 42\n3e0 0 4.0001 0\n");
  for (std::size_t end = 0; end < whole.size(); ++end) {
    EXPECT_FALSE(Read(whole.substr(0, end)).ok()) << end;
  }
  for (int i = 0; i < 500; ++i) {
    std::string damaged = whole;
    for (int k = 0; k < 3; ++k) damaged[random() % damaged.size()] = static_cast<char>(random());
    const auto read = Read(damaged);
    EXPECT_TRUE(!read.ok() || read->size() == 4);
  }
}

}  // namespace
}  // namespace clearway
