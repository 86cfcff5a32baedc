#include "io/lzf.h"

namespace clearway {

std::optional<std::string> UnpackLzf(std::string_view packed, std::size_t size) {
  constexpr std::size_t kMaxRatio = 132;  // 264 bytes out of 2, or 3
  if (size / kMaxRatio > packed.size()) return std::nullopt;
  std::string out;
  out.reserve(size);
  std::size_t at = 0;
  const auto left = [&] { return packed.size() - at; };
  const auto next = [&] { return static_cast<unsigned char>(packed[at++]); };
  while (at < packed.size()) {
    const std::size_t control = next();
    if (control < 32) {
      const std::size_t literals = control + 1;
      if (literals > left() || literals > size - out.size()) return std::nullopt;
      out += packed.substr(at, literals);
      at += literals;
      continue;
    }
    std::size_t length = (control >> 5) + 2;
    const bool is_long = length == 9;
    if (left() < (is_long ? 2u : 1u)) return std::nullopt;
    if (is_long) length += next();
    const std::size_t back = ((control & 31) << 8) + next() + 1;
    if (back > out.size() || length > size - out.size()) return std::nullopt;
    // Byte by byte: a repetition may reach into itself.
    for (std::size_t from = out.size() - back, i = 0; i < length; ++i) out += out[from + i];
  }
  if (out.size() != size) return std::nullopt;
  return out;
}

}  // namespace clearway
