// Numbers out of text.
#pragma once

#include <charconv>
#include <string_view>
#include <system_error>

namespace clearway {

// The whole text as an integer of type T; false, and `value` as it was, if it is none.
template <class T>
bool ParseWhole(std::string_view text, T& value) {
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && rest == end;
}

// The whole text as a decimal number, also "nan", "inf" and one with a plus; the same in every
// locale. Numbers too large for a double become infinite, those too small 0.
bool ParseNumber(std::string_view text, double& value);

}  // namespace clearway
