// Maps as files.
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "clearway/wire/answers.h"
#include "server/versions.h"

namespace clearway {

// The file's bytes. NOT_FOUND for an object that the scene does not have, CANCELLED
// once `gone`. Any thread may call it.
absl::StatusOr<std::string> ExportedFile(const SceneSnapshot& scene, const ExportTarget& target,
                                         MapFormat format, const Gone& gone);

}  // namespace clearway
