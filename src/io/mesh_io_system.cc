#include "io/mesh_io_system.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <utility>

#include "absl/strings/ascii.h"
#include "clearway/base/file.h"

namespace clearway {
namespace {

using Path = std::filesystem::path;

// A file in memory.
class MemoryStream : public Assimp::IOStream {
 public:
  explicit MemoryStream(std::string bytes) : bytes_(std::move(bytes)) {}

  std::size_t Read(void* buffer, std::size_t size, std::size_t count) override {
    if (size == 0) return 0;
    const std::size_t items = std::min(count, (bytes_.size() - at_) / size);
    std::memcpy(buffer, bytes_.data() + at_, items * size);
    at_ += items * size;
    return items;
  }
  std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
  aiReturn Seek(std::size_t offset, aiOrigin origin) override {
    // Offsets from the end count backwards in assimp's own streams in memory.
    if (origin != aiOrigin_SET && origin != aiOrigin_CUR && origin != aiOrigin_END) {
      return aiReturn_FAILURE;
    }
    const std::size_t from = origin == aiOrigin_SET ? 0 : at_;
    const std::size_t most = bytes_.size() - (origin == aiOrigin_END ? 0 : from);
    if (offset > most) return aiReturn_FAILURE;
    at_ = origin == aiOrigin_END ? bytes_.size() - offset : from + offset;
    return aiReturn_SUCCESS;
  }
  std::size_t Tell() const override { return at_; }
  std::size_t FileSize() const override { return bytes_.size(); }
  void Flush() override {}

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

}  // namespace

bool MeshIoSystem::IsMesh(const char* file) const {
  return Path(file).lexically_normal() == mesh_.lexically_normal();
}

bool MeshIoSystem::IsBuffer(const char* file) const {
  const Path path = Path(file).lexically_normal();
  if (absl::AsciiStrToLower(mesh_.extension().string()) != ".gltf") return false;
  if (absl::AsciiStrToLower(path.extension().string()) != ".bin") return false;
  const Path folder = mesh_.parent_path();
  const Path relative = path.lexically_relative(folder.lexically_normal());
  if (relative.empty() || *relative.begin() == "..") return false;
  return std::ranges::any_of(buffers_, [&](const std::string& buffer) {
    return path == (folder / buffer).lexically_normal();
  });
}

bool MeshIoSystem::Exists(const char* file) const {
  std::error_code error;
  return IsMesh(file) || (IsBuffer(file) && std::filesystem::exists(file, error));
}

Assimp::IOStream* MeshIoSystem::Open(const char* file, const char*) {
  if (IsMesh(file)) return new MemoryStream(bytes_);
  if (!IsBuffer(file)) return nullptr;
  absl::StatusOr<std::string> bytes = ReadWholeFile(file, max_buffer_bytes_);
  status_.Update(bytes.status());
  return bytes.ok() ? new MemoryStream(*std::move(bytes)) : nullptr;
}

void MeshIoSystem::Close(Assimp::IOStream* stream) { delete stream; }

bool MeshIoSystem::ComparePaths(const char* one, const char* second) const {
  return Path(one).lexically_normal() == Path(second).lexically_normal();
}

}  // namespace clearway
