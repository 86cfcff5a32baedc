// Packed test data.
#pragma once

#include <bzlib.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace clearway {

// The contents of a .bz2 file; none if it is not a whole one. Link BZip2::BZip2.
inline std::optional<std::string> Bunzip2(const std::filesystem::path& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             &std::fclose);
  if (file == nullptr) return std::nullopt;
  int error = BZ_OK;
  BZFILE* const stream = BZ2_bzReadOpen(&error, file.get(), 0, 0, nullptr, 0);
  std::string text;
  char buffer[65536];
  while (error == BZ_OK) {
    const int size = BZ2_bzRead(&error, stream, buffer, sizeof buffer);
    if (error == BZ_OK || error == BZ_STREAM_END) text.append(buffer, size);
  }
  const bool whole = error == BZ_STREAM_END;
  BZ2_bzReadClose(&error, stream);
  if (!whole) return std::nullopt;
  return text;
}

}  // namespace clearway
