// Lines of a mesh file in text form.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "io/text_lines.h"

namespace clearway {

// A word of the file in a message.
inline std::string Quoted(std::string_view word) {
  std::string text(1, '\'');
  text.append(word.substr(0, 40));
  text.push_back('\'');
  return text;
}

// Yields the words of the lines that have any, without comments (from a # on). A backslash at a
// line's end joins it to the next.
class MeshLines {
 public:
  // The text must outlive it.
  explicit MeshLines(std::string_view text) : lines_(text) {}

  // False at the end.
  bool Next(std::vector<std::string_view>& words) {
    words.clear();
    std::string_view line;
    while (words.empty() && lines_.Next(line)) AddWords(line, words);
    return !words.empty();
  }

  int number() const { return lines_.number(); }
  // INVALID_ARGUMENT: "line 3: <why>", of the line that Next gave.
  absl::Status Error(const std::string& why) const {
    return absl::InvalidArgumentError("line " + std::to_string(number()) + ": " + why);
  }

 private:
  void AddWords(std::string_view line, std::vector<std::string_view>& words) {
    for (bool more = true; more;) {
      line = Trimmed(line.substr(0, line.find('#')));
      more = line.ends_with('\\');
      if (more) line.remove_suffix(1);
      while (true) {
        const std::string_view word = TakeWord(line);
        if (word.empty()) break;
        words.push_back(word);
      }
      more = more && lines_.Next(line);
    }
  }

  TextLines lines_;
};

}  // namespace clearway
