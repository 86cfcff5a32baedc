// OMPL's own benchmark, of planners in space-time.
#pragma once

#include <ompl/geometric/SimpleSetup.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace clearway::bench {

struct PlannerRun {
  bool solved = false;
  double first_s = 0;    // until the first solution
  double arrival_s = 0;  // of the best at the end
};

// Runs the planner so often, each time anew for so long, and writes OMPL's log of it, which Planner
// Arena plots. `solved(path)` is called with the best path of each run that found one. A planner
// that does not come back when its time is up finds no motion valid any more.
std::vector<PlannerRun> RunPlanner(
    ompl::geometric::SimpleSetup& setup, const ompl::base::PlannerPtr& planner, double budget_s,
    unsigned int runs, const std::filesystem::path& log, const std::string& name,
    const std::function<void(const ompl::geometric::PathGeometric&)>& solved);

// The median of some values and an interval that holds it with a probability of 0.99 whatever their
// distribution (by order statistics).
struct MedianInterval {
  double median, low, high;
};
MedianInterval MedianOf(std::vector<double> values);

}  // namespace clearway::bench
