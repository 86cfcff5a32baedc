#include "cli/frame_reader.h"

#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "cli/message.h"
#include "cli/text.h"

namespace clearway::cli {

void AddKeepGoingFlag(CLI::App* command, bool* keep_going, const std::string& help) {
  command->add_flag("--keep-going", *keep_going, help);
}

std::optional<Frame> FrameReader::Read(std::size_t index) {
  absl::StatusOr<Frame> frame = source_.read(index);
  if (frame.ok()) {
    if (!begin_) begin_ = index > 0 ? frame->stamp : Time::min();
    const bool is_first = frame->stamp == *begin_;
    std::erase_if(frame->motions,
                  [&](const ObjectMotion& motion) { return !is_first && motion.from < *begin_; });
    return *std::move(frame);
  }
  if (unread_++ == 0) {
    first_ = index;
    why_ = frame.status();
  }
  if (keep_going_) {
    source_.left_out->AddFrame(
        absl::StrCat(frame.status().message(), " (frame ", index, ", counted from 0)"));
  }
  return std::nullopt;
}

absl::Status FrameReader::Result(const std::string& so_far) const {
  if (unread_ == 0) return absl::OkStatus();
  if (stopped()) {
    return InContext(
        absl::StrCat("stopped at frame ", first_, " of ", source_.frame_count, " (counted from 0)",
                     so_far, "; --keep-going leaves such frames out"),
        why_);
  }
  return InContext(absl::StrCat(Plural(unread_, "frame"), " could not be read, the first: frame ",
                                first_, " (counted from 0)"),
                   why_);
}

}  // namespace clearway::cli
