// How often predictions keep within their 95 % bounds (PositionBound) on recordings that the bounds
// were not fitted to: each recording is left out in turn, the bounds are fitted to the others by
// the same procedure, and the one left out is predicted. Then the same with the shipped model,
// which is fitted to all of them. A median bound stands beside every share: a wide bound holds
// easily.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "bound_cases.h"
#include "bound_fit.h"
#include "clearway/report/prediction_score.h"
#include "summary.h"
#include "support/data_folder.h"

namespace clearway::bench {
namespace {

using Errors = std::array<PredictionErrors, kBoundAheadCount>;

// Rows of one table, by the name of the row.
using Table = std::map<std::string, Errors>;

// Of one setting.
struct Tables {
  // Simulated worlds are counted in by_recording alone.
  Table all, by_recording, by_class, by_speed, by_age;
};

std::string RangeOf(double value, const std::vector<double>& limits, const char* unit) {
  double from = 0;
  for (const double limit : limits) {
    if (value < limit) return absl::StrCat(from, " to ", limit, unit);
    from = limit;
  }
  return absl::StrCat("from ", from, unit);
}

std::string SpeedOf(const BoundCase& of) {
  if (of.IsFirstSight()) return "unknown (one pose)";
  if (of.AtRest()) return "at rest";
  return RangeOf(of.speed_mps, {0.3, 1, 2, 4, 8, 15}, " m/s");
}

std::string AgeOf(const BoundCase& of) {
  return RangeOf(of.age_s, {0.05, 0.15, 0.35, 0.75, 1.5, 3}, " s");
}

void AddTo(Errors& row, const BoundCase& of, const PositionBound& bound) {
  for (std::size_t i = 0; i < kBoundAheadCount; ++i) {
    if (std::isnan(of.errors_m[i])) continue;
    const double bound_m = bound.At(ToSeconds(kBoundAhead[i]));
    row[i].errors_m.push_back(of.errors_m[i]);
    row[i].bounds_m.push_back(bound_m);
    row[i].within += of.errors_m[i] <= bound_m;
  }
}

void AddRecording(const BoundRecording& recording, const BoundModel& model,
                  std::vector<Tables>& tables) {
  for (const BoundCase& of : recording.cases) {
    const PositionBound bound = BoundOfCase(of, model);
    Tables& of_setting = tables[of.setting];
    AddTo(of_setting.by_recording[recording.name], of, bound);
    if (recording.simulated) continue;
    AddTo(of_setting.all["all recordings"], of, bound);
    AddTo(of_setting.by_class[of.object_class], of, bound);
    AddTo(of_setting.by_speed[SpeedOf(of)], of, bound);
    AddTo(of_setting.by_age[AgeOf(of)], of, bound);
  }
}

void Sort(std::vector<Tables>& tables) {
  for (Tables& of_setting : tables) {
    for (Table* table : {&of_setting.all, &of_setting.by_recording, &of_setting.by_class,
                         &of_setting.by_speed, &of_setting.by_age}) {
      for (auto& [name, row] : *table) {
        for (PredictionErrors& errors : row) {
          std::ranges::sort(errors.errors_m);
          std::ranges::sort(errors.bounds_m);
        }
      }
    }
  }
}

// In Markdown: of each time ahead the share within the bound, its median, and the number.
void Print(const std::string& title, const Table& table) {
  std::printf("\n| %s | 0.5 s | 1 s | 2 s | 3 s | predictions |\n|---|---|---|---|---|---|\n",
              title.c_str());
  for (const auto& [name, row] : table) {
    std::printf("| %s |", name.c_str());
    for (const PredictionErrors& errors : row) {
      if (errors.errors_m.empty()) {
        std::printf(" |");
      } else {
        std::printf(" %.3f (%.2f m) |", errors.Within(), errors.MedianBound());
      }
    }
    std::printf(" %zu to %zu |\n", row.front().errors_m.size(), row.back().errors_m.size());
  }
}

void Print(const std::string& model, const std::vector<Tables>& tables) {
  const auto settings = BoundSettings();
  for (std::size_t i = 0; i < tables.size(); ++i) {
    std::printf("\n%s, %s: share within the bound (median bound)\n", model.c_str(),
                settings[i].name.c_str());
    Print("", tables[i].all);
    Print("class", tables[i].by_class);
    Print("speed", tables[i].by_speed);
    Print("known for", tables[i].by_age);
    Print("recording", tables[i].by_recording);
  }
}

// The numbers of the model fitted to all, and the range of those of which one was left out.
void Print(const BoundModel& all, const std::vector<BoundModel>& folds) {
  std::printf("\n| number | shipped | fitted to all | least | greatest |\n|---|---|---|---|---|\n");
  for (const BoundNumber& number : BoundNumbers()) {
    double least = all.*number.value, greatest = least;
    for (const BoundModel& fold : folds) {
      least = std::min(least, fold.*number.value);
      greatest = std::max(greatest, fold.*number.value);
    }
    std::printf("| %s | %.4g | %.4g | %.4g | %.4g |\n", number.name.c_str(),
                BoundModel{}.*number.value, all.*number.value, least, greatest);
  }
}

// Counters of the summary: shares and median bounds over all recordings, and the least share of a
// class, at any time ahead of which there are more than 500 predictions.
void Count(const std::string& model, const std::vector<Tables>& tables, benchmark::State& state) {
  constexpr std::size_t kEnough = 500;
  const auto settings = BoundSettings();
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const std::string name = absl::StrCat("bound_", model, "_", settings[i].name);
    const Errors& all = tables[i].all.at("all recordings");
    for (std::size_t k = 0; k < kBoundAheadCount; ++k) {
      const std::string ahead = absl::StrCat("_", ToSeconds(kBoundAhead[k]), "s");
      state.counters[name + "_within" + ahead] = all[k].Within();
      state.counters[name + "_median" + ahead + "_m"] = all[k].MedianBound();
    }
    double least = 1;
    for (const auto& [class_name, row] : tables[i].by_class) {
      for (const PredictionErrors& errors : row) {
        if (errors.errors_m.size() > kEnough) least = std::min(least, errors.Within());
      }
    }
    state.counters[name + "_least_of_classes"] = least;
  }
}

// The real ones: simulated objects move as somebody thought they might.
std::vector<const BoundRecording*> Without(const std::vector<BoundRecording>& recordings,
                                           const std::string& group) {
  std::vector<const BoundRecording*> others;
  for (const BoundRecording& recording : recordings) {
    if (recording.group != group && !recording.simulated) others.push_back(&recording);
  }
  return others;
}

void LeaveOneOut(benchmark::State& state) {
  for (auto _ : state) {
    const auto recordings = ReadBoundRecordings();
    if (!recordings.ok()) return state.SkipWithError(recordings.status().ToString().c_str());
    const BoundModel all = FitBounds(Without(*recordings, ""), BoundSearch::kWide, BoundModel{});
    std::vector<Tables> left_out(BoundSettings().size()), shipped = left_out;
    std::vector<BoundModel> folds;
    std::set<std::string> groups;
    for (const BoundRecording& recording : *recordings) groups.insert(recording.group);
    for (const std::string& group : groups) {
      const bool simulated = group.starts_with("sim:");
      folds.push_back(
          simulated ? all : FitBounds(Without(*recordings, group), BoundSearch::kNarrow, all));
      for (const BoundRecording& recording : *recordings) {
        if (recording.group != group) continue;
        AddRecording(recording, folds.back(), left_out);
        AddRecording(recording, BoundModel{}, shipped);
      }
    }
    Sort(left_out);
    Sort(shipped);
    Print("fitted without the recording", left_out);
    Print("as shipped", shipped);
    Print(all, folds);
    Count("left_out", left_out, state);
    Count("shipped", shipped, state);
  }
}

void Register(const Effort& effort) {
  if (!DataFolder()) return;  // it has said so
  Effort once = effort;
  once.repetitions = 1;
  Add("bound_leave_one_out", once, LeaveOneOut);
}

}  // namespace
}  // namespace clearway::bench

int main(int argc, char** argv) {
  return clearway::bench::Main(argc, argv, clearway::bench::Register, {});
}
