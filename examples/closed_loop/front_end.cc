#include "closed_loop/front_end.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace clearway::closed_loop {

FrontEnd::FrontEnd(Simulation simulation, Duration motion_over)
    : simulation_(std::move(simulation)), motion_over_(motion_over) {}

Frame FrontEnd::Scan(const Pose& T_W_S, std::size_t k) {
  Frame frame = simulation_.MakeFrameFrom(T_W_S, k);
  frame.motions.clear();
  for (const ObjectId id : std::set<ObjectId>(frame.labels.begin(), frame.labels.end())) {
    if (id == kStaticLabel) continue;
    std::vector<std::size_t>& seen = seen_[id];
    if (!seen.empty()) {
      const ObjectMotion motion = MotionTo(k, id, seen);
      const Eigen::AngleAxisd turn(motion.H_W.rotation);
      // After a gap it may have turned so far that nobody could tell which way round.
      if (std::abs(turn.angle()) < kMaxTurn_rad) frame.motions.push_back(motion);
    }
    seen.push_back(k);
  }
  return frame;
}

// From the first scan that saw it within motion_over_; after a gap, from the last one before.
ObjectMotion FrontEnd::MotionTo(std::size_t k, ObjectId id,
                                const std::vector<std::size_t>& seen) const {
  const Time earliest = simulation_.StampOf(k) - motion_over_;
  const auto within = std::ranges::find_if(
      seen, [&](std::size_t frame) { return simulation_.StampOf(frame) >= earliest; });
  const std::size_t from = within == seen.end() ? seen.back() : *within;
  const Pose H_W =
      *simulation_.ReportedT_W_B(id, k) * Inverse(*simulation_.ReportedT_W_B(id, from));
  return {id, H_W, simulation_.StampOf(from)};
}

}  // namespace clearway::closed_loop
