// --keep-going: what a command does about frames that cannot be read.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <optional>
#include <string>

#include "absl/status/status.h"
#include "clearway/io/frame_source.h"

namespace clearway::cli {

void AddKeepGoingFlag(CLI::App* command, bool* keep_going,
                      const std::string& help =
                          "Go on after a frame that cannot be read; it is left out\n(the exit code "
                          "is 1 still)");

// Reads the frames of a source. One that cannot be read stops the command; if it keeps going, the
// frame is counted and named among what the source leaves out. One thread.
class FrameReader {
 public:
  // Refers to the source.
  FrameReader(const FrameSource& source, bool keep_going)
      : source_(source), keep_going_(keep_going) {}

  // None if it cannot be read. Motions that start before the range that is read, of objects that
  // come into sight later, are taken out: to the scene they would start before it knows of them.
  std::optional<Frame> Read(std::size_t index);
  bool stopped() const { return unread_ > 0 && !keep_going_; }
  std::size_t unread() const { return unread_; }

  // OK if every frame could be read. Else an error that names the first one that could not. If the
  // command stopped there, `so_far` says what it had done: "; 3 frames were sent".
  absl::Status Result(const std::string& so_far = "") const;

 private:
  const FrameSource& source_;
  bool keep_going_;
  std::optional<Time> begin_;  // of the range; none before the first frame
  std::size_t unread_ = 0;
  std::size_t first_ = 0;  // of those unread
  absl::Status why_;       // the first is
};

}  // namespace clearway::cli
