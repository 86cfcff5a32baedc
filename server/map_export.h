// Maps as files.
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "clearway/wire/answers.h"

namespace clearway {

// The file's bytes. NOT_FOUND for an object that the scene does not have. Any thread may call it.
absl::StatusOr<std::string> ExportedFile(const SceneSnapshot& scene, const ExportTarget& target,
                                         MapFormat format);

}  // namespace clearway
