// Frames of any source into a recording.
#pragma once

#include <cstdint>
#include <string>

#include "absl/status/statusor.h"
#include "cli/cli.h"
#include "cli/frame_range.h"
#include "cli/frame_reader.h"

namespace clearway::cli {

struct Written {
  std::size_t frames = 0;
  std::uint64_t points = 0;
};

// INVALID_ARGUMENT, naming --out, for names that people, and other programs, take for another kind
// of file.
absl::Status CheckRecordingName(const std::string& out);

// The frames of the source that `reader` can read. The recording appears at `path` when it is
// whole. Errors as RecordingWriter's, and the reader's if it stops or can read none; ALREADY_EXISTS
// unless `overwrite`.
absl::StatusOr<Written> WriteRecording(const FrameSource& source, FrameReader& reader,
                                       FrameRange range, const std::string& path, bool overwrite,
                                       const Terminal& terminal);

// "wrote drive.cwr: 100 frames, 2,000,000 points", and what to do with it.
void PrintWritten(std::ostream& out, const std::string& path, const Written& written);

}  // namespace clearway::cli
