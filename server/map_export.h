// Maps as files.
#pragma once

#include "absl/status/status.h"
#include "clearway/io/byte_sink.h"
#include "clearway/wire/answers.h"
#include "server/versions.h"

namespace clearway {

// Writes the file piece by piece. NOT_FOUND for an object that the scene does not have, CANCELLED
// once `gone` or once the sink wants no more. Any thread may call it.
absl::Status ExportTo(const ByteSink& sink, const SceneSnapshot& scene, const ExportTarget& target,
                      MapFormat format, const Gone& gone);

}  // namespace clearway
