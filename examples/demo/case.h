// One problem from its statement to the verdict.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clearway/client/connection.h"
#include "demo/plan.h"
#include "demo/sequence.h"

namespace clearway::demo {

// What came of a problem. Everything from `crossing` on is there as far as the case got.
struct CaseResult {
  std::string name;
  std::vector<std::string> void_places;  // why each place tried before was no case
  double margin_m = 0;                   // that the robot was to keep clear of everything
  std::optional<Crossing> crossing;
  Verdict straight;
  std::vector<TimedPose> straight_way;
  std::optional<Plan> plan;
  double planning_s = 0;  // of this computer's clock
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

// Takes the first place that poses the problem: the straight way at full speed touches something
// that moves, and the static map leaves room. Plans there on the
// server's version `version`, and judges the plan by what really happened. An error is the
// server's.
absl::StatusOr<CaseResult> RunCase(std::shared_ptr<Connection> connection,
                                   const SceneSnapshot& scene, const Problem& problem,
                                   const Truth& truth, const PlanSettings& settings);

// The picture of a case.
absl::Status DrawCase(const SceneSnapshot& scene, const CaseResult& result,
                      const Sequence& sequence, const std::string& file);

}  // namespace clearway::demo
