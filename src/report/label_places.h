// Where labels go on a map.
#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace clearway::report {

using Rect = Eigen::AlignedBox2d;  // pixels, x to the right and y down

// Finds room for one label after the other, inside a frame and clear of those before. One thread.
class LabelPlaces {
 public:
  explicit LabelPlaces(const Rect& frame) : frame_(frame) {}

  // No label shall cover this.
  void KeepClear(const Rect& rect) { taken_.push_back(rect); }

  // Room for a label of this size near what it names, which must meet the frame: above it, else
  // below it, else a few lines farther. Where no place is clear, above it all the same.
  Rect Take(const Rect& named, const Eigen::Vector2d& size);

  // Whether it is so far from what it names that one could take it for another's.
  static bool IsFar(const Rect& label, const Rect& named);

 private:
  Rect InFrame(Rect label) const;

  Rect frame_;
  std::vector<Rect> taken_;
};

}  // namespace clearway::report
