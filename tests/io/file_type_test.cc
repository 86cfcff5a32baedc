#include "clearway/io/file_type.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace clearway {
namespace {

using namespace std::literals;

TEST(FileType, FilesAreKnownByTheirFirstBytes) {
  const struct {
    std::string_view bytes;
    FileType type;
    const char* name;
  } cases[] = {
      {"SQLite format 3\0..."sv, FileType::kSqlite, "an SQLite database"},
      {"# Octomap OcTree binary file\nid OcTree"sv, FileType::kOctomapBt, "an OctoMap file (.bt)"},
      {"# Octomap OcTree file\n"sv, FileType::kOctomapOt, "an OctoMap file (.ot)"},
      {"# .PCD v0.7 - Point Cloud\n"sv, FileType::kOther, "a point cloud (PCD)"},
      {"# written by hand\nVERSION 0.7\nFIELDS x y z\n"sv, FileType::kOther, "a point cloud (PCD)"},
      {"\xEF\xBB\xBF# .PCD v0.7\n"sv, FileType::kOther, "a point cloud (PCD)"},
      {"\xEF\xBB\xBF# Octomap OcTree file\n"sv, FileType::kOctomapOt, "an OctoMap file (.ot)"},
      {"\xEF\xBB\xBFx,y\n"sv, FileType::kText, "a text"},
      {"ply\nformat ascii 1.0\n"sv, FileType::kOther, "a point cloud or mesh (PLY)"},
      {"#ROSBAG V2.0\n"sv, FileType::kOther, "a ROS 1 bag"},
      {"\x89MCAP0\r\n"sv, FileType::kOther, "an MCAP file (a ROS 2 bag)"},
      {"\x1F\x8B\x08"sv, FileType::kOther, "compressed by gzip"},
      {"\x28\xB5\x2F\xFD\x04"sv, FileType::kOther, "compressed by zstd"},
      {"PK\x03\x04\x14"sv, FileType::kOther, "a zip archive"},
      {""sv, FileType::kOther, "empty"},
      {"\xFF\xFE{\0"sv, FileType::kText, "a text in UTF-16"},
      {" \n{\"a\": 1}"sv, FileType::kText, "a JSON file"},
      {"x,y,z\n1,2,3\n"sv, FileType::kText, "a text"},
      {"\x01\x02\x03"sv, FileType::kUnknown, ""}};
  for (const auto& [bytes, type, name] : cases) {
    const FileKind dut = KindOfBytes(bytes);
    EXPECT_EQ(dut.type, type) << bytes;
    EXPECT_EQ(dut.name, name) << bytes;
  }
}

TEST(FileType, ATextMayBeCutOffInTheMiddleOfACharacter) {
  const std::string text = "Fußgänger 歩行者";
  for (std::size_t size = 1; size <= text.size(); ++size) {
    EXPECT_EQ(KindOfBytes(text.substr(0, size)).type, FileType::kText) << size;
  }
}

TEST(FileType, TheExtensionTellsOnlyWhereBytesDoNot) {
  TemporaryFolder folder;
  folder.Write("scan.bin", "\x01\x02\x03\x04");
  folder.Write("map.bin", "# Octomap OcTree binary file\n");
  EXPECT_THAT(KindOfFile(folder / "scan.bin").name, testing::HasSubstr("raw numbers"));
  EXPECT_EQ(KindOfFile(folder / "map.bin").type, FileType::kOctomapBt);
  EXPECT_EQ(KindOfFile(folder / "none.bin").type, FileType::kUnknown);
  EXPECT_EQ(LowerExtension("a/MAP.BT"), ".bt");
}

}  // namespace
}  // namespace clearway
