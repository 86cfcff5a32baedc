#include "bound_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clearway::bench {
namespace {

// Of a recording and a setting.
constexpr std::size_t kMaxCases = 150;
// Smaller errors count as this: they matter to nobody.
constexpr double kLeast_m = 0.02;
// Share of the predictions to keep within their bounds. Above 0.95 for objects in motion: a new
// recording differs from those that are known.
constexpr double kShareInMotion = 0.97, kShareElse = 0.95;

struct WeightedCase {
  const BoundCase* of;
  double weight;
};

// Evenly spaced ones that `wanted` accepts.
std::vector<WeightedCase> Sampled(const std::vector<const BoundRecording*>& recordings,
                                  const std::function<bool(const BoundCase&)>& wanted) {
  std::vector<WeightedCase> sampled;
  for (const BoundRecording* recording : recordings) {
    for (std::size_t setting = 0; setting < BoundSettings().size(); ++setting) {
      std::vector<const BoundCase*> cases;
      std::size_t all = 0;
      for (const BoundCase& of : recording->cases) {
        if (of.setting != setting) continue;
        ++all;
        if (wanted(of)) cases.push_back(&of);
      }
      const std::size_t stride = 1 + cases.size() / kMaxCases;
      for (std::size_t i = 0; i < cases.size(); i += stride) {
        sampled.push_back({cases[i], static_cast<double>(stride) / static_cast<double>(all)});
      }
    }
  }
  return sampled;
}

// The quantile loss (also called pinball loss) of the errors' logarithms, so that decimetres of
// pedestrians count like metres of cars.
double Loss(const std::vector<WeightedCase>& cases, double share, const BoundModel& model) {
  double loss = 0, weight = 0;
  for (const WeightedCase& weighted : cases) {
    const PositionBound bound = BoundOfCase(*weighted.of, model);
    for (std::size_t i = 0; i < kBoundAheadCount; ++i) {
      const double error_m = weighted.of->errors_m[i];
      if (std::isnan(error_m)) continue;
      const double over = std::log(std::max(error_m, kLeast_m) /
                                   std::max(bound.At(ToSeconds(kBoundAhead[i])), kLeast_m));
      loss += weighted.weight * (over > 0 ? share * over : (share - 1) * over);
      weight += weighted.weight;
    }
  }
  return loss / weight;
}

// The numbers that fit best to those cases; the others stay.
BoundModel FitNumbers(const std::vector<BoundNumber>& numbers,
                      const std::vector<WeightedCase>& cases, double share, BoundSearch search,
                      const BoundModel& start) {
  if (cases.empty()) return start;
  const auto model_of = [&](const std::vector<double>& logs) {
    BoundModel model = start;
    for (std::size_t i = 0; i < numbers.size(); ++i) model.*numbers[i].value = std::exp(logs[i]);
    return model;
  };
  std::vector<double> logs;
  for (const BoundNumber& number : numbers) logs.push_back(std::log(start.*number.value));
  const auto loss = [&](const std::vector<double>& at) { return Loss(cases, share, model_of(at)); };
  const int evaluations = 45 * static_cast<int>(numbers.size());
  if (search == BoundSearch::kWide) logs = Minimize(loss, logs, 0.4, 2 * evaluations);
  return model_of(Minimize(loss, logs, 0.2, evaluations));
}

std::vector<BoundNumber> NumbersInMotion() {
  return {{"factor", &BoundModel::factor},
          {"prior_count", &BoundModel::prior_count},
          {"near_prior_count", &BoundModel::near_prior_count},
          {"late_weight", &BoundModel::late_weight},
          {"soon_weight", &BoundModel::soon_weight},
          {"unknown_jitter_m", &BoundModel::unknown_jitter_m},
          {"jitter_gain", &BoundModel::jitter_gain},
          {"jitter_rate_gain", &BoundModel::jitter_rate_gain},
          {"response_s", &BoundModel::response_s},
          {"speed_accel_mps2", &BoundModel::speed_accel_mps2},
          {"turn_gain", &BoundModel::turn_gain}};
}

std::vector<BoundNumber> NumbersAtRest() {
  return {{"rest_factor", &BoundModel::rest_factor},
          {"rest_prior_count", &BoundModel::rest_prior_count},
          {"rest_jitter_gain", &BoundModel::rest_jitter_gain},
          {"rest_drift_mps", &BoundModel::rest_drift_mps}};
}

std::vector<BoundNumber> NumbersAtFirstSight() {
  return {{"unknown_mps", &BoundModel::unknown_mps}};
}

}  // namespace

