#include "clearway/planning/path_check.h"

#include <algorithm>
#include <iterator>

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
  for (const StateAnswer& answer : check.answers) check.unknown_fraction += answer.unknown_fraction;
  check.unknown_fraction /= static_cast<double>(check.answers.size());
  return check;
}

}  // namespace clearway
