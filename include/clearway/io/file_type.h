// What kind of file another program wrote.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace clearway {

enum class FileType {
  kUnknown,  // nothing to read, or nothing known
  kSqlite,   // as recordings are, and ROS 2 bags
  kOctomapBt,
  kOctomapOt,
  kText,   // also JSON, XML and tables
  kOther,  // known by name, and read by none of our commands
};

struct FileKind {
  FileType type = FileType::kUnknown;
  std::string name;  // "a point cloud (PCD)"; empty if unknown
};

// By a file's first bytes, of which 512 are enough.
FileKind KindOfBytes(std::string_view start);
// The same of a file, by its extension if its bytes do not tell. kUnknown if it cannot be read.
FileKind KindOfFile(const std::filesystem::path& path);

// The extension in lower case: ".bt" of MAP.BT.
std::string LowerExtension(const std::filesystem::path& path);

}  // namespace clearway
