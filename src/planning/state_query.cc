#include "clearway/planning/state_query.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "absl/strings/str_cat.h"
#include "clearway/planning/space_time.h"

namespace clearway {
namespace {

namespace ob = ompl::base;

StateAnswer OutOfBounds() {
  StateAnswer answer;
  answer.status = SpaceStatus::kOutOfBounds;
  return answer;
}

// A state of `space`, freed at the end of the scope.
class ScratchState {
 public:
  explicit ScratchState(const ob::StateSpace& space) : space_(space), state_(space.allocState()) {}
  ~ScratchState() { space_.freeState(state_); }
  ScratchState(const ScratchState&) = delete;
  ScratchState& operator=(const ScratchState&) = delete;
  ob::State* get() const { return state_; }

 private:
  const ob::StateSpace& space_;
  ob::State* state_;
};

}  // namespace

StateQuery::StateQuery(ob::StateSpacePtr space, std::shared_ptr<const StateChecker> checker,
                       StateMapping mapping, PlanningOptions options)
    : space_(std::move(space)),
      checker_(std::move(checker)),
      mapping_(std::move(mapping)),
      options_(std::move(options)),
      clearance_options_(options_.check),
      motion_options_(MotionOptionsOf(options_)) {
  clearance_options_.clearance_up_to_m = options_.clearance_up_to_m;
}

StateAnswer StateQuery::CheckState(const ob::State* state) const {
  return CheckOne(state, options_.check);
}

StateAnswer StateQuery::CheckClearance(const ob::State* state) const {
  return CheckOne(state, clearance_options_);
}

StateAnswer StateQuery::CheckOne(const ob::State* state, const CheckOptions& options) const {
  if (!space_->satisfiesBounds(state)) return OutOfBounds();
  StateBatch batch;
  const absl::Status status = mapping_.Append(state, batch);
  if (!status.ok()) return Unresolved(1, status)[0];
  return Answer(batch, options)[0];
}

std::vector<StateAnswer> StateQuery::CheckPlace(const ob::State* state,
                                                const std::vector<double>& seconds) const {
  const ScratchState scratch(*space_);
  space_->copyState(scratch.get(), state);
  StateBatch batch;
  for (const double at_s : seconds) {
    SpaceTimeStateSpace::SetSeconds(scratch.get(), at_s);
    const absl::Status status = mapping_.Append(scratch.get(), batch);
    if (!status.ok()) return Unresolved(seconds.size(), status);
  }
  return Answer(batch, options_.check);
}

std::vector<StateAnswer> StateQuery::CheckMotion(const ob::State* from, const ob::State* to,
                                                 std::vector<Time>* times) const {
  if (const auto* space_time = dynamic_cast<const SpaceTimeStateSpace*>(space_.get());
      space_time != nullptr && !space_time->CanReach(from, to)) {
    return {StateAnswer{}};  // an answer, not a failure: planners propose such motions
  }
  const double steps = StepCount(from, to);
  if (!(steps <= options_.max_states_per_motion)) {
    return Unresolved(1, absl::ResourceExhaustedError(
                             absl::StrCat("motion: needs ", steps, " states, above the limit of ",
                                          options_.max_states_per_motion)));
  }
  const int n = static_cast<int>(steps);
  const ScratchState scratch(*space_);
  StateBatch batch;
  int within = 0;  // bounds are convex: once out of them, a motion that began within stays out
  for (int i = 1; i <= n; ++i) {
    space_->interpolate(from, to, static_cast<double>(i) / n, scratch.get());
    const ob::State* state = i == n ? to : scratch.get();
    const absl::Status status = mapping_.Append(state, batch);
    if (!status.ok()) return Unresolved(1, status);
    if (within == i - 1 && space_->satisfiesBounds(state)) within = i;
  }
  if (times != nullptr) *times = batch.times;
  std::vector<StateAnswer> answers = Answer(batch, options_.check);
  std::fill(answers.begin() + within, answers.end(), OutOfBounds());
  return answers;
}

MotionProof StateQuery::ProveMotion(const ob::State* from, const ob::State* to) const {
  if (const auto* space_time = dynamic_cast<const SpaceTimeStateSpace*>(space_.get());
      space_time != nullptr && !space_time->CanReach(from, to)) {
    return {};  // an answer, not a failure: planners propose such motions
  }
  MotionProof proof;
  // The longer legs are, the farther links may stray from them.
  for (const double leg_m : {2 * options_.step_m, 0.25 * options_.step_m}) {
    absl::StatusOr<MotionBatch> motion = MotionOf(from, to, leg_m);
    if (!motion.ok()) {
      CountError(motion.status());
      return proof;
    }
    const auto strays = [](double deviation_m) { return deviation_m > 0; };
    const bool closer_may_help = std::ranges::any_of(motion->deviations_m, strays);
    proof = Prove(*std::move(motion));
    if (proof.answer.status == SpaceStatus::kFree || !closer_may_help) break;
  }
  if (const double within = FractionWithinBounds(from, to); within < proof.free_fraction) {
    proof.free_fraction = within;
    proof.answer = {SpaceStatus::kOutOfBounds, proof.answer.free_until, std::nullopt};
  }
  return proof;
}

absl::StatusOr<MotionBatch> StateQuery::MotionOf(const ob::State* from, const ob::State* to,
                                                 double leg_m) const {
  const double legs = mapping_.LegCount(*space_, from, to, leg_m);
  if (!(legs < options_.max_states_per_motion)) {
    return absl::ResourceExhaustedError(absl::StrCat("motion: needs ", legs,
                                                     " legs, above the limit of ",
                                                     options_.max_states_per_motion, " states"));
  }
  const int n = static_cast<int>(legs);
  const std::size_t links = checker_->robot().links.size();
  const ScratchState before(*space_), state(*space_);
  MotionBatch motion;
  StateBatch states;
  for (int i = 0; i <= n; ++i) {
    if (i > 0) space_->copyState(before.get(), state.get());
    space_->interpolate(from, to, static_cast<double>(i) / n, state.get());
    if (auto status = mapping_.Append(state.get(), states); !status.ok()) return status;
    if (i == 0) continue;
    mapping_.AppendDeviations(before.get(), state.get(), std::span(states.T_W_L).last(2 * links),
                              motion.deviations_m);
  }
  motion.deviations_m.resize(states.T_W_L.size(), 0);  // those of the last knot do not matter
  motion.knot_counts = {states.times.size()};
  motion.times = std::move(states.times);
  motion.T_W_L = std::move(states.T_W_L);
  return motion;
}

MotionProof StateQuery::Prove(MotionBatch motion) const {
  MotionOptions options = motion_options_;
  const auto not_later = [](Time a, Time b) { return b <= a; };
  if (std::ranges::adjacent_find(motion.times, not_later) != motion.times.end()) {
    options.world_at = motion.times[0];  // no time passes
    for (std::size_t k = 0; k < motion.times.size(); ++k) {
      motion.times[k] = Time() + k * Duration(std::chrono::seconds(1));
    }
  }
  absl::StatusOr<MotionReply> reply = checker_->CheckMotions(motion, options);
  if (reply.ok() && reply->answers.size() != 1) {
    reply = absl::InternalError(
        absl::StrCat("checker: ", reply->answers.size(), " answers to one motion"));
  }
  if (reply.ok() && reply->version != checker_->version()) reply = WrongVersion(reply->version);
  if (!reply.ok()) {
    CountError(reply.status());
    return {};
  }
  const MotionAnswer& answer = reply->answers[0];
  if (answer.status == SpaceStatus::kFree) return {answer, 1};
  const double most = std::nextafter(1.0, 0.0);
  const double fraction = ToSeconds(answer.free_until - motion.times.front()) /
                          ToSeconds(motion.times.back() - motion.times.front());
  return {answer, std::clamp(fraction, 0.0, most)};
}

// Bounds are convex: once out of them, a motion that began within stays out.
double StateQuery::FractionWithinBounds(const ob::State* from, const ob::State* to) const {
  if (space_->satisfiesBounds(to)) return 1;
  const ScratchState scratch(*space_);
  double within = 0, beyond = 1;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (within + beyond);
    space_->interpolate(from, to, middle, scratch.get());
    (space_->satisfiesBounds(scratch.get()) ? within : beyond) = middle;
  }
  return within;
}

