#include "soak/memory_trend.h"

namespace clearway::soak {

double GrowthPerHour(const std::vector<MemorySample>& samples) {
  if (samples.size() < 2) return 0;
  const double count = static_cast<double>(samples.size());
  double mean_s = 0, mean_bytes = 0;
  for (const MemorySample& sample : samples) {
    mean_s += sample.at_s / count;
    mean_bytes += static_cast<double>(sample.bytes) / count;
  }
  double products = 0, squares = 0;
  for (const MemorySample& sample : samples) {
    const double dt = sample.at_s - mean_s;
    products += dt * (static_cast<double>(sample.bytes) - mean_bytes);
    squares += dt * dt;
  }
  return squares > 0 ? 3600 * products / squares : 0;
}

}  // namespace clearway::soak
