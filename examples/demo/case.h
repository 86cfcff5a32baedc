// One problem from its statement to the verdict.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "demo/place.h"

namespace clearway::demo {

// How a crossing was driven. A plain value.
struct DriveLog {
  std::size_t scans = 0, decisions = 0, plans = 0, evasions = 0;
  double slowest_decision_s = 0;  // of this computer's clock
  bool arrived = false;
  bool cut_off = false;  // the recording ended meanwhile
};

// What came of a problem. Everything from `crossing` on is there as far as the case got.
struct CaseResult {
  std::string name;
  std::vector<std::string> void_places;  // why each place tried before was no case
  double margin_m = 0;                   // that the robot was to keep clear of everything
  std::optional<Crossing> crossing;
  Verdict straight;
  std::vector<TimedPose> straight_way;
  std::optional<Plan> plan;
  double planning_s = 0;          // of this computer's clock
  std::optional<DriveLog> drive;  // if it was driven: the plan's path is what was driven
  Verdict verdict;
  std::string problem;  // why there is no plan; empty if there is one

  // From the newest frame to the arrival.
  double ArrivalSeconds() const;
  // Whether the plan arrives in time and touches nothing on its way, as far as it is known.
  bool Passed() const;
  // Whether what really happened is known up to the arrival.
  bool KnownToTheEnd() const;
  // One sentence for people.
  std::string Conclusion() const;
};

// A problem at a place. A plain value.
struct PosedCase {
  CaseResult result;           // as far as it got
  std::optional<Place> place;  // none: the case is void, and its `problem` says so
};

// Takes the first place that poses the problem on the server's version of `scene`; see ChoosePlace.
// An error is the server's.
absl::StatusOr<PosedCase> PoseCase(const std::shared_ptr<Connection>& connection,
                                   const SceneSnapshot& scene, const ScenePtr& hindsight,
                                   const Problem& problem, const Truth& truth,
                                   const PlanSettings& settings);

// Plans there once, and judges the plan by what really happened. An error is the server's.
absl::StatusOr<CaseResult> PlanCase(PosedCase posed, const Truth& truth,
                                    const PlanSettings& settings);

// The picture of a case.
absl::Status DrawCase(const SceneSnapshot& scene, const CaseResult& result,
                      const Sequence& sequence, const std::string& file);

}  // namespace clearway::demo
