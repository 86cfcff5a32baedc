// Fits BoundModel to predictions by quantile regression.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bound_cases.h"

namespace clearway::bench {

// One number of the model.
struct BoundNumber {
  std::string name;
  double BoundModel::*value;
};
// All that are fitted.
std::vector<BoundNumber> BoundNumbers();

PositionBound BoundOfCase(const BoundCase& of, const BoundModel& model);

// Whether the search begins with large steps, or close to a model that is nearly right.
enum class BoundSearch { kWide, kNarrow };

// The model whose bounds minimise the quantile loss over those recordings, found from `start` by
// Nelder and Mead's method on the logarithms of its numbers. A recording counts as much as any
// other, however long it is: the next one is drawn among recordings. Deterministic.
BoundModel FitBounds(const std::vector<const BoundRecording*>& recordings, BoundSearch search,
                     const BoundModel& start);

// The minimum of a function near `start`: J. A. Nelder, R. Mead, "A Simplex Method for Function
// Minimization", The Computer Journal 7, 1965.
std::vector<double> Minimize(const std::function<double(const std::vector<double>&)>& loss,
                             const std::vector<double>& start, double step, int evaluations);

}  // namespace clearway::bench
