// What clearway evaluate says of predictions.
#pragma once

#include <ostream>

#include "cli/evaluation.h"

namespace clearway::cli {

// Distances, turns, and whether the stated bounds held.
void PrintPredictions(std::ostream& out, const TrueSource& source, const Evaluation& found);
// Solids against the true ones.
void PrintSolids(std::ostream& out, const TrueSource& source, const Evaluation& found);

}  // namespace clearway::cli
