#include "io/utf8.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace clearway {

bool IsUtf8(std::string_view bytes) {
  while (!bytes.empty()) {
    const auto first = static_cast<std::uint8_t>(bytes.front());
    const int ones = std::countl_one(first);  // 0: ASCII; else the length of the sequence
    const std::size_t length = ones == 0 ? 1 : ones;
    if (ones == 1 || ones > 4 || length > bytes.size()) return false;
    std::uint32_t code = first & 0xFFu >> (ones + 1);
    for (const char c : bytes.substr(1, length - 1)) {
      if ((c & 0xC0) != 0x80) return false;
      code = code << 6 | (c & 0x3F);
    }
    constexpr std::uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
    if (code < kLeast[ones] || code > 0x10FFFF || (code >= 0xD800 && code <= 0xDFFF)) return false;
    bytes.remove_prefix(length);
  }
  return true;
}

bool IsPlainText(std::string_view bytes) {
  const auto controls = [](char c) { return (c >= 0 && c < ' ') || c == 0x7F; };
  return std::ranges::none_of(bytes, controls) && IsUtf8(bytes);
}

}  // namespace clearway
