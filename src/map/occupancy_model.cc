#include "clearway/map/occupancy_model.h"

#include <cmath>

#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"

namespace clearway {
namespace {

absl::Status CheckBetween(const char* field, double value, double low, double high) {
  if (value > low && value < high) return absl::OkStatus();  // false for NaN
  return absl::InvalidArgumentError(absl::StrCat(field, " is ", NumberText(value),
                                                 "; it must be above ", NumberText(low),
                                                 " and below ", NumberText(high)));
}

}  // namespace

double LogOddsOf(double probability) { return std::log(probability / (1.0 - probability)); }

double ProbabilityOf(double log_odds) { return 1.0 / (1.0 + std::exp(-log_odds)); }

LogOdds Quantized(double log_odds) {
  return static_cast<LogOdds>(std::clamp(std::round(log_odds * kLogOddsScale), -32767.0, 32767.0));
}

OccupancyModel::OccupancyModel(const OccupancyProbabilities& p)
    : hit(Quantized(LogOddsOf(p.hit))),
      miss(Quantized(LogOddsOf(p.miss))),
      clamp_min(Quantized(LogOddsOf(p.clamp_min))),
      clamp_max(Quantized(LogOddsOf(p.clamp_max))),
      occupied(Quantized(LogOddsOf(p.occupied))) {}

absl::Status Validate(const OccupancyProbabilities& p) {
  constexpr double kLowest = 0.0004, kHighest = 0.9996;  // log-odds -7.8 and 7.8
  for (const absl::Status& status :
       {CheckBetween("probability_hit", p.hit, 0.5, kHighest),
        CheckBetween("probability_miss", p.miss, kLowest, 0.5),
        CheckBetween("clamp_min", p.clamp_min, kLowest, 0.5),
        CheckBetween("clamp_max", p.clamp_max, 0.5, kHighest),
        CheckBetween("occupied_threshold", p.occupied, p.clamp_min, p.clamp_max)}) {
    if (!status.ok()) return status;
  }
  return absl::OkStatus();
}

}  // namespace clearway
