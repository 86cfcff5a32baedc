#include "clearway/sim/wrong_labels.h"

#include <set>
#include <vector>

#include "sim/random.h"

namespace clearway {

Frame WithWrongLabels(Frame frame, double share, std::uint64_t seed) {
  std::set<ObjectId> of_points(frame.labels.begin(), frame.labels.end());
  of_points.erase(kIgnoreLabel);
  const std::vector<ObjectId> labels(of_points.begin(), of_points.end());
  if (labels.size() < 2) return frame;
  constexpr std::uint64_t kStream = std::uint64_t{1} << 62;
  Random random(seed, kStream, frame.sequence);
  for (std::size_t i = 0; i < frame.labels.size(); ++i) {
    const bool returned = frame.no_return.empty() || frame.no_return[i] == 0;
    if (random.Uniform() >= share || frame.labels[i] == kIgnoreLabel || !returned) continue;
    // One of the others: the last one stands for the point's own.
    const auto drawn =
        static_cast<std::size_t>(random.Uniform() * static_cast<double>(labels.size() - 1));
    frame.labels[i] = labels[drawn] == frame.labels[i] ? labels.back() : labels[drawn];
  }
  return frame;
}

}  // namespace clearway
