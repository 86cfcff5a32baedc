// What the fuzz targets share. Each defines LLVMFuzzerTestOneInput, and ends the program when
// something is true that must not be: libFuzzer then keeps the input.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace clearway::fuzz {

// Ends the program unless it holds.
void Require(bool holds, const std::string& what);

// Whether input was taken or refused, it was for a reason that was foreseen: never INTERNAL or
// UNKNOWN, never without a word.
void RequireForeseen(const absl::Status& status);

inline std::string_view TextOf(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

// Removes the first line, without its end, and returns it.
std::string_view TakeLine(std::string_view& text);

// An input that is several files: a line "== NAME" before the bytes of each, which the next such
// line ends. Names are as they stand; what comes before the first is left out.
struct InputFile {
  std::string_view name, bytes;
};
std::vector<InputFile> FilesOf(std::string_view input);

}  // namespace clearway::fuzz