std::vector<BoundNumber> BoundNumbers() {
  std::vector<BoundNumber> numbers = NumbersInMotion();
  for (const auto& more : {NumbersAtRest(), NumbersAtFirstSight()}) {
    numbers.insert(numbers.end(), more.begin(), more.end());
  }
  return numbers;
}

PositionBound BoundOfCase(const BoundCase& of, const BoundModel& model) {
  const Evidence& evidence = of.evidence;
  return BoundBy(evidence.misses, evidence.has_motion, evidence.velocity_O, evidence.of_last_motion,
                 model);
}

BoundModel FitBounds(const std::vector<const BoundRecording*>& recordings, BoundSearch search,
                     const BoundModel& start) {
  const auto in_motion =
      Sampled(recordings, [](const BoundCase& of) { return !of.IsFirstSight() && !of.AtRest(); });
  const auto at_rest = Sampled(recordings, [](const BoundCase& of) { return of.AtRest(); });
  const auto at_first = Sampled(recordings, [](const BoundCase& of) { return of.IsFirstSight(); });
  BoundModel model = FitNumbers(NumbersInMotion(), in_motion, kShareInMotion, search, start);
  model = FitNumbers(NumbersAtRest(), at_rest, kShareElse, search, model);
  return FitNumbers(NumbersAtFirstSight(), at_first, kShareElse, search, model);
}

std::vector<double> Minimize(const std::function<double(const std::vector<double>&)>& loss,
                             const std::vector<double>& start, double step, int evaluations) {
  struct Vertex {
    double loss;
    std::vector<double> at;
    bool operator<(const Vertex& other) const { return loss < other.loss; }
  };
  const std::size_t size = start.size();
  const auto vertex = [&](std::vector<double> at) {
    --evaluations;
    const double value = loss(at);
    return Vertex{value, std::move(at)};
  };
  std::vector<Vertex> simplex = {vertex(start)};
  for (std::size_t i = 0; i < size; ++i) {
    std::vector<double> at = start;
    at[i] += step;
    simplex.push_back(vertex(std::move(at)));
  }
  while (evaluations > 0) {
    std::ranges::stable_sort(simplex, {}, &Vertex::loss);
    Vertex& worst = simplex.back();
    std::vector<double> center(size, 0);
    for (std::size_t v = 0; v < size; ++v) {
      for (std::size_t i = 0; i < size; ++i) center[i] += simplex[v].at[i] / size;
    }
    // Along the line from the worst vertex through the others' centre.
    const auto along = [&](double share) {
      std::vector<double> at(size);
      for (std::size_t i = 0; i < size; ++i) at[i] = center[i] + share * (center[i] - worst.at[i]);
      return vertex(std::move(at));
    };
    Vertex reflected = along(1);
    if (reflected < simplex.front()) {
      Vertex expanded = along(2);
      worst = expanded < reflected ? std::move(expanded) : std::move(reflected);
    } else if (reflected < simplex[size - 1]) {
      worst = std::move(reflected);
    } else if (Vertex contracted = along(-0.5); contracted < worst) {
      worst = std::move(contracted);
    } else {
      for (std::size_t v = 1; v < simplex.size(); ++v) {
        for (std::size_t i = 0; i < size; ++i) {
          simplex[v].at[i] = 0.5 * (simplex[v].at[i] + simplex.front().at[i]);
        }
        simplex[v] = vertex(std::move(simplex[v].at));
      }
    }
  }
  return std::ranges::min_element(simplex, {}, &Vertex::loss)->at;
}

}  // namespace clearway::bench
