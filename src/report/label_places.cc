#include "report/label_places.h"

#include <algorithm>

namespace clearway::report {
namespace {

constexpr double kGapPx = 4;  // from what is named
constexpr int kMostLines = 5;

// Touching does not count.
bool Overlap(const Rect& a, const Rect& b) {
  return (a.max().array() > b.min().array()).all() && (b.max().array() > a.min().array()).all();
}

Rect Above(const Rect& named, const Eigen::Vector2d& size, int line) {
  const Eigen::Vector2d bottom_middle(named.center().x(),
                                      named.min().y() - kGapPx - line * size.y());
  const Eigen::Vector2d corner = bottom_middle - Eigen::Vector2d(size.x() / 2, size.y());
  return {corner, corner + size};
}

Rect Below(const Rect& named, const Eigen::Vector2d& size, int line) {
  const Eigen::Vector2d corner(named.center().x() - size.x() / 2,
                               named.max().y() + kGapPx + line * size.y());
  return {corner, corner + size};
}

}  // namespace

// Moved by as little as it takes.
Rect LabelPlaces::InFrame(Rect label) const {
  const Eigen::Vector2d beyond = (label.max() - frame_.max()).cwiseMax(0);
  label.translate(-beyond);
  const Eigen::Vector2d before = (frame_.min() - label.min()).cwiseMax(0);
  return label.translate(before);
}

Rect LabelPlaces::Take(const Rect& named, const Eigen::Vector2d& size) {
  const auto clear = [this](const Rect& label) {
    return std::none_of(taken_.begin(), taken_.end(),
                        [&](const Rect& other) { return Overlap(label, other); });
  };
  for (int line = 0; line < kMostLines; ++line) {
    for (const Rect& wanted : {Above(named, size, line), Below(named, size, line)}) {
      const Rect label = InFrame(wanted);
      if (Overlap(label, named) || !clear(label)) continue;
      return taken_.emplace_back(label);
    }
  }
  return taken_.emplace_back(InFrame(Above(named, size, 0)));
}

bool LabelPlaces::IsFar(const Rect& label, const Rect& named) {
  return label.exteriorDistance(named) > 2 * kGapPx;
}

}  // namespace clearway::report
