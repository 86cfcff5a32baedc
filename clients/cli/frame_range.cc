#include "cli/frame_range.h"

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "cli/cli.h"
#include "cli/message.h"
#include "cli/text.h"
#include "cli/values.h"

namespace clearway::cli {
namespace {

std::string Name(const FrameBound& bound) {
  if (const auto* frame = std::get_if<std::size_t>(&bound)) return absl::StrCat(*frame);
  return Seconds(std::get<Duration>(bound));
}

// The frames of one source, by number and by time. Stamps are read with their frames.
class Frames {
 public:
  // At least one frame.
  Frames(const std::string& spec, const FrameSource& source)
      : spec_(spec), source_(source), first_(StampOf(0)) {}

  // The first frame not before the bound; frame_count if all are.
  std::size_t FirstFrom(const FrameBound& bound) {
    if (const auto* frame = std::get_if<std::size_t>(&bound)) return *frame;
    return Bisect([offset = std::get<Duration>(bound)](Duration at) { return at < offset; });
  }

  // The number of frames not after the bound; above frame_count if the bound is beyond the last.
  std::size_t EndAt(const FrameBound& bound) {
    if (const auto* frame = std::get_if<std::size_t>(&bound)) return *frame + 1;
    const Duration offset = std::get<Duration>(bound);
    if (offset > TimeOf(source_.frame_count - 1)) return source_.frame_count + 1;
    return Bisect([offset](Duration at) { return at <= offset; });
  }

  // That frame 0, from which seconds count, cannot be read.
  absl::Status Error() const {
    if (first_.ok()) return absl::OkStatus();
    return InContext(
        "seconds of --from and --to count from frame 0, which cannot be read; give numbers of "
        "frames instead",
        first_.status());
  }

  absl::Status Refused(const std::string& why) {
    std::string text = absl::StrCat(why, "; ", spec_, " ends at frame ", source_.frame_count - 1);
    const Duration last = TimeOf(source_.frame_count - 1);
    if (last != kUnread) absl::StrAppend(&text, ", ", Seconds(last), " after frame 0");
    return UsageError(text);
  }

 private:
  static constexpr Duration kUnread = Duration::max();

  absl::StatusOr<Time> StampOf(std::size_t k) const {
    const auto frame = source_.read(k);
    if (!frame.ok()) return frame.status();
    return frame->stamp;
  }

  // After frame 0. A frame that cannot be read is just before the next that can, and kUnread if
  // there is none, or if frame 0 cannot: what to do about such frames is not for the range to say.
  Duration TimeOf(std::size_t k) const {
    if (!first_.ok()) return kUnread;
    for (std::size_t next = k; next < source_.frame_count; ++next) {
      const auto stamp = StampOf(next);
      if (stamp.ok()) return *stamp - *first_ - Duration(next == k ? 0 : 1);
    }
    return kUnread;
  }

  // The first frame for which `before` does not hold.
  template <class Before>
  std::size_t Bisect(const Before& before) {
    std::size_t low = 0, high = source_.frame_count;
    while (low < high) {
      const std::size_t middle = low + (high - low) / 2;
      before(TimeOf(middle)) ? low = middle + 1 : high = middle;
    }
    return low;
  }

  const std::string& spec_;
  const FrameSource& source_;
  absl::StatusOr<Time> first_;  // stamp of frame 0
};

}  // namespace

absl::StatusOr<FrameBound> ParseFrameBound(const std::string& text) {
  std::uint64_t frame = 0;
  const bool digits = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
  constexpr std::uint64_t kMaxFrame = 1'000'000'000;
  if (digits && absl::SimpleAtoi(text, &frame) && frame <= kMaxFrame) return frame;
  if (text.ends_with('s') && !text.starts_with('-') && !text.starts_with('+')) {
    const auto seconds = ParseSeconds(text.substr(0, text.size() - 1));
    if (seconds.ok()) return *seconds;
  }
  return absl::InvalidArgumentError(absl::StrCat(
      "expected a frame's number (59) or seconds after the first frame (2.5s), not '", text, "'"));
}

void AddFrameRangeFlags(CLI::App* command, FrameRangeFlags* flags) {
  AddParsed(command, "--from", &flags->from, ParseFrameBound,
            "First frame: its number, counted from 0, or seconds after\nthe source's first frame "
            "(2.5s)")
      ->type_name("FRAME");
  AddParsed(command, "--to", &flags->to, ParseFrameBound,
            "Last frame, likewise (default: the source's last)")
      ->type_name("FRAME");
}

absl::StatusOr<FrameRange> FramesIn(const FrameRangeFlags& flags, const std::string& spec,
                                    const FrameSource& source) {
  if (source.frame_count == 0) return absl::FailedPreconditionError(spec + ": holds no frames");
  Frames frames(spec, source);
  FrameRange range{0, source.frame_count};
  const auto is_time = [](const std::optional<FrameBound>& bound) {
    return bound && std::holds_alternative<Duration>(*bound);
  };
  if (is_time(flags.from) || is_time(flags.to)) {
    if (auto status = frames.Error(); !status.ok()) return status;
  }
  if (flags.from) {
    range.first = frames.FirstFrom(*flags.from);
    if (range.first >= source.frame_count) {
      return frames.Refused(
          absl::StrCat("--from ", Name(*flags.from), " is beyond the last frame"));
    }
  }
  if (flags.to) {
    range.end = frames.EndAt(*flags.to);
    if (range.end > source.frame_count) {
      return frames.Refused(absl::StrCat("--to ", Name(*flags.to), " is beyond the last frame"));
    }
  }
  if (range.first < range.end) return range;
  return frames.Refused(absl::StrCat("no frame lies between --from ",
                                     Name(flags.from.value_or(std::size_t{0})), " and --to ",
                                     flags.to ? Name(*flags.to) : "the last frame"));
}

}  // namespace clearway::cli
