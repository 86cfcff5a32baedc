#include "clearway/io/mesh_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <new>
#include <string>
#include <system_error>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "clearway/base/file.h"
#include "clearway/base/number_text.h"
#include "io/assimp_import.h"
#include "io/guarded_call.h"
#include "io/mesh_bytes.h"
#include "io/mesh_content.h"
#include "io/ply_mesh.h"

namespace clearway {
namespace {

using Path = std::filesystem::path;

// The formats whose importers are simple enough to be given files of unknown origin.
constexpr std::array<const char*, 7> kExtensions = {".stl", ".obj",  ".ply", ".off",
                                                    ".dae", ".gltf", ".glb"};
// What an import may take: assimp has several objects for a face, and for a word of JSON or XML.
constexpr std::uint64_t kMinImportBytes = 1'000'000'000, kImportBytesPerByte = 32;

std::string ExtensionOf(const Path& path) {
  return absl::AsciiStrToLower(path.extension().string());
}

absl::Status CheckOptions(const Path& path, const MeshFileOptions& options) {
  if (!(options.scale > 0) || !std::isfinite(options.scale)) {
    return absl::InvalidArgumentError(
        absl::StrCat("scale is ", NumberText(options.scale), "; it must be above 0"));
  }
  if (options.max_time <= Duration::zero()) {
    return absl::InvalidArgumentError(absl::StrCat(
        "max_time is ", NumberText(ToSeconds(options.max_time)), " s; it must be above 0"));
  }
  const std::string extension = ExtensionOf(path);
  if (std::find(kExtensions.begin(), kExtensions.end(), extension) == kExtensions.end()) {
    return absl::InvalidArgumentError(absl::StrCat(
        path.string(), ": the extension must be .stl, .obj, .ply, .off, .dae, .gltf or .glb"));
  }
  return absl::OkStatus();
}

// A byte order mark stands before text only.
absl::Status DropByteOrderMark(const std::string& extension, std::string& bytes) {
  if (extension == ".glb" || (extension == ".stl" && IsWholeBinaryStl(bytes))) {
    return absl::OkStatus();
  }
  const auto text = WithoutByteOrderMark("the file", bytes);
  if (text.ok()) bytes.erase(0, bytes.size() - text->size());
  return text.status();
}

// Of the file and those beside it that a .gltf may name, which are read one by one.
std::uint64_t MaxImportBytes(const Path& path, const std::string& bytes,
                             const MeshFileOptions& options) {
  const bool has_buffers = ExtensionOf(path) == ".gltf";
  const std::uint64_t input = has_buffers ? options.max_bytes : bytes.size();
  return kMinImportBytes +
         kImportBytesPerByte * std::min(input, std::numeric_limits<std::uint64_t>::max() / 64);
}

absl::StatusOr<Mesh> Import(const Path& path, const std::string& bytes,
                            const MeshFileOptions& options) {
  const CallLimits limits = {.max_time = options.max_time,
                             .max_memory_bytes = MaxImportBytes(path, bytes, options),
                             .max_result_bytes = MaxMeshBytes(options.max_triangles)};
  const auto import = [&]() -> absl::StatusOr<std::string> {
    const auto mesh = ImportByAssimp(path, ExtensionOf(path), bytes, options);
    if (!mesh.ok()) return mesh.status();
    return MeshToBytes(*mesh);
  };
  const absl::StatusOr<std::string> mesh = CallGuarded("assimp", limits, import);
  if (mesh.ok()) return MeshFromBytes(*mesh);
  if (!absl::IsDeadlineExceeded(mesh.status()) && !absl::IsAborted(mesh.status())) {
    return mesh.status();
  }
  return absl::InvalidArgumentError(
      absl::StrCat("cannot be read: ", std::string(mesh.status().message())));
}

absl::StatusOr<Mesh> Read(const Path& path, const MeshFileOptions& options) {
  absl::StatusOr<std::string> bytes = ReadWholeFile(path, options.max_bytes);
  if (!bytes.ok()) return bytes.status();
  absl::Status status = DropByteOrderMark(ExtensionOf(path), *bytes);
  if (status.ok() && ExtensionOf(path) == ".ply") {
    return ReadPlyMesh(path.string(), *bytes, options);
  }
  if (status.ok()) {
    absl::StatusOr<Mesh> mesh = Import(path, *bytes, options);
    if (mesh.ok()) return mesh;
    status = mesh.status();
  }
  return absl::Status(status.code(),
                      absl::StrCat(path.string(), ": ", std::string(status.message())));
}

}  // namespace

absl::StatusOr<Mesh> ReadMesh(const Path& path, const MeshFileOptions& options) {
  if (auto status = CheckOptions(path, options); !status.ok()) return status;
  try {
    return Read(path, options);
  } catch (const std::bad_alloc&) {
    return absl::ResourceExhaustedError(
        absl::StrCat(path.string(), ": cannot be read: it takes more memory than there is"));
  }
}

}  // namespace clearway
