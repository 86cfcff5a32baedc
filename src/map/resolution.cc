#include "clearway/map/resolution.h"

#include <algorithm>
#include <cmath>

namespace clearway {

bool SameResolution(double one_m, double other_m) {
  const double larger_m = std::max(one_m, other_m);
  const double last_digit_m = std::pow(10, std::floor(std::log10(larger_m)) - 5);
  // Half of it is lost by rounding; a little more, for that half is rounded, too.
  return std::abs(one_m - other_m) <= 0.5001 * last_digit_m;
}

}  // namespace clearway
