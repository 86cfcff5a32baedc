// What clearway evaluate finds, and how it tells it.
#pragma once

#include <array>
#include <chrono>
#include <map>
#include <optional>
#include <ostream>
#include <vector>

#include "clearway/report/prediction_score.h"
#include "clearway/report/surface_judge.h"
#include "cli/truth_source.h"

namespace clearway::cli {

// How far ahead predictions are judged.
inline constexpr std::array kAhead = {
    std::chrono::milliseconds(500), std::chrono::milliseconds(1000),
    std::chrono::milliseconds(2000), std::chrono::milliseconds(3000)};

struct Evaluation {
  std::map<ObjectId, std::vector<PredictionErrors>> predictions;  // by kAhead
  // Where the true surfaces are known: of simulations.
  std::map<ObjectId, ObjectFit> fits;
  std::map<ObjectId, std::vector<SolidOverlap>> solids;  // by kAhead
  std::optional<StaticFit> static_fit;
};

void PrintText(std::ostream& out, const TrueSource& source, const Evaluation& found);
void PrintJson(std::ostream& out, const TrueSource& source, const Evaluation& found);

}  // namespace clearway::cli
