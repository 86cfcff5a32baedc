// What tests of PLY meshes share: reading, and the errors of files that are refused.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "absl/strings/str_replace.h"
#include "io/ply_mesh.h"

namespace clearway::testing_support {

inline absl::StatusOr<Mesh> ReadPly(const std::string& bytes, const MeshFileOptions& options = {}) {
  return ReadPlyMesh("a.ply", bytes, options);
}

inline std::string PlyErrorOf(const std::string& bytes) {
  const auto mesh = ReadPly(bytes);
  EXPECT_EQ(mesh.status().code(), absl::StatusCode::kInvalidArgument) << mesh.status();
  EXPECT_THAT(std::string(mesh.status().message()), testing::StartsWith("a.ply"));
  return std::string(mesh.status().message());
}

inline std::string With(const std::string& text, const std::string& from, const std::string& to) {
  EXPECT_THAT(text, testing::HasSubstr(from));
  return absl::StrReplaceAll(text, {{from, to}});
}

}  // namespace clearway::testing_support
