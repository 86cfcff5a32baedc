// A file that no folder has.
#pragma once

#include <string>
#include <string_view>

#include "absl/status/status.h"

namespace clearway {

// For secrets that a library wants to read from a path: it never reaches a disk, and other users
// cannot open it. One thread; readers of the path may be others, and see the old bytes or the new.
class MemoryFile {
 public:
  MemoryFile() = default;
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  // UNAVAILABLE, with the file as it was, if the system refuses.
  absl::Status Replace(std::string_view bytes);

  // Within this process, once there are bytes; stays the same when they are replaced.
  std::string path() const;

 private:
  int fd_ = -1;
};

}  // namespace clearway
