#include "clearway/base/number_text.h"

#include <array>
#include <charconv>
#include <cmath>

namespace clearway {
namespace {

template <class T>
std::string Shortest(T number) {
  // Where printf's %g writes no exponent, to_chars is not to write one either.
  constexpr T kSmallest = T(1e-4), kLargest = T(1e6);
  const T size = std::abs(number);
  std::array<char, 64> text;
  char* const end = text.data() + text.size();
  const auto result = size >= kSmallest && size < kLargest
                          ? std::to_chars(text.data(), end, number, std::chars_format::fixed)
                          : std::to_chars(text.data(), end, number);
  return std::string(text.data(), result.ptr);
}

}  // namespace

std::string NumberText(double number) { return Shortest(number); }

std::string NumberText(float number) { return Shortest(number); }

}  // namespace clearway
