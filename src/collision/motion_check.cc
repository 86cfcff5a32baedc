#include "collision/motion_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace clearway {
namespace {

// A first guess of what a sweep may be: longer ones look at more of the map than they pass.
constexpr double kLongest_m = 3;
constexpr double kLooseBy_m = 0.15;
// One that stands still may be any length, and meets what comes by in that time.
constexpr std::chrono::seconds kFirst{2};
// How much shorter than the resolution of contacts spans may get, and how many a leg may take.
constexpr int kFiner = 64, kMostSpans = 10'000;

Duration Seconds(double seconds) {
  constexpr double kLongest_s = 1e9;
  return std::max(Duration(1), FromSeconds(std::min(seconds, kLongest_s)));
}

}  // namespace

MotionCheck::MotionCheck(const MotionContext& context, const RobotGeometry& robot)
    : context_(context),
      scene_(context.check.scene),
      options_(context.check.options),
      robot_(robot),
      states_(context.check, robot),
      stops_(context) {}

void MotionCheck::Answer(std::span<const Time> times, const Pose* T_W_L, const double* deviations_m,
                         MotionAnswer& answer) {
  const std::size_t links = robot_.links().size();
  answer = {};
  answer.free_until = times.front();
  for (std::size_t k = 0; k + 1 < times.size(); ++k) {
    SetLeg({times[k], times[k + 1]}, T_W_L + k * links, T_W_L + (k + 1) * links,
           deviations_m == nullptr ? nullptr : deviations_m + k * links);
    if (!Prove(answer)) return;
  }
  answer.status = SpaceStatus::kFree;
}

void MotionCheck::SetLeg(const TimeSpan& span, const Pose* from_T_W_L, const Pose* until_T_W_L,
                         const double* deviations_m) {
  const std::size_t links = robot_.links().size();
  leg_.span = span;
  leg_.links.clear();
  leg_.parts.clear();
  for (std::size_t link = 0; link < links; ++link) {
    leg_.links.emplace_back(from_T_W_L[link], until_T_W_L[link], span.seconds());
  }
  for (std::size_t link = 0; link < links; ++link) {
    const double deviation_m = deviations_m == nullptr ? 0 : deviations_m[link];
    for (const RobotGeometry::Part& part : robot_.links()[link]) {
      leg_.parts.emplace_back(static_cast<int>(link), leg_.links[link], span, part, deviation_m);
    }
  }
  leg_.longest = LongestSpan();
  leg_.shortest = ShortestSpan();
}

// Where a span's sweeps stop, contact may be near: looks at single states tell, which cost far less
// than sweeps, and then no span need go beyond it.
bool MotionCheck::Prove(MotionAnswer& answer) {
  const Duration longest = leg_.longest, shortest = leg_.shortest;
  stops_.Begin(leg_);
  const Duration least = std::max(Duration(1), shortest / kFiner);
  Duration length = std::min<Duration>(longest, kFirst);
  Time end = leg_.span.until;  // or the earliest contact that is known
  for (int spans = 0; answer.free_until < end && spans < kMostSpans; ++spans) {
    const TimeSpan span{answer.free_until, std::min(end, answer.free_until + length)};
    const MotionStop stop = stops_.First(span);
    if (context_.check.cancelled()) return false;
    if (stop.share == kNever) {
      answer.free_until = span.until;
      length = std::min(2 * length, longest);
      continue;
    }
    answer.free_until = span.At(stop.share);
    end = EarliestContact(span, stop.slack_m, end, answer);
    if (answer.witness && end - answer.free_until <= shortest) break;
    if (span.until - span.from <= least && stop.share < 0.5) break;
    // The rest of the way to a contact is short already.
    const bool rest = answer.witness && (stop.share > 0.5 || end < span.until);
    length = rest ? end - answer.free_until : std::max(least, (span.until - span.from) / 4);
  }
  if (answer.witness) {
    answer.witness->from = answer.free_until;
    answer.witness->voxel = TouchedVoxel(end, StateAt(end));
  }
  return !answer.witness && answer.free_until == leg_.span.until;
}

