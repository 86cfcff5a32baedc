#include "io/numbered_scans.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "io/lidar_frames.h"
#include "io/numbered_files.h"

namespace clearway {

absl::StatusOr<NumberedScans> NumberedScans::In(const std::filesystem::path& folder,
                                                const std::string& extension, int digits) {
  auto files = NumberedFiles(folder, extension);
  if (!files.ok()) return files.status();
  NumberedScans scans;
  scans.folder_ = folder;
  scans.extension_ = extension;
  scans.digits_ = digits;
  scans.files_ = *std::move(files);
  return scans;
}

std::filesystem::path NumberedScans::FileOf(int frame) const {
  const auto file = files_.find(frame);
  if (file != files_.end()) return file->second;
  return folder_ / absl::StrFormat("%0*d%s", digits_, frame, extension_);
}

std::size_t NumberedScans::LeaveOutUnposed(const std::vector<RecordedPose>& poses,
                                           const std::filesystem::path& table,
                                           LeftOut& left_out) const {
  std::size_t count = 0;
  for (const auto& [frame, path] : files_) {
    if (PoseOf(poses, frame) != nullptr) continue;
    left_out.AddFrame(
        absl::StrCat(path.string(), ": no usable pose in ", table.filename().string()));
    ++count;
  }
  return count;
}

}  // namespace clearway
