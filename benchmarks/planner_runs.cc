#include "planner_runs.h"

#include <ompl/base/MotionValidator.h>
#include <ompl/tools/benchmark/Benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "clearway/planning/space_time.h"

namespace clearway::bench {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using Clock = std::chrono::steady_clock;

// Another validator, until a time; then nothing is valid.
class UntilDeadline : public ob::MotionValidator {
 public:
  UntilDeadline(const ob::SpaceInformationPtr& si, ob::MotionValidatorPtr inner)
      : ob::MotionValidator(si), inner_(std::move(inner)) {}
  bool checkMotion(const ob::State* from, const ob::State* to) const override {
    return Clock::now() < deadline && inner_->checkMotion(from, to);
  }
  bool checkMotion(const ob::State* from, const ob::State* to,
                   std::pair<ob::State*, double>& last_valid) const override {
    return Clock::now() < deadline && inner_->checkMotion(from, to, last_valid);
  }

  Clock::time_point deadline = Clock::time_point::max();

 private:
  ob::MotionValidatorPtr inner_;
};

double ArrivalOf(const og::PathGeometric& path) {
  return SpaceTimeStateSpace::SecondsOf(path.getState(path.getStateCount() - 1));
}

double SecondsSince(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

}  // namespace

std::vector<PlannerRun> RunPlanner(og::SimpleSetup& setup, const ob::PlannerPtr& planner,
                                   double budget_s, unsigned int runs,
                                   const std::filesystem::path& log, const std::string& name,
                                   const std::function<void(const og::PathGeometric&)>& solved) {
  const ob::SpaceInformationPtr si = setup.getSpaceInformation();
  const ob::MotionValidatorPtr inner = si->getMotionValidator();
  const auto validator = std::make_shared<UntilDeadline>(si, inner);
  // Where the space information's own validator is looked for, the planner that proves finds it.
  const bool proves = planner->getName() == "SafeInterval";
  if (!proves) si->setMotionValidator(validator);
  std::vector<PlannerRun> results;
  Clock::time_point begin;
  double first_s = 0;
  const ob::ProblemDefinitionPtr problem = setup.getProblemDefinition();
  problem->setIntermediateSolutionCallback(
      [&](const ob::Planner*, const std::vector<const ob::State*>&, ob::Cost) {
        if (first_s == 0) first_s = SecondsSince(begin);
      });
  ompl::tools::Benchmark benchmark(setup, name);
  benchmark.addPlanner(planner);
  benchmark.setPreRunEvent([&](const ob::PlannerPtr&) {
    first_s = 0;
    begin = Clock::now();
    constexpr double kGrace_s = 0.5;
    validator->deadline = begin + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(budget_s + kGrace_s));
  });
  benchmark.setPostRunEvent([&](const ob::PlannerPtr&, auto& properties) {
    PlannerRun& run = results.emplace_back();
    run.solved = problem->hasExactSolution();
    run.first_s = first_s > 0 ? first_s : SecondsSince(begin);
    if (!run.solved) return;
    const auto& path = *problem->getSolutionPath()->template as<og::PathGeometric>();
    run.arrival_s = ArrivalOf(path);
    properties["time to first solution REAL"] = std::to_string(run.first_s);
    properties["arrival REAL"] = std::to_string(run.arrival_s);
    solved(path);
  });
  ompl::tools::Benchmark::Request request(budget_s, 4096, runs);
  request.displayProgress = false;
  request.saveConsoleOutput = false;
  request.simplify = false;
  benchmark.benchmark(request);
  std::filesystem::create_directories(log.parent_path());
  benchmark.saveResultsToFile(log.c_str());
  problem->setIntermediateSolutionCallback({});
  si->setMotionValidator(inner);
  return results;
}

// The k-th smallest and largest of n hold the median between them with 1 - 2 P(fewer than k of n
// tosses are heads).
MedianInterval MedianOf(std::vector<double> values) {
  constexpr double kOutside = 0.01;
  if (values.empty()) {
    const double none = std::numeric_limits<double>::infinity();
    return {none, none, none};
  }
  std::ranges::sort(values);
  const std::size_t n = values.size();
  std::size_t k = 0;  // of the values below the interval
  double below = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double chosen = std::lgamma(n + 1.0) - std::lgamma(i + 1.0) - std::lgamma(n - i + 1.0);
    below += std::exp(chosen - static_cast<double>(n) * std::log(2.0));
    if (2 * below > kOutside) break;
    k = i + 1;
  }
  const double median = 0.5 * (values[(n - 1) / 2] + values[n / 2]);
  const std::size_t low = k > 0 ? k - 1 : 0;
  return {median, values[low], values[n - 1 - low]};
}

}  // namespace clearway::bench
