#include "sim/random.h"

#include <cmath>
#include <numbers>

namespace clearway {
namespace {

// SplitMix64, Steele, Lea, Flood, "Fast Splittable Pseudorandom Number Generators", 2014.
std::uint64_t Mix(std::uint64_t value) {
  value += 0x9e3779b97f4a7c15ULL;
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9ULL;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebULL;
  return value ^ (value >> 31);
}

}  // namespace

Random::Random(std::uint64_t seed, std::uint64_t stream, std::uint64_t index)
    : engine_(Mix(Mix(Mix(seed) ^ stream) ^ index)) {}

double Random::Uniform() { return (static_cast<double>(engine_() >> 11) + 0.5) * 0x1p-53; }

// Box and Muller, "A Note on the Generation of Random Normal Deviates", 1958.
double Random::Normal() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }
  const double radius = std::sqrt(-2 * std::log(Uniform()));
  const double angle = 2 * std::numbers::pi * Uniform();
  spare_ = radius * std::sin(angle);
  has_spare_ = true;
  return radius * std::cos(angle);
}

}  // namespace clearway
