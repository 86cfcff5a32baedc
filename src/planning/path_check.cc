#include "clearway/planning/path_check.h"

#include <algorithm>
#include <iterator>
#include <optional>

namespace clearway {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

void AppendAnswers(const std::vector<StateAnswer>& answers, std::vector<Time> times,
                   const absl::StatusOr<Time>& end, PathCheck& check) {
  times.resize(answers.size(), end.ok() ? *end : Time());
  std::ranges::copy(times, std::back_inserter(check.times));
  std::ranges::copy(answers, std::back_inserter(check.answers));
}

// None unless every answer has one.
std::optional<double> MeanUnknownFraction(const std::vector<StateAnswer>& answers) {
  double sum = 0;
  for (const StateAnswer& answer : answers) {
    if (!answer.unknown_fraction) return std::nullopt;
    sum += *answer.unknown_fraction;
  }
  return sum / static_cast<double>(answers.size());
}

}  // namespace

absl::StatusOr<std::vector<TimedPose>> TimedPoses(const og::PathGeometric& path,
                                                  const StateMapping& mapping) {
  std::vector<TimedPose> poses;
  for (std::size_t i = 0; i < path.getStateCount(); ++i) {
    StateBatch batch;
    const absl::Status status = mapping.Append(path.getState(i), batch);
    if (!status.ok()) return status;
    poses.push_back({batch.times[0], batch.T_W_L[0]});
  }
  return poses;
}

PathCheck CheckPath(const og::PathGeometric& path, const StateQuery& query) {
  PathCheck check;
  for (std::size_t i = 0; i < path.getStateCount(); ++i) {
    const ob::State* state = path.getState(i);
    std::vector<Time> times;
    const std::vector<StateAnswer> answers =
        i == 0 ? std::vector{query.CheckState(state)}
               : query.CheckMotion(path.getState(i - 1), state, &times);
    AppendAnswers(answers, std::move(times), query.mapping().TimeOf(state), check);
  }
  if (check.answers.empty()) return check;
  const auto blocked = std::ranges::find_if(
      check.answers, [](const StateAnswer& a) { return a.status != SpaceStatus::kFree; });
  check.free = blocked == check.answers.end();
  if (!check.free) check.first_blocked = blocked - check.answers.begin();
  check.unknown_fraction = MeanUnknownFraction(check.answers);
  return check;
}

}  // namespace clearway
