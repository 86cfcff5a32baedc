#include "clearway/base/parse_number.h"

#include <cmath>
#include <limits>

namespace clearway {
namespace {

// A text that from_chars understands, but finds out of range.
double OutOfRange(std::string_view text) {
  const bool is_negative = text.starts_with('-');
  // The exponent's sign tells; without an exponent only very long numbers are out of range.
  const std::size_t exponent = text.find_first_of("eE");
  const bool is_small = exponent != std::string_view::npos ? text.substr(exponent + 1, 1) == "-"
                                                           : text.find('.') <= 2;
  const double value = is_small ? 0 : std::numeric_limits<double>::infinity();
  return is_negative ? -value : value;
}

}  // namespace

bool ParseNumber(std::string_view text, double& value) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (rest != end || error == std::errc::invalid_argument) return false;
  if (error == std::errc::result_out_of_range) value = OutOfRange(text);
  return true;
}

}  // namespace clearway
