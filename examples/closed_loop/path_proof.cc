#include "closed_loop/path_proof.h"

namespace clearway::closed_loop {
namespace {

void AppendKnot(const Carrier& carrier, const TimedPath::Knot& knot, MotionBatch& motions) {
  motions.times.push_back(knot.time);
  motions.T_W_L.push_back(carrier.LinkPose(knot.p_W));
}

void AppendMotion(const Carrier& carrier, const TimedPath& path, Time from, Time until,
                  MotionBatch& motions) {
  const std::size_t before = motions.times.size();
  AppendKnot(carrier, {from, path.At(from)}, motions);
  for (const TimedPath::Knot& knot : path.knots()) {
    if (knot.time > from && knot.time < until) AppendKnot(carrier, knot, motions);
  }
  AppendKnot(carrier, {until, path.At(until)}, motions);
  motions.knot_counts.push_back(motions.times.size() - before);
}

}  // namespace

std::vector<Time> FreeUntil(const StateChecker& checker, const Carrier& carrier,
                            const std::vector<TimedPath>& paths, Time from, Time until,
                            const CheckOptions& options) {
  MotionBatch motions;
  for (const TimedPath& path : paths) AppendMotion(carrier, path, from, until, motions);
  // Where it is a matter of contact a few centimetres are as good as one.
  const auto reply =
      checker.CheckMotions(motions, {.check = options, .contact_resolution_m = 0.05});
  if (!reply.ok()) return std::vector<Time>(paths.size(), from);
  std::vector<Time> free_until;
  for (const MotionAnswer& answer : reply->answers) {
    free_until.push_back(answer.status == SpaceStatus::kFree ? until : answer.free_until);
  }
  return free_until;
}

}  // namespace clearway::closed_loop
