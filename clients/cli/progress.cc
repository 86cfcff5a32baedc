#include "cli/progress.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "cli/text.h"

namespace clearway::cli {
namespace {

constexpr int kBarColumns = 24;
constexpr auto kTerminalPeriod = std::chrono::milliseconds(100);
constexpr auto kLinePeriod = std::chrono::seconds(2);

std::string Bar(std::size_t done, std::size_t total, int columns) {
  const auto filled = total == 0 ? columns : static_cast<int>(done * columns / total);
  std::string bar(columns, ' ');
  std::fill_n(bar.begin(), filled, '=');
  if (filled < columns) bar[filled] = '>';
  return "[" + bar + "]";
}

}  // namespace

std::string ProgressText(const ProgressState& state, int bar_columns) {
  const int width = static_cast<int>(absl::StrCat(state.total).size());
  std::string text = bar_columns > 0 ? Bar(state.done, state.total, bar_columns) + " " : "";
  absl::StrAppendFormat(&text, "%*d/%d frames", width, state.done, state.total);
  if (state.done == 0 || state.elapsed_s <= 0) return text;
  const double frames_per_s = static_cast<double>(state.done) / state.elapsed_s;
  absl::StrAppendFormat(&text, "  %s frames/s  %s points/s", Scaled(frames_per_s),
                        Scaled(static_cast<double>(state.points) / state.elapsed_s));
  if (state.done < state.total) {
    absl::StrAppend(&text, "  ",
                    Clock(static_cast<double>(state.total - state.done) / frames_per_s), " left");
  } else {
    absl::StrAppend(&text, "  in ", Fixed(state.elapsed_s, 1), " s");
  }
  return text;
}

ProgressBar::ProgressBar(std::ostream& out, bool is_terminal, std::size_t total)
    : out_(out),
      is_terminal_(is_terminal),
      start_(std::chrono::steady_clock::now()),
      next_draw_(start_ + (is_terminal ? kTerminalPeriod : kLinePeriod)) {
  state_.total = total;
}

void ProgressBar::Update(std::size_t done, std::uint64_t points) {
  if (finished_) return;
  const auto now = std::chrono::steady_clock::now();
  state_.done = done;
  state_.points = points;
  state_.elapsed_s = std::chrono::duration<double>(now - start_).count();
  if (now < next_draw_) return;
  next_draw_ = now + (is_terminal_ ? kTerminalPeriod : kLinePeriod);
  Draw();
}

void ProgressBar::Finish() {
  if (finished_) return;
  finished_ = true;
  // A line that already says so need not be repeated; a terminal's is redrawn.
  if (is_terminal_ || drawn_ != state_.done) Draw();
  if (!is_terminal_) return;
  const std::lock_guard lock(writing_);
  out_ << "\n" << std::flush;
}

void ProgressBar::Note(const std::string& line) {
  const std::lock_guard lock(writing_);
  out_ << (is_terminal_ ? "\r" : "") << line << (is_terminal_ ? "\x1b[K\n" : "\n") << std::flush;
}

void ProgressBar::Draw() {
  drawn_ = state_.done;
  const std::lock_guard lock(writing_);
  if (is_terminal_) {
    // Back to the line's start; clear what a longer line before left behind.
    out_ << "\r" << ProgressText(state_, kBarColumns) << "\x1b[K" << std::flush;
  } else {
    out_ << ProgressText(state_, 0) << "\n" << std::flush;
  }
}

}  // namespace clearway::cli
