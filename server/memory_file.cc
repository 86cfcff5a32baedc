#include "server/memory_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "absl/strings/str_cat.h"

namespace clearway {
namespace {

bool WriteAll(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = write(fd, bytes.data(), bytes.size());
    if (count < 0 && errno != EINTR) return false;
    if (count > 0) bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

}  // namespace

MemoryFile::~MemoryFile() {
  if (fd_ >= 0) close(fd_);
}

// A new file takes the old one's place as a whole.
absl::Status MemoryFile::Replace(std::string_view bytes) {
  const int fresh = memfd_create("clearway", MFD_CLOEXEC);
  const bool written = fresh >= 0 && WriteAll(fresh, bytes);
  if (written && fd_ < 0) {
    fd_ = fresh;
    return absl::OkStatus();
  }
  const bool replaced = written && dup3(fresh, fd_, O_CLOEXEC) >= 0;
  const int error = errno;
  if (fresh >= 0) close(fresh);
  if (replaced) return absl::OkStatus();
  return absl::UnavailableError(absl::StrCat("memory file: ", std::strerror(error)));
}

std::string MemoryFile::path() const { return absl::StrCat("/proc/self/fd/", fd_); }

}  // namespace clearway
