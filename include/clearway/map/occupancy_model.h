// The log-odds arithmetic of a map: OctoMap's sensor model in 16-bit fixed point.
#pragma once

#include <algorithm>
#include <cstdint>

#include "absl/status/status.h"

namespace clearway {

// Log-odds in steps of 1 / kLogOddsScale.
using LogOdds = std::int16_t;
inline constexpr int kLogOddsScale = 4096;

// The one pair of conversions between probability (0 to 1, exclusive) and natural log-odds.
double LogOddsOf(double probability);
double ProbabilityOf(double log_odds);

// Rounds to the nearest step; saturates at the 16-bit range (|log-odds| < 8).
LogOdds Quantized(double log_odds);
inline double Dequantized(LogOdds steps) { return static_cast<double>(steps) / kLogOddsScale; }

// Probabilities of the sensor model; OctoMap's defaults.
struct OccupancyProbabilities {
  double hit = 0.7;
  double miss = 0.4;
  double clamp_min = 0.1192;
  double clamp_max = 0.971;
  double occupied = 0.5;  // a voxel at this probability or above is occupied
  bool operator==(const OccupancyProbabilities&) const = default;
};

// The model as the maps use it. A value; equal models make equal maps.
struct OccupancyModel {
  LogOdds hit = 0;
  LogOdds miss = 0;
  LogOdds clamp_min = 0;
  LogOdds clamp_max = 0;
  LogOdds occupied = 0;

  OccupancyModel() : OccupancyModel(OccupancyProbabilities{}) {}
  // Probabilities must pass Validate.
  explicit OccupancyModel(const OccupancyProbabilities& probabilities);

  LogOdds AfterHit(LogOdds value) const {
    return static_cast<LogOdds>(std::min<int>(value + hit, clamp_max));
  }
  LogOdds AfterMiss(LogOdds value) const {
    return static_cast<LogOdds>(std::max<int>(value + miss, clamp_min));
  }
  bool Occupied(LogOdds value) const { return value >= occupied; }
  bool operator==(const OccupancyModel&) const = default;
};

// Requires 0 < clamp_min < 0.5 < clamp_max < 1 within +-8 log-odds, 0 < miss < 0.5 < hit < 1, and
// `occupied` between the clamps; names the field that is wrong.
absl::Status Validate(const OccupancyProbabilities& probabilities);

}  // namespace clearway