// From what is proved free on, for a sweep of that slack stopped there: the state may be in contact
// as soon as it has made up for the slack. Returns `end` if nothing earlier is known.
Time MotionCheck::EarliestContact(const TimeSpan& span, double slack_m, Time end,
                                  MotionAnswer& answer) {
  const Duration shortest = leg_.shortest;
  const double shorts = 1 + 2 * slack_m / context_.options.contact_resolution_m;
  const Time from = answer.free_until;
  std::array<Time, 4> looks{from, from + shortest, from + Seconds(shorts * ToSeconds(shortest)),
                            from};
  // Too much unknown space may be in the robot for a moment alone.
  if (options_.unknown == UnknownPolicy::kTolerated) looks[3] = span.until;
  Time contact = end;
  for (const Time look : looks) {
    const Time t = std::min(end, look);
    if ((answer.witness && t == end) || !InContact(t, answer)) continue;
    contact = t;
    break;
  }
  if (!answer.witness) return end;
  for (Time free = from; contact - free > shortest;) {
    const Time middle = free + (contact - free) / 2;
    (InContact(middle, answer) ? contact : free) = middle;
  }
  return contact;
}

Duration MotionCheck::LongestSpan() const {
  double seconds = std::numeric_limits<double>::infinity();
  for (const MovingPart& part : leg_.parts) {
    seconds =
        std::min({seconds, 2 * kLooseBy_m / part.turning_mps(), kLongest_m / part.center_mps()});
  }
  return Seconds(seconds);
}

Duration MotionCheck::ShortestSpan() const {
  double fastest_mps = 0;
  for (const MovingPart& part : leg_.parts) {
    fastest_mps = std::max(fastest_mps, part.center_mps() + part.turning_mps());
  }
  if (!context_.options.world_at) {
    fastest_mps += context_.index.FastestMps(leg_.span.until, options_.growth());
  }
  return Seconds(context_.options.contact_resolution_m / fastest_mps);
}

StateAnswer MotionCheck::StateAt(Time t) {
  const double fraction = ToSeconds(t - leg_.span.from) / leg_.span.seconds();
  T_W_L_.clear();
  for (const LinkMotion& motion : leg_.links) T_W_L_.push_back(motion.At(fraction));
  StateAnswer answer;
  states_.Answer(context_.WorldTime(t), T_W_L_.data(), answer);
  return answer;
}

bool MotionCheck::InContact(Time t, MotionAnswer& answer) {
  const StateAnswer state = StateAt(t);
  if (state.status == SpaceStatus::kFree) return false;
  answer.status = state.status;
  answer.witness = MotionWitness{t, t, state.link, state.object, std::nullopt};
  return true;
}

std::optional<VoxelKey> MotionCheck::TouchedVoxel(Time t, const StateAnswer& state) const {
  if (state.link < 0 || state.status == SpaceStatus::kOutOfBounds) return std::nullopt;
  const MovingObject* const object = scene_.FindObject(state.object);
  for (const auto& [geometry, T_L_G] : robot_.links()[state.link]) {
    const Pose T_W_G = T_W_L_[state.link] * T_L_G.value_or(Pose{});
    Sweep here{PlacedShape(geometry, T_W_G), Eigen::Vector3d::Zero(), options_.padding_m};
    FirstTouch touch;
    if (object != nullptr) {
      const PredictedPose at = PredictPose(*object, context_.WorldTime(t), scene_.params.horizon);
      if (at.beyond_horizon_radius_m || object->FillsSolid(scene_.params.solid)) continue;
      here.shape_F = here.shape_F.In(Inverse(at.T_W_O));
      here.margin_m += InflationOf(*object, context_.WorldTime(t), options_);
      touch = TouchOccupied(object->map_O, here, 1);
    } else if (state.status == SpaceStatus::kOccupied) {
      touch = TouchOccupied(scene_.static_map_W, here, 1);
    } else {
      touch = TouchUnobserved(scene_.static_map_W, options_.known_free_W, here, 1,
                              context_.check.cancelled);
    }
    if (touch.voxel) return touch.voxel;
  }
  return std::nullopt;
}

}  // namespace clearway
