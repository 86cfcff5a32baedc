// Everything that `clearway replay` takes: folders of scans, depth images and logs, and recordings.
// An input is the files of one folder (FilesOf), whose content decides the format. Some formats are
// opened at a folder within: every folder that holds a file is tried, too.
#include <algorithm>
#include <set>

#include "cli/open_source.h"
#include "fuzz/fuzz.h"
#include "support/temporary_folder.h"

namespace clearway::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxFiles = 40;
constexpr std::size_t kMaxFrames = 20;  // that are read of a source

// Stays in the folder, and can be a name.
bool IsUsable(const fs::path& name) {
  if (name.empty() || name.is_absolute() || name.string().size() > 100) return false;
  for (const fs::path& part : name) {
    if (part == ".." || part == "." || part.empty()) return false;
  }
  return name.string().find('\0') == std::string::npos;
}

// Returns the folders to be opened.
std::set<fs::path> WriteFiles(const std::vector<InputFile>& files, const TemporaryFolder& folder) {
  std::set<fs::path> to_open = {folder.path()};
  for (const InputFile& file : files) {
    const fs::path name(file.name);
    if (!IsUsable(name)) continue;
    std::error_code error;  // the name of another file may stand where a folder should
    fs::create_directories((folder.path() / name).parent_path(), error);
    if (error || fs::is_directory(folder.path() / name, error)) continue;
    const fs::path path = folder.Write(name.string(), file.bytes);
    to_open.insert(path.parent_path());
    if (name.extension() == ".clearway") to_open.insert(path);
  }
  return to_open;
}

void ReadAll(const fs::path& path) {
  const auto source = cli::OpenSource(path.string(), cli::SourceFlags());
  RequireForeseen(source.status());
  if (!source.ok()) return;
  for (std::size_t i = 0; i < std::min(source->frame_count, kMaxFrames); ++i) {
    const auto frame = source->read(i);
    RequireForeseen(frame.status());
    if (!frame.ok()) continue;
    Require(frame->labels.size() == frame->points_S.size(), "points without labels");
  }
}

void Run(std::string_view input) {
  const std::vector<InputFile> files = FilesOf(input);
  if (files.size() > kMaxFiles) return;
  const TemporaryFolder folder;
  for (const fs::path& path : WriteFiles(files, folder)) ReadAll(path);
}

}  // namespace
}  // namespace clearway::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  clearway::fuzz::Run(clearway::fuzz::TextOf(data, size));
  return 0;
}
