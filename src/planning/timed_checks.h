// What the search in space-time asks about places and times.
#pragma once

#include <ompl/base/SpaceInformation.h>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "clearway/planning/space_time.h"
#include "clearway/planning/state_query.h"

namespace clearway {

// The answer about a way from one place to another that begins at some time.
struct WayAnswer {
  bool free = false;
  bool never = false;       // whenever it begins: something that stands still is in the way
  double not_before_s = 0;  // if neither: it is not worth trying to begin earlier than then
};

// Asks about waits and ways, at times in seconds of the space. One thread.
class TimedChecks {
 public:
  explicit TimedChecks(const ompl::base::SpaceInformationPtr& si);
  ~TimedChecks();
  TimedChecks(const TimedChecks&) = delete;
  TimedChecks& operator=(const TimedChecks&) = delete;

  // From `from_s` on the robot can wait at the place up to the time returned; `from_s` or less if
  // it cannot even be there.
  double FreeUntil(const ompl::base::State* part, double from_s, double until_s);
  // Not before then it is worth trying to be at the place: at `at_s`, if nothing is known to be in
  // the way there; infinity, if something is seen to be in the way from then on.
  double FreeFrom(const ompl::base::State* part, double at_s);
  // The same, looked at every 20 ms for an hour: hardly a gap is missed. Where it is cancelled or
  // the checker fails: what was found by then.
  double FreeFromClosely(const ompl::base::State* part, double at_s, double until_s,
                         const std::function<bool()>& cancelled);
  WayAnswer Way(const ompl::base::State* from_part, const ompl::base::State* to_part,
                double begin_s, double end_s);
  std::size_t ways_asked() const { return ways_asked_; }
  // From now on it is looked twice as often whether something that passes is gone. False if it is
  // looked as often as is worth while.
  bool LookFiner();

 private:
  bool IsFree(double begin_s, double end_s);  // from first_ to second_
  double WaitByHalves(double from_s, double until_s);
  // What is seen of a place at some times.
  struct Looks {
    std::optional<std::size_t> free;  // the first that found nothing in the way
    bool unsure = false;              // of some there is no answer
    bool forever = false;             // what stands still is in the way
  };
  Looks LookAt(const std::vector<double>& seconds);                           // at first_
  bool IsFreeAt(double seconds);                                              // the same
  double FreeAgain(double blocked_s, double until_s, double of_what_passed);  // the same
  double FreeWithin(double there_s, double gone_s, double within_s);          // the same

  ompl::base::SpaceInformationPtr si_;
  const SpaceTimeStateSpace* space_;
  const StateQuery* query_;             // or null
  ompl::base::State *first_, *second_;  // owned
  double latest_s_;
  std::size_t ways_asked_ = 0;
  double coarseness_ = 1;  // of looks whether something that passes is gone
};

}  // namespace clearway