absl::Status StateQuery::first_error() const {
  std::lock_guard lock(mutex_);
  return first_error_;
}

std::vector<StateAnswer> StateQuery::Answer(const StateBatch& batch,
                                            const CheckOptions& options) const {
  const std::size_t size = batch.times.size();
  absl::StatusOr<CheckReply> reply = checker_->Check(batch, options);
  if (!reply.ok()) return Unresolved(size, reply.status());
  if (reply->answers.size() != size) {
    return Unresolved(size, absl::InternalError(absl::StrCat("checker: ", reply->answers.size(),
                                                             " answers to ", size, " states")));
  }
  if (reply->version != checker_->version()) return Unresolved(size, WrongVersion(reply->version));
  return std::move(reply->answers);
}

std::vector<StateAnswer> StateQuery::Unresolved(std::size_t size, const absl::Status& why) const {
  CountError(why);
  return std::vector<StateAnswer>(size);
}

absl::Status StateQuery::WrongVersion(std::uint64_t answered) const {
  return absl::InternalError(
      absl::StrCat("checker: answered on version ", answered, ", pinned is ", checker_->version()));
}

void StateQuery::CountError(const absl::Status& why) const {
  error_count_.fetch_add(1);
  std::lock_guard lock(mutex_);
  if (first_error_.ok()) first_error_ = why;
}

double StateQuery::StepCount(const ob::State* from, const ob::State* to) const {
  const std::optional<double> bound_m = mapping_.MotionBoundMetres(from, to);
  double steps = bound_m ? std::ceil(*bound_m / options_.step_m)
                         : static_cast<double>(space_->validSegmentCount(from, to));
  if (mapping_.has_time()) {
    const double seconds =
        SpaceTimeStateSpace::SecondsOf(to) - SpaceTimeStateSpace::SecondsOf(from);
    steps = std::max(steps, std::ceil(seconds / ToSeconds(options_.time_step)));
  }
  return std::isnan(steps) ? steps : std::max(steps, 1.0);
}

}  // namespace clearway
