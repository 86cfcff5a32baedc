#include "fuzz/fuzz.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace clearway::fuzz {
namespace {

constexpr std::string_view kMark = "== ";

// Of the mark at or after `from` that stands at the begin of a line.
std::size_t FindMark(std::string_view input, std::size_t from) {
  while (true) {
    const std::size_t at = input.find(kMark, from);
    if (at == std::string_view::npos || at == 0 || input[at - 1] == '\n') return at;
    from = at + 1;
  }
}

}  // namespace

void Require(bool holds, const std::string& what) {
  if (holds) return;
  std::fprintf(stderr, "fuzz: %s\n", what.c_str());
  std::abort();
}

void RequireForeseen(const absl::Status& status) {
  Require(!absl::IsInternal(status) && !absl::IsUnknown(status), status.ToString());
  Require(status.ok() || !status.message().empty(), "an error that says nothing");
}

std::string_view TakeLine(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

std::vector<InputFile> FilesOf(std::string_view input) {
  std::vector<InputFile> files;
  for (std::size_t at = FindMark(input, 0); at != std::string_view::npos;) {
    const std::size_t next = FindMark(input, at + kMark.size());
    std::string_view rest = input.substr(at + kMark.size(), next - at - kMark.size());
    const std::string_view name = TakeLine(rest);
    files.push_back({name, rest});
    at = next;
  }
  return files;
}

}  // namespace clearway::fuzz
