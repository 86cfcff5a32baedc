#include "clearway/base/secret_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "absl/strings/str_cat.h"
#include "clearway/base/file.h"

namespace clearway {
namespace {

absl::Status CannotWrite(const std::filesystem::path& path, int error) {
  return absl::UnavailableError(
      absl::StrCat(path.string(), ": cannot be written: ", std::strerror(error)));
}

bool WriteAll(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = write(fd, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return fsync(fd) == 0;
}

// Gives the open file the permissions and the owner of the one that it will replace, if there is
// one.
void TakeAfter(const std::filesystem::path& old, int fd) {
  struct stat status {};
  if (stat(old.c_str(), &status) != 0) return;
  if (fchown(fd, status.st_uid, status.st_gid) != 0) return;  // only root can give files away
  fchmod(fd, status.st_mode & (S_IRWXU | S_IRGRP));
}

}  // namespace

absl::StatusOr<std::string> ReadSecretFile(const std::filesystem::path& path,
                                           std::uint64_t max_bytes) {
  absl::StatusOr<std::string> bytes = ReadWholeFile(path, max_bytes);
  if (!bytes.ok()) return bytes;
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) {
    return absl::NotFoundError(absl::StrCat(path.string(), ": ", std::strerror(errno)));
  }
  constexpr mode_t kTooOpen = S_IWGRP | S_IRWXO;
  if ((status.st_mode & kTooOpen) == 0) return bytes;
  return absl::FailedPreconditionError(absl::StrCat(
      path.string(), ": others can ", (status.st_mode & S_IROTH) != 0 ? "read" : "write or run",
      " it; run 'chmod ", (status.st_mode & S_IRGRP) != 0 ? "640 " : "600 ", path.string(), "'"));
}

absl::Status WriteSecretFile(const std::filesystem::path& path, std::string_view bytes) {
  const auto file = OutputFile(path);
  if (!file.ok()) return file.status();
  const std::filesystem::path partial = file->string() + ".partial";
  unlink(partial.c_str());
  const int fd = open(partial.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, S_IRUSR | S_IWUSR);
  if (fd < 0) return CannotWrite(path, errno);
  TakeAfter(*file, fd);
  const bool written = WriteAll(fd, bytes);
  const int error = errno;
  close(fd);
  if (written) return MoveInto(partial, *file);
  unlink(partial.c_str());
  return CannotWrite(path, error);
}

}  // namespace clearway
