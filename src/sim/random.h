// Random numbers that are the same with every standard library.
#pragma once

#include <cstdint>
#include <random>

namespace clearway {

// A stream of random numbers. One thread at a time. std::mt19937_64 is fixed by the standard, but
// std::normal_distribution is not, so the distributions are written out here.
class Random {
 public:
  // Streams of one seed with different (stream, index) are independent of each other.
  Random(std::uint64_t seed, std::uint64_t stream, std::uint64_t index = 0);

  double Uniform();  // in (0, 1)
  double Normal();   // mean 0, standard deviation 1

 private:
  std::mt19937_64 engine_;
  double spare_ = 0;
  bool has_spare_ = false;
};

}  // namespace clearway
