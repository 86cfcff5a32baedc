#include "planning/timed_checks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "clearway/planning/space_information.h"

namespace clearway {
namespace {

namespace ob = ompl::base;

// How often at first, and how finely at last, it is looked whether something that passes is gone.
constexpr double kLookAgain_s = 0.3, kGoneWithin_s = 0.1;
// Later it is looked again after this part of what it has been there for. At places more often than
// on ways: of a place the answer is kept, of ways others are asked about, at other times.
constexpr double kOfWhatPassedAtPlaces = 1.0 / 64, kOfWhatPassedOnWays = 1.0 / 8;
// At last this part of these times.
constexpr double kFinest = 1.0 / 16;
// The same where hardly a gap is to be missed, for how long, and at how many times at once.
constexpr double kLookClosely_s = 0.02, kGoneWithinClosely_s = 1e-3, kClosely_s = 3600;
constexpr std::size_t kMostLooks = 1024;
// Without proofs: how finely the end of a wait is looked for.
constexpr double kWaitWithin_s = 0.02;

}  // namespace

TimedChecks::TimedChecks(const ob::SpaceInformationPtr& si)
    : si_(si),
      space_(si->getStateSpace()->as<SpaceTimeStateSpace>()),
      query_(QueryOf(*si)),
      first_(si->allocState()),
      second_(si->allocState()),
      latest_s_(space_->latest_s()) {}

TimedChecks::~TimedChecks() {
  si_->freeState(first_);
  si_->freeState(second_);
}

double TimedChecks::FreeUntil(const ob::State* part, double from_s, double until_s) {
  space_->space()->copyState(SpaceTimeStateSpace::SpacePart(first_), part);
  space_->space()->copyState(SpaceTimeStateSpace::SpacePart(second_), part);
  if (query_ == nullptr) return WaitByHalves(from_s, until_s);
  SpaceTimeStateSpace::SetSeconds(first_, from_s);
  SpaceTimeStateSpace::SetSeconds(second_, until_s);
  const MotionProof proof = query_->ProveMotion(first_, second_);
  return proof.free() ? until_s : from_s + proof.free_fraction * (until_s - from_s);
}

bool TimedChecks::IsFree(double begin_s, double end_s) {
  SpaceTimeStateSpace::SetSeconds(first_, begin_s);
  SpaceTimeStateSpace::SetSeconds(second_, end_s);
  return si_->checkMotion(first_, second_);
}

// Doubles the wait while it is free, then halves what may be added.
double TimedChecks::WaitByHalves(double from_s, double until_s) {
  SpaceTimeStateSpace::SetSeconds(first_, from_s);
  if (!si_->isValid(first_)) return from_s;
  double free_s = from_s, more_s = 1;
  while (free_s < until_s && more_s > kWaitWithin_s) {
    const double next_s = std::min(until_s, free_s + more_s);
    const bool free = IsFree(free_s, next_s);
    if (free) free_s = next_s;
    more_s = free ? 2 * more_s : std::min(more_s, next_s - free_s) / 2;
  }
  return free_s;
}

double TimedChecks::FreeFrom(const ob::State* part, double at_s) {
  if (query_ == nullptr) return at_s;
  space_->space()->copyState(SpaceTimeStateSpace::SpacePart(first_), part);
  const Looks looks = LookAt({at_s});
  if (looks.free) return at_s;
  if (looks.forever) return std::numeric_limits<double>::infinity();
  return FreeAgain(at_s, latest_s_, kOfWhatPassedAtPlaces);
}

bool TimedChecks::LookFiner() {
  if (coarseness_ <= kFinest) return false;
  coarseness_ /= 2;
  return true;
}

double TimedChecks::FreeFromClosely(const ob::State* part, double at_s, double until_s,
                                    const std::function<bool()>& cancelled) {
  space_->space()->copyState(SpaceTimeStateSpace::SpacePart(first_), part);
  const double from_s = at_s, closely_until_s = std::min(until_s, at_s + kClosely_s);
  std::vector<double> looks_s;
  std::size_t most = 1;
  for (bool more = true; more; most = std::min(2 * most, kMostLooks)) {
    if (query_ == nullptr) most = 1;  // many at once take no less
    for (looks_s.clear(); more && looks_s.size() < most;) {
      looks_s.push_back(at_s);
      more = at_s < closely_until_s;
      at_s = std::min(at_s + kLookClosely_s, closely_until_s);
    }
    const Looks looks = LookAt(looks_s);
    if (looks.free && looks_s[*looks.free] == from_s) return from_s;
    if (looks.free)
      return FreeWithin(looks_s[*looks.free] - kLookClosely_s, looks_s[*looks.free],
                        kGoneWithinClosely_s);
    if (looks.unsure) return looks_s.front();
    if (looks.forever) return std::numeric_limits<double>::infinity();
    if (cancelled()) return at_s;
  }
  return FreeAgain(closely_until_s, until_s, kOfWhatPassedAtPlaces);
}

TimedChecks::Looks TimedChecks::LookAt(const std::vector<double>& seconds) {
  Looks looks;
  if (query_ == nullptr) {
    const auto free = std::ranges::find_if(seconds, [&](double at_s) { return IsFreeAt(at_s); });
    if (free != seconds.end()) looks.free = free - seconds.begin();
    return looks;
  }
  const std::vector<StateAnswer> answers = query_->CheckPlace(first_, seconds);
  const auto find = [&](SpaceStatus status) {
    return std::ranges::find(answers, status, &StateAnswer::status);
  };
  const auto free = find(SpaceStatus::kFree);
  if (free != answers.end()) looks.free = free - answers.begin();
  looks.unsure = find(SpaceStatus::kUnresolved) != answers.end();
  looks.forever = answers[0].status == SpaceStatus::kOccupied && answers[0].object == kStaticLabel;
  return looks;
}

WayAnswer TimedChecks::Way(const ob::State* from_part, const ob::State* to_part, double begin_s,
                           double end_s) {
  ++ways_asked_;
  space_->space()->copyState(SpaceTimeStateSpace::SpacePart(first_), from_part);
  space_->space()->copyState(SpaceTimeStateSpace::SpacePart(second_), to_part);
  if (query_ == nullptr) {
    if (IsFree(begin_s, end_s)) return {true, false, begin_s};
    return {false, false, begin_s + kLookAgain_s};
  }
  SpaceTimeStateSpace::SetSeconds(first_, begin_s);
  SpaceTimeStateSpace::SetSeconds(second_, end_s);
  const MotionProof proof = query_->ProveMotion(first_, second_);
  if (proof.free()) return {true, false, begin_s};
  const auto& witness = proof.answer.witness;
  if (!witness) return {false, false, begin_s + kLookAgain_s};
  if (witness->object == kStaticLabel) return {false, true, 0};
  const absl::StatusOr<Time> begin = query_->mapping().TimeOf(first_);
  if (!begin.ok()) return {false, true, 0};
  const double after_s = ToSeconds(witness->until - *begin);
  const double share = end_s > begin_s ? after_s / (end_s - begin_s) : 0;
  space_->interpolate(first_, second_, std::clamp(share, 0.0, 1.0), first_);
  return {false, false, FreeAgain(begin_s + after_s, latest_s_, kOfWhatPassedOnWays) - after_s};
}

bool TimedChecks::IsFreeAt(double seconds) {
  if (query_ == nullptr) {
    SpaceTimeStateSpace::SetSeconds(first_, seconds);
    return si_->isValid(first_);
  }
  return query_->CheckPlace(first_, {seconds})[0].status == SpaceStatus::kFree;
}

// Something is in the way at that place and time: when is it gone? What is free for less than the
// time between two looks may be missed.
double TimedChecks::FreeAgain(double blocked_s, double until_s, double of_what_passed) {
  double there_s = blocked_s, gone_s = blocked_s;
  while (gone_s == blocked_s) {
    if (there_s >= until_s) return std::numeric_limits<double>::infinity();
    const double wait_s =
        coarseness_ * std::max(kLookAgain_s, of_what_passed * (there_s - blocked_s));
    const double look_s = std::min(there_s + wait_s, until_s);
    (IsFreeAt(look_s) ? gone_s : there_s) = look_s;
  }
  return FreeWithin(there_s, gone_s, coarseness_ * kGoneWithin_s);
}

// From when on it is free, nearly: at the first time it is not.
double TimedChecks::FreeWithin(double there_s, double gone_s, double within_s) {
  while (gone_s - there_s > within_s) {
    const double middle_s = 0.5 * (there_s + gone_s);
    (IsFreeAt(middle_s) ? gone_s : there_s) = middle_s;
  }
  return gone_s;
}

}  // namespace clearway
