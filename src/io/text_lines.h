// The lines of a text.
#pragma once

#include <string>
#include <string_view>

#include "absl/status/status.h"

namespace clearway {

// Whether a file whose last line does not end is taken: one that ends in a number might be cut off
// in the middle of it.
enum class LastLine { kEnds, kMayBeOpen };

// Yields lines that end in LF or CRLF, without their ends.
class TextLines {
 public:
  // The text must outlive it.
  explicit TextLines(std::string_view text) : rest_(text) {}

  // False at the end.
  bool Next(std::string_view& line);
  // Of the line that Next gave, from 1.
  int number() const { return number_; }
  // What follows that line.
  std::string_view rest() const { return rest_; }
  // Goes on behind `count` bytes of the rest, which hold that many line ends.
  void Skip(std::size_t count, int line_ends);

 private:
  std::string_view rest_;
  int number_ = 0;
};

// INVALID_ARGUMENT naming the line if the last one has no end but needs one.
absl::Status CheckLastLine(const std::string& name, std::string_view text, LastLine last);

// Without blanks at both ends.
std::string_view Trimmed(std::string_view text);

// Takes the next word off the front of a line; empty if there is none.
std::string_view TakeWord(std::string_view& line, std::string_view separators = " \t\r");

}  // namespace clearway
