// What assimp may read when it imports a mesh.
#pragma once

#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "absl/status/status.h"

namespace clearway {

// Serves the bytes of one mesh file and, to glTF files, the buffers (.bin) that they name in or
// below their own folder. To assimp no other file exists: materials and textures say nothing about
// a shape, and where it finds no buffer it tries files of that name elsewhere. Used by one thread,
// as long as one import.
class MeshIoSystem : public Assimp::IOSystem {
 public:
  // The first three must outlive it. Buffers are relative to the mesh file's folder.
  MeshIoSystem(const std::filesystem::path& mesh, const std::string& bytes,
               const std::vector<std::string>& buffers, std::uint64_t max_buffer_bytes)
      : mesh_(mesh), bytes_(bytes), buffers_(buffers), max_buffer_bytes_(max_buffer_bytes) {}

  bool Exists(const char* file) const override;
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* file, const char* mode) override;
  void Close(Assimp::IOStream* stream) override;
  bool ComparePaths(const char* one, const char* second) const override;

  // Why a buffer could not be read; OK if none was refused.
  const absl::Status& status() const { return status_; }

 private:
  bool IsMesh(const char* file) const;
  bool IsBuffer(const char* file) const;

  const std::filesystem::path& mesh_;
  const std::string& bytes_;
  const std::vector<std::string>& buffers_;
  std::uint64_t max_buffer_bytes_;
  absl::Status status_;
};

}  // namespace clearway
