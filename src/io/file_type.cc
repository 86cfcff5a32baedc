#include "clearway/io/file_type.h"

#include "absl/strings/ascii.h"
#include "clearway/base/file.h"
#include "io/utf8.h"

namespace clearway {
namespace {

using namespace std::literals;

struct Magic {
  std::string_view bytes;
  FileType type;
  const char* name;
  std::size_t at = 0;
};

constexpr Magic kMagics[] = {
    {"SQLite format 3\0"sv, FileType::kSqlite, "an SQLite database"},
    {"# Octomap OcTree binary file"sv, FileType::kOctomapBt, "an OctoMap file (.bt)"},
    {"# Octomap OcTree file"sv, FileType::kOctomapOt, "an OctoMap file (.ot)"},
    {"# .PCD"sv, FileType::kOther, "a point cloud (PCD)"},
    {"ply\n"sv, FileType::kOther, "a point cloud or mesh (PLY)"},
    {"ply\r"sv, FileType::kOther, "a point cloud or mesh (PLY)"},
    {"LASF"sv, FileType::kOther, "a point cloud (LAS)"},
    {"ASTM-E57"sv, FileType::kOther, "a point cloud (E57)"},
    {"#ROSBAG V"sv, FileType::kOther, "a ROS 1 bag"},
    {"\x89MCAP"sv, FileType::kOther, "an MCAP file (a ROS 2 bag)"},
    {"\x89HDF\r\n\x1a\n"sv, FileType::kOther, "an HDF5 file"},
    {"\x93NUMPY"sv, FileType::kOther, "a NumPy array"},
    {"\x89PNG\r\n\x1a\n"sv, FileType::kOther, "a PNG image"},
    {"\xFF\xD8\xFF"sv, FileType::kOther, "a JPEG image"},
    {"II*\0"sv, FileType::kOther, "a TIFF image"},
    {"MM\0*"sv, FileType::kOther, "a TIFF image"},
    {"P5\n"sv, FileType::kOther, "a PGM image"},
    {"P5 "sv, FileType::kOther, "a PGM image"},
    {"PK\x03\x04"sv, FileType::kOther, "a zip archive"},
    {"\x1F\x8B"sv, FileType::kOther, "compressed by gzip"},
    {"BZh"sv, FileType::kOther, "compressed by bzip2"},
    {"\xFD"
     "7zXZ\0"sv,
     FileType::kOther, "compressed by xz"},
    {"\x28\xB5\x2F\xFD"sv, FileType::kOther, "compressed by zstd"},
    {"7z\xBC\xAF\x27\x1C"sv, FileType::kOther, "a 7z archive"},
    {"ustar"sv, FileType::kOther, "a tar archive", 257},
    {"glTF"sv, FileType::kOther, "a mesh (glTF)"},
    {"%PDF"sv, FileType::kOther, "a PDF document"},
    {"\x7F"
     "ELF"sv,
     FileType::kOther, "a program"},
    {"\xFF\xFE"sv, FileType::kText, "a text in UTF-16"},
    {"\xFE\xFF"sv, FileType::kText, "a text in UTF-16"},
    {"<?xml"sv, FileType::kText, "an XML file"},
    {"\xEF\xBB\xBF"sv, FileType::kText, "a text"},
};

// Whether it is UTF-8 but for a sequence that is cut off at its end.
bool IsText(std::string_view start) {
  constexpr std::size_t kLongestSequence = 4;
  for (const char c : start) {
    if (c >= 0 && c < ' ' && c != '\n' && c != '\r' && c != '\t' && c != '\f') return false;
  }
  for (std::size_t cut = 0; cut < kLongestSequence && cut < start.size(); ++cut) {
    if (IsUtf8(start.substr(0, start.size() - cut))) return true;
  }
  return false;
}

// Of formats that do not begin with anything of their own.
FileKind KindOfExtension(const std::string& extension) {
  constexpr std::pair<const char*, const char*> kNames[] = {
      {".bin", "raw numbers (as KITTI's scans; name their folder)"},
      {".pcd", "a point cloud (PCD)"},
      {".las", "a point cloud (LAS)"},
      {".laz", "a point cloud (LAZ)"},
      {".graph", "a scan graph of OctoMap"},
      {".log", "a log"},
      {".stl", "a mesh (STL)"},
      {".mat", "a file of MATLAB"},
      {".pkl", "a Python pickle"},
      {".bag", "a ROS bag"}};
  for (const auto& [known, name] : kNames) {
    if (extension == known) return {FileType::kOther, name};
  }
  return {};
}

}  // namespace

FileKind KindOfBytes(std::string_view start) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (start.size() > kByteOrderMark.size() && start.starts_with(kByteOrderMark)) {
    const FileKind marked = KindOfBytes(start.substr(kByteOrderMark.size()));
    if (marked.type != FileType::kUnknown && marked.type != FileType::kText) return marked;
  }
  for (const Magic& magic : kMagics) {
    if (start.size() < magic.at) continue;
    if (start.substr(magic.at).starts_with(magic.bytes)) return {magic.type, magic.name};
  }
  if (start.empty()) return {FileType::kOther, "empty"};
  if (!IsText(start)) return {};
  // A PCD file may begin with other comments, or none.
  for (const char* header : {"\nVERSION 0.7", "\nVERSION .7", "VERSION 0.7", "VERSION .7"}) {
    if (start.find(header) != std::string_view::npos &&
        start.find("FIELDS") != std::string_view::npos) {
      return {FileType::kOther, "a point cloud (PCD)"};
    }
  }
  const std::size_t first = start.find_first_not_of(" \t\r\n");
  const bool is_json =
      first != std::string_view::npos && (start[first] == '{' || start[first] == '[');
  return {FileType::kText, is_json ? "a JSON file" : "a text"};
}

FileKind KindOfFile(const std::filesystem::path& path) {
  constexpr std::size_t kEnough = 512;
  const auto start = ReadFileStart(path, kEnough);
  if (!start.ok()) return {};
  FileKind kind = KindOfBytes(*start);
  return kind.type == FileType::kUnknown ? KindOfExtension(LowerExtension(path)) : kind;
}

std::string LowerExtension(const std::filesystem::path& path) {
  return absl::AsciiStrToLower(path.extension().string());
}

}  // namespace clearway
