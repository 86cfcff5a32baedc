#include "clearway/base/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

#include "absl/strings/str_cat.h"

namespace clearway {
namespace {

constexpr std::size_t kChunkBytes = std::size_t{1} << 20;

// Closes the descriptor that it holds.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) close(fd_);
  }
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;

  int get() const { return fd_; }

 private:
  int fd_;
};

absl::Status OpenError(const std::filesystem::path& path, int error) {
  const std::string name = path.string();
  if (error == ENOENT || error == ENOTDIR) {
    return absl::NotFoundError(absl::StrCat(name, ": no such file"));
  }
  if (error == EACCES || error == EPERM) {
    return absl::PermissionDeniedError(absl::StrCat(name, ": permission denied"));
  }
  // A socket cannot be opened at all.
  if (error == ENXIO) return absl::InvalidArgumentError(absl::StrCat(name, ": is not a file"));
  return absl::UnavailableError(absl::StrCat(name, ": ", std::strerror(error)));
}

// What to call an entry of the file system that is no regular file.
const char* KindOf(mode_t mode) {
  if (S_ISDIR(mode)) return "is a folder";
  if (S_ISLNK(mode)) return "is a symbolic link, not a file";
  if (S_ISFIFO(mode)) return "is a pipe, not a file";
  if (S_ISCHR(mode) || S_ISBLK(mode)) return "is a device, not a file";
  return "is not a file";
}

// OK if nothing is there or a regular file, which a new one may replace.
absl::Status CheckReplaceable(const std::filesystem::path& path) {
  struct stat status {};
  if (lstat(path.c_str(), &status) != 0 || S_ISREG(status.st_mode)) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat(path.string(), ": ", KindOf(status.st_mode)));
}

struct OpenFile {
  Descriptor descriptor;
  std::uint64_t size = 0;  // 0 also for files of /proc, which hold more
};

absl::StatusOr<OpenFile> Open(const std::filesystem::path& path) {
  // O_NONBLOCK: to open a pipe would wait for a writer.
  Descriptor descriptor(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  if (descriptor.get() < 0) return OpenError(path, errno);
  struct stat status {};
  if (fstat(descriptor.get(), &status) != 0) return OpenError(path, errno);
  if (!S_ISREG(status.st_mode)) {
    return absl::InvalidArgumentError(absl::StrCat(path.string(), ": ", KindOf(status.st_mode)));
  }
  return OpenFile{std::move(descriptor), static_cast<std::uint64_t>(status.st_size)};
}

// Reads up to `most` bytes, whatever size the file claims.
absl::StatusOr<std::string> ReadUpTo(const std::filesystem::path& path, const OpenFile& file,
                                     std::uint64_t most) {
  std::string bytes;
  // One byte beyond the size finds the end without another round.
  bytes.resize(std::min(most, file.size + 1));
  std::size_t got = 0;
  while (got < most) {
    if (got == bytes.size()) bytes.resize(std::min<std::uint64_t>(most, got + kChunkBytes));
    const ssize_t count = read(file.descriptor.get(), bytes.data() + got, bytes.size() - got);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      return absl::UnavailableError(
          absl::StrCat(path.string(), ": cannot be read: ", std::strerror(errno)));
    }
    if (count == 0) break;
    got += static_cast<std::size_t>(count);
  }
  bytes.resize(got);
  return bytes;
}

absl::Status TooLarge(const std::filesystem::path& path, const std::string& size,
                      std::uint64_t max_bytes) {
  return absl::ResourceExhaustedError(
      absl::StrCat(path.string(), ": ", size, " bytes; the limit is ", max_bytes, " bytes"));
}

}  // namespace

absl::StatusOr<std::string> ReadWholeFile(const std::filesystem::path& path,
                                          std::uint64_t max_bytes) {
  const absl::StatusOr<OpenFile> file = Open(path);
  if (!file.ok()) return file.status();
  if (file->size > max_bytes) return TooLarge(path, absl::StrCat(file->size), max_bytes);
  absl::StatusOr<std::string> bytes = ReadUpTo(path, *file, max_bytes + 1);
  if (!bytes.ok()) return bytes;
  if (bytes->size() > max_bytes) {
    return TooLarge(path, absl::StrCat("more than ", max_bytes), max_bytes);
  }
  if (bytes->size() < file->size) {
    return absl::UnavailableError(absl::StrCat(path.string(), ": only ", bytes->size(), " of ",
                                               file->size, " bytes could be read"));
  }
  return bytes;
}

absl::StatusOr<std::string> ReadFileStart(const std::filesystem::path& path, std::size_t bytes) {
  const absl::StatusOr<OpenFile> file = Open(path);
  if (!file.ok()) return file.status();
  return ReadUpTo(path, *file, bytes);
}

absl::StatusOr<std::string_view> WithoutByteOrderMark(const std::string& name,
                                                      std::string_view text) {
  constexpr std::string_view kUtf8 = "\xEF\xBB\xBF";
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    return absl::InvalidArgumentError(
        absl::StrCat(name, ", line 1: the text is in UTF-16; save it as UTF-8"));
  }
  if (text.starts_with(kUtf8)) text.remove_prefix(kUtf8.size());
  return text;
}

absl::StatusOr<std::string> ReadTextFile(const std::filesystem::path& path,
                                         std::uint64_t max_bytes) {
  absl::StatusOr<std::string> bytes = ReadWholeFile(path, max_bytes);
  if (!bytes.ok()) return bytes;
  const auto text = WithoutByteOrderMark(path.string(), *bytes);
  if (!text.ok()) return text.status();
  bytes->erase(0, bytes->size() - text->size());
  return bytes;
}

absl::StatusOr<std::filesystem::path> OutputFile(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::path file = std::filesystem::weakly_canonical(path, error);
  if (error) return OpenError(path, error.value());
  for (const std::string& name : {file.string(), file.string() + ".partial"}) {
    if (auto status = CheckReplaceable(name); !status.ok()) return status;
  }
  return file;
}

absl::Status MoveInto(const std::filesystem::path& partial, const std::filesystem::path& path) {
  absl::Status status = CheckReplaceable(path);
  std::error_code error;
  if (status.ok()) {
    std::filesystem::rename(partial, path, error);
    if (!error) return status;
    status = absl::UnavailableError(absl::StrCat(path.string(), ": ", error.message()));
  }
  std::filesystem::remove(partial, error);
  return status;
}

absl::Status WriteWholeFile(const std::filesystem::path& path, std::string_view bytes) {
  const auto file = OutputFile(path);
  if (!file.ok()) return file.status();
  const std::filesystem::path partial = file->string() + ".partial";
  {
    std::ofstream out(partial, std::ios::binary | std::ios::trunc);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out) {
      std::error_code ignored;
      std::filesystem::remove(partial, ignored);
      return absl::UnavailableError(
          absl::StrCat(path.string(), ": cannot be written (no such folder, or disk full?)"));
    }
  }
  return MoveInto(partial, *file);
}

}  // namespace clearway
