// How far away the points of each label are.
#pragma once

#include <algorithm>
#include <limits>

#include "base/lanes.h"
#include "clearway/scene/frame.h"

namespace clearway {

// Of some points, between which ranges those of a few groups of labels lie. A value.
class LabelRanges {
 public:
  void Add(ObjectId label, float range_m) {
    const int group = GroupOf(label);
    const int least = group + kGroups;
    ranges_m_[group] = std::max(ranges_m_[group], range_m);
    ranges_m_[least] = std::max(ranges_m_[least], -range_m);
    labels_[group] = std::max(labels_[group], label);
    labels_[least] = std::max(labels_[least], ~label);
  }
  void Add(const LabelRanges& other) {
    ranges_m_ = other.ranges_m_ > ranges_m_ ? other.ranges_m_ : ranges_m_;
    labels_ = other.labels_ > labels_ ? other.labels_ : labels_;
  }

  // False only if no point of another label lies between the two ranges.
  bool MayHaveOther(ObjectId label, float from_m, float to_m) const {
    for (int group = 0; group < kGroups; ++group) {
      const bool has_other = labels_[group] > label || ~labels_[group + kGroups] < label;
      const bool meets = ranges_m_[group] >= from_m && -ranges_m_[group + kGroups] <= to_m;
      if (has_other && meets) return true;
    }
    return false;
  }

 private:
  static constexpr int kGroups = kLanes / 2;
  // What is static is alone in its group.
  static int GroupOf(ObjectId label) {
    return label == kStaticLabel ? 0 : 1 + static_cast<int>(static_cast<unsigned>(label) % 3);
  }

  // Of each group the most, then of each the least: negative, so that it is a most, too.
  LaneFloats ranges_m_ = LaneFloats{} - std::numeric_limits<float>::infinity();
  LaneInts labels_ = LaneInts{} + std::numeric_limits<std::int32_t>::min();
};

}  // namespace clearway
