#include <cstring>
#include <limits>

#include "io/octomap_example.h"

namespace clearway {
namespace {

// A few bytes that say that 2^18 blocks are free.
TEST(OctomapFile, ReadingEndsSoonAfterItIsCancelled) {
  std::string bytes = "# Octomap OcTree binary file\nid OcTree\nsize 8\nres 0.1\ndata\n";
  for (int depth = 0; depth < 6; ++depth) bytes += std::string("\x03\x00", 2);
  bytes += std::string("\x01\x00", 2);
  int asked = 0;
  const auto dut = ParseOctomap("m.bt", bytes, {}, {}, [&] { return ++asked == 3; });
  EXPECT_TRUE(absl::IsCancelled(dut.status())) << dut.status();
  EXPECT_EQ(asked, 3);
}

using ::testing::HasSubstr;

TEST(OctomapFile, RefusesVoxelsThatOctomapCannotAddress) {
  VoxelMap map(0.1);
  map.Set({32767, -32768, 0}, 100);
  EXPECT_TRUE(SerializeOctomap(map, OctomapFormat::kFull).ok());
  map.Set({0, 32768, 0}, 100);
  const auto bytes = SerializeOctomap(map, OctomapFormat::kFull);
  EXPECT_EQ(bytes.status().code(), absl::StatusCode::kOutOfRange);
  EXPECT_THAT(std::string(bytes.status().message()),
              AllOf(HasSubstr("32768"), HasSubstr("-32768 to 32767"), HasSubstr("3276.8 m")));
}

TEST(OctomapFile, RefusesFilesCutOffAtAnyByte) {
  VoxelMap map(0.1);
  for (int i = 0; i < 40; ++i) map.Set({i, i * i % 7, i / 3}, static_cast<LogOdds>(100 * i - 900));
  for (const OctomapFormat format : {OctomapFormat::kBinary, OctomapFormat::kFull}) {
    const std::string whole = Serialized(map, format);
    ASSERT_TRUE(ParseOctomap("m", whole).ok());
    for (std::size_t size = 0; size < whole.size(); ++size) {
      const auto dut = ParseOctomap("m", whole.substr(0, size));
      EXPECT_EQ(dut.status().code(), absl::StatusCode::kInvalidArgument) << size;
    }
    EXPECT_THAT(ErrorOf(whole + "x"), HasSubstr("1 bytes follow the end of the tree"));
  }
}

TEST(OctomapFile, SurvivesAnyDamagedByte) {
  OctomapLimits limits;
  limits.max_voxels = 1 << 24;  // a damaged bit can make a leaf of half the world
  const std::string whole = Serialized(ExampleMap(), OctomapFormat::kFull);
  std::mt19937 random(5);
  for (int i = 0; i < 300; ++i) {
    std::string damaged = whole;
    damaged[random() % (i % 2 == 0 ? 200 : whole.size())] ^= static_cast<char>(1 << random() % 8);
    const auto dut = ParseOctomap("m", damaged, {}, limits);
    EXPECT_TRUE(dut.ok() || !dut.status().message().empty());
  }
}

TEST(OctomapFile, RefusesBadHeadersNamingTheLine) {
  EXPECT_THAT(ErrorOf("ply\nformat ascii 1.0\n"), HasSubstr("m.bt, line 1: does not start with"));
  EXPECT_THAT(ErrorOf("# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n"),
              HasSubstr("no OctoMap file; the file is a point cloud (PCD)"));
  EXPECT_THAT(ErrorOf("\x89PNG\r\n\x1a\n"), HasSubstr("the file is a PNG image"));
  EXPECT_THAT(ErrorOf("# Octomap OcTree binary file\nid Tree\nsize 1\nres 1\ndata\n"),
              HasSubstr("line 5: id is none of"));
  EXPECT_THAT(ErrorOf("# Octomap OcTree binary file\nid OcTree\nsize x\nres 1\ndata\n"),
              HasSubstr("line 3: size"));
  EXPECT_THAT(ErrorOf("# Octomap OcTree binary file\nid OcTree\nres 1\ndata\n"),
              HasSubstr("no size"));
  EXPECT_THAT(ErrorOf("# Octomap OcTree binary file\nid OcTree\nsize 1\nres -1\ndata\n"),
              HasSubstr("line 4: res: '-1' is not a finite number above 0"));
  const std::string begin = "# Octomap OcTree binary file\nid OcTree\nsize 1\n";
  for (const std::string res : {"nan", "inf", "0", "1e-400", "wide"}) {
    EXPECT_THAT(ErrorOf(begin + "res " + res + "\ndata\n"),
                HasSubstr("line 4: res: '" + res + "' is not a finite number above 0"));
  }
  EXPECT_THAT(ErrorOf(begin + "data\n"), HasSubstr("no res before data"));
  EXPECT_THAT(ErrorOf(begin + "res 1\nres 2\ndata\n"),
              HasSubstr("line 5: a second res, '2'; the first is '1'"));
  EXPECT_THAT(ErrorOf("\xEF\xBB\xBF" + begin), HasSubstr("line 1: begins with a UTF-8 byte order"));
  EXPECT_THAT(ErrorOf("# Octomap OcTree binary file\nid OcTree\nsize 1\nres 1\n"),
              HasSubstr("the header ends before its word \"data\""));
}

TEST(OctomapFile, RefusesTreesThatOctomapWouldReadBeyondBounds) {
  EXPECT_THAT(ErrorOf(kHeader + std::string(100000, '\xff')),
              HasSubstr("nodes nest deeper than 16 levels"));
  EXPECT_THAT(ErrorOf(kHeader + std::string(2, '\0')), HasSubstr("an inner node without children"));
  std::string full = "# Octomap OcTree file\nid OcTree\nsize 1\nres 0.1\ndata\n";
  const float nan = std::numeric_limits<float>::quiet_NaN();
  full.append(reinterpret_cast<const char*>(&nan), 4).push_back('\0');
  EXPECT_THAT(ErrorOf(full), HasSubstr("log-odds that are not a number"));
}

TEST(OctomapFile, RefusesAWrongNumberOfNodes) {
  VoxelMap map(0.1);
  map.Set({0, 0, 0}, 0);
  std::string bytes = Serialized(map, OctomapFormat::kBinary);
  ASSERT_THAT(bytes, HasSubstr("size 17\n"));
  bytes.replace(bytes.find("size 17"), 7, "size 18");
  EXPECT_THAT(ErrorOf(bytes), HasSubstr("17 nodes; the header says 18"));
}

TEST(OctomapFile, RefusesATreeThatExpandsBeyondTheLimit) {
  const std::string bytes = kHeader + std::string("\x01\x00", 2);  // an eighth of all space
  const auto dut = ParseOctomap("m.bt", bytes);
  EXPECT_EQ(dut.status().code(), absl::StatusCode::kResourceExhausted);
  EXPECT_THAT(std::string(dut.status().message()),
              HasSubstr("more than 1048576 blocks of 8 x 8 x 8 voxels"));
}

}  // namespace
}  // namespace clearway
