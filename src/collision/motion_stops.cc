#include "collision/motion_stops.h"

#include <algorithm>
#include <vector>

#include "collision/unknown_share.h"

namespace clearway {

MotionStops::MotionStops(const MotionContext& context)
    : context_(context),
      scene_(context.check.scene),
      options_(context.check.options),
      bounds_W_(scene_.params.bounds_W) {
  const double limit_m = scene_.static_map_W.grid().limit_m();
  bounds_W_.min = bounds_W_.min.cwiseMax(-limit_m);
  bounds_W_.max = bounds_W_.max.cwiseMin(limit_m);
}

void MotionStops::Begin(const MotionLeg& leg) {
  leg_ = &leg;
  unknown_step_ = std::max(leg.shortest, leg.longest / 16);
}

MotionStop MotionStops::First(const TimeSpan& span) {
  MotionStop stop;
  for (const MovingPart& part : leg_->parts) {
    const MovingPart::Passage passage = part.During(span);
    StopAtStatic(part, passage, stop);
    if (!scene_.objects.empty()) StopAtObjects(part, passage, stop);
  }
  if (options_.unknown == UnknownPolicy::kTolerated) StopAtUnknownShare(span, stop);
  return stop;
}

void MotionStops::StopAtStatic(const MovingPart& part, const MovingPart::Passage& passage,
                               MotionStop& stop) const {
  const auto [bare, slack_m] = part.InWorld(passage, 0);
  stop.Add(LeaveBounds(bounds_W_, bare).share, slack_m);
  Sweep sweep = bare;
  sweep.margin_m += options_.padding_m;
  const VoxelMap& map_W = scene_.static_map_W;
  if (!Allowed(part.link(), kStaticLabel)) {
    for (const Aabb& box_W : scene_.params.keep_out_W) {
      stop.Add(TouchBox(box_W, sweep, stop.until()).share, slack_m);
    }
    stop.Add(TouchOccupied(map_W, sweep, stop.until()).share, slack_m);
  }
  if (options_.unknown != UnknownPolicy::kBlocked) return;
  stop.Add(
      TouchUnobserved(map_W, options_.known_free_W, sweep, stop.until(), context_.check.cancelled)
          .share,
      slack_m);
}

// Goes on by short steps from where unknown space is touched first, as long as the robot never lies
// in more of it than is tolerated.
void MotionStops::StopAtUnknownShare(const TimeSpan& span, MotionStop& stop) {
  MotionStop touched = stop;
  for (const MovingPart& part : leg_->parts) {
    const auto [bare, slack_m] = part.InWorld(part.During(span), 0);
    const FirstTouch touch = TouchUnobserved(scene_.static_map_W, options_.known_free_W, bare,
                                             touched.until(), context_.check.cancelled);
    touched.Add(touch.share, slack_m);
  }
  const Time until = stop.share >= 1 ? span.until : span.At(stop.share);
  const Duration least = std::max(Duration(1), leg_->shortest / 2);
  for (Time t = span.At(touched.until()); touched.share < stop.share && t < until;) {
    const TimeSpan step{t, std::min(until, t + unknown_step_)};
    if (MostUnknownShare(step) <= options_.max_unknown_fraction) {
      t = step.until;
      unknown_step_ = std::min(2 * unknown_step_, leg_->longest);
    } else if (unknown_step_ <= least || context_.check.cancelled()) {
      const auto all = static_cast<double>((span.until - span.from).count());
      stop = {static_cast<double>((t - span.from).count()) / all, 0};
      return;
    } else {
      unknown_step_ = std::max(least, std::min(unknown_step_, step.until - step.from) / 2);
    }
  }
}

double MotionStops::MostUnknownShare(const TimeSpan& span) const {
  std::vector<Sweep> sweeps;
  for (const MovingPart& part : leg_->parts) {
    sweeps.push_back(part.InWorld(part.During(span), 0).sweep);
  }
  return MostUnknownShareOf(scene_.static_map_W, options_.known_free_W, sweeps,
                            context_.check.cancelled);
}

void MotionStops::StopAtObjects(const MovingPart& part, const MovingPart::Passage& passage,
                                MotionStop& stop) const {
  const Aabb box_W = part.InWorld(passage, options_.padding_m).sweep.Box();
  MovingBall ball = part.BallAround(passage, options_.padding_m + kTouching_m);
  ball.from = context_.WorldTime(ball.from);
  ball.until = context_.WorldTime(ball.until);
  context_.index.ForEachNear(box_W, ball.from, ball.until, options_.growth(), [&](std::size_t i) {
    const MovingObject& object = *scene_.objects[i];
    if (IsIgnored(object, options_) || Allowed(part.link(), object.id)) return;
    if (!context_.index.MayMeet(i, ball, options_.growth())) return;
    StopAtObject(part, passage, i, stop);
  });
}

ObjectPiece MotionStops::PieceOf(const MovingObject& object, Time from, Time until) const {
  const Duration horizon = scene_.params.horizon;
  const std::optional<Time>& at = context_.options.world_at;
  return at ? HeldAt(object, *at, until, horizon) : PieceFrom(object, from, until, horizon);
}

void MotionStops::StopAtObject(const MovingPart& part, const MovingPart::Passage& passage,
                               std::size_t i, MotionStop& stop) const {
  const TimeSpan& span = passage.span;
  const MovingObject& object = *scene_.objects[i];
  const auto all = static_cast<double>((span.until - span.from).count());
  for (Time from = span.from; from < span.until;) {
    const ObjectPiece piece = PieceOf(object, from, span.until);
    const TimeSpan during{from, piece.until};
    const double begins = static_cast<double>((from - span.from).count()) / all;
    const double lasts = static_cast<double>((piece.until - from).count()) / all;
    from = piece.until;
    const double until = std::min(1.0, (stop.until() - begins) / lasts);
    if (until < 0) return;
    const double margin_m =
        options_.padding_m + InflationOf(object, context_.WorldTime(during.until), options_);
    const bool all_of_it = during.from == span.from && during.until == span.until;
    const MovingPart::Passage meanwhile = all_of_it ? passage : part.During(during);
    if (piece.beyond_horizon) {
      const auto [sweep, slack_m] = part.InWorld(meanwhile, margin_m);
      const FirstTouch touch =
          TouchBall(piece.T_W_O.translation, piece.RadiusAt(during.until), sweep, until);
      stop.Add(begins + lasts * touch.share, slack_m);
      continue;
    }
    if (object.solid->box_O.Empty()) continue;
    const auto [sweep, slack_m] = part.InObject(meanwhile, piece, margin_m);
    const ShapeGeometry* const solid = context_.solids[i].get();
    const FirstTouch touch = solid != nullptr ? TouchShape(*solid, sweep, until)
                                              : TouchOccupied(object.map_O, sweep, until);
    stop.Add(begins + lasts * touch.share, slack_m);
  }
}

bool MotionStops::Allowed(int link, ObjectId object) const {
  return context_.check.allowed_contacts.contains({link, object});
}

}  // namespace clearway
