// --from and --to: which frames of a source a command uses.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <optional>
#include <string>
#include <variant>

#include "absl/status/statusor.h"
#include "clearway/io/frame_source.h"

namespace clearway::cli {

// A frame's number, counted from 0, or a time after the first frame's stamp.
using FrameBound = std::variant<std::size_t, Duration>;

// "59" (a frame), "2.5s" (seconds).
absl::StatusOr<FrameBound> ParseFrameBound(const std::string& text);

struct FrameRangeFlags {
  std::optional<FrameBound> from, to;
};
void AddFrameRangeFlags(CLI::App* command, FrameRangeFlags* flags);

// Frames [first, end); never empty.
struct FrameRange {
  std::size_t first = 0, end = 0;

  std::size_t size() const { return end - first; }
};

// The frames that the flags ask for. Stamps are looked up by bisection, so `source` must hold them
// in ascending order. A usage error, with the range that the source has, if they ask for frames
// beyond it or for none; FAILED_PRECONDITION if the source, named `spec`, is empty. Seconds need
// frame 0: if it cannot be read, that is the error.
absl::StatusOr<FrameRange> FramesIn(const FrameRangeFlags& flags, const std::string& spec,
                                    const FrameSource& source);

}  // namespace clearway::cli
