// How far a long command has come: a bar that is redrawn on a terminal, plain lines elsewhere.
#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>
#include <ostream>
#include <string>

namespace clearway::cli {

// A plain value.
struct ProgressState {
  std::size_t done = 0;
  std::size_t total = 0;
  std::uint64_t points = 0;  // of all frames done
  double elapsed_s = 0;
};

// "[=====>    ]  45/100 frames  23.1 frames/s  2.81 M points/s  0:03 left"; without the bar where
// bar_columns is 0.
std::string ProgressText(const ProgressState& state, int bar_columns);

// Shows the progress of one command. Draws at most ten times a second on a terminal and one line in
// two seconds elsewhere. Used by one thread, except for Note.
class ProgressBar {
 public:
  ProgressBar(std::ostream& out, bool is_terminal, std::size_t total);

  void Update(std::size_t done, std::uint64_t points);
  // Draws the last state, and leaves the cursor on a new line. Afterwards Update does nothing.
  void Finish();
  // Prints a line of its own between the states. Any thread may call it.
  void Note(const std::string& line);
  const ProgressState& state() const { return state_; }

 private:
  void Draw();

  std::mutex writing_;  // to out_
  std::ostream& out_;
  const bool is_terminal_;
  const std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point next_draw_;
  ProgressState state_;
  std::optional<std::size_t> drawn_;  // frames done when it was drawn last
  bool finished_ = false;
};

}  // namespace clearway::cli
