#include "cli/prediction_text.h"

#include <numbers>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "clearway/report/table.h"
#include "cli/text.h"

namespace clearway::cli {
namespace {

// Two columns for each time ahead.
std::vector<std::string> HeaderBy(const std::string& second) {
  std::vector<std::string> header = {"id", "what"};
  for (const Duration ahead : kAhead) {
    header.push_back(absl::StrCat(ToSeconds(ahead), " s"));
    header.push_back(second);
  }
  return header;
}

void PrintDistances(std::ostream& out, const TrueSource& source, const Evaluation& found) {
  out << "How far from its true place each object is predicted, in metres: median, and what 95 % "
         "of the\npredictions do not exceed.\n\n";
  std::vector<std::string> header = HeaderBy("95 %");
  header.insert(header.begin() + 2, "predictions");
  Table table(header);
  for (const auto& [id, of_object] : found.predictions) {
    std::vector<std::string> row = {absl::StrCat(id), NameOf(source, id),
                                    absl::StrCat(of_object[0].errors_m.size())};
    for (const PredictionErrors& e : of_object) {
      row.push_back(FixedOrDash(e.Median(), 2));
      row.push_back(FixedOrDash(e.Quantile(kMost), 2));
    }
    table.AddRow(row);
  }
  out << table.ToString();
}

void PrintTurns(std::ostream& out, const TrueSource& source, const Evaluation& found) {
  constexpr double kDegrees = 180 / std::numbers::pi;
  out << "\nBy how much it is turned from how it is predicted, in degrees: median, and what 95 % "
         "do not exceed.\n\n";
  Table table(HeaderBy("95 %"));
  for (const auto& [id, of_object] : found.predictions) {
    std::vector<std::string> row = {absl::StrCat(id), NameOf(source, id)};
    for (const PredictionErrors& e : of_object) {
      row.push_back(FixedOrDash(kDegrees * e.TurnQuantile_rad(0.5), 1));
      row.push_back(FixedOrDash(kDegrees * e.TurnQuantile_rad(kMost), 1));
    }
    table.AddRow(row);
  }
  out << table.ToString();
}

void PrintBounds(std::ostream& out, const TrueSource& source, const Evaluation& found) {
  out << "\nHow far it was said to be at most, 95 times of 100, in metres: median; and how often "
         "it was no\nfarther.\n\n";
  Table table(HeaderBy("within"));
  const auto add = [&](const std::string& id, const std::string& name,
                       const std::vector<PredictionErrors>& errors) {
    std::vector<std::string> row = {id, name};
    for (const PredictionErrors& e : errors) {
      row.push_back(FixedOrDash(e.MedianBound(), 2));
      row.push_back(FixedOrDash(e.Within(), 3));
    }
    table.AddRow(row);
  };
  for (const auto& [id, of_object] : found.predictions) {
    add(absl::StrCat(id), NameOf(source, id), of_object);
  }
  if (!found.predictions.empty()) add("", "all", Together(found.predictions));
  out << table.ToString();
}

}  // namespace

void PrintPredictions(std::ostream& out, const TrueSource& source, const Evaluation& found) {
  PrintDistances(out, source, found);
  PrintTurns(out, source, found);
  PrintBounds(out, source, found);
}

void PrintSolids(std::ostream& out, const TrueSource& source, const Evaluation& found) {
  out << "\nHow well the solids that are predicted agree with the true ones to within a voxel: "
         "F-scores. Of a true\none has to be found what lies in the hull of the points measured; "
         "in the last row all, seen or not.\n";
  if (!source.simulation) out << "The true ones are the recorded boxes.\n";
  out << "\n";
  std::vector<std::string> header = {"id", "what"};
  for (const Duration ahead : kAhead) header.push_back(absl::StrCat(ToSeconds(ahead), " s"));
  Table table(header);
  const auto add = [&](const std::string& id, const std::string& name,
                       const std::vector<SolidOverlap>& overlaps,
                       double (SolidOverlap::*score)() const) {
    std::vector<std::string> row = {id, name};
    for (const SolidOverlap& overlap : overlaps) row.push_back(FixedOrDash((overlap.*score)(), 3));
    table.AddRow(row);
  };
  for (const auto& [id, overlaps] : found.solids) {
    add(absl::StrCat(id), NameOf(source, id), overlaps, &SolidOverlap::FScore);
  }
  const std::vector<SolidOverlap> all = Together(found.solids);
  add("", "all", all, &SolidOverlap::FScore);
  add("", "all, whole", all, &SolidOverlap::WholeFScore);
  out << table.ToString();
}

}  // namespace clearway::cli
