#include "cli/evaluation.h"

#include <cmath>
#include <string>

#include "absl/strings/str_cat.h"
#include "clearway/report/table.h"
#include "cli/json.h"
#include "cli/text.h"

namespace clearway::cli {
namespace {

constexpr double kMost = 0.95;  // the share whose error is told beside the median

std::string NameOf(const TrueSource& source, ObjectId id) {
  const auto name = source.names.find(id);
  return name == source.names.end() ? "" : name->second;
}

std::string TextOf(double value, int digits) {
  return std::isnan(value) ? "-" : Fixed(value, digits);
}

void PrintPredictions(std::ostream& out, const TrueSource& source, const Evaluation& found) {
  out << "How far from its true place each object is predicted, in metres: median, and what 95 % "
         "of "
         "the\npredictions do not exceed.\n\n";
  std::vector<std::string> header = {"id", "what", "predictions"};
  for (const Duration ahead : kAhead) {
    header.push_back(absl::StrCat(ToSeconds(ahead), " s"));
    header.push_back("95 %");
  }
  Table table(header);
  for (const auto& [id, of_object] : found.predictions) {
    std::vector<std::string> row = {absl::StrCat(id), NameOf(source, id),
                                    absl::StrCat(of_object[0].errors_m.size())};
    for (const PredictionErrors& e : of_object) {
      row.push_back(TextOf(e.Median(), 2));
      row.push_back(TextOf(e.Quantile(kMost), 2));
    }
    table.AddRow(row);
  }
  out << table.ToString();
}

// All together; empty without any.
std::vector<PredictionErrors> Together(
    const std::map<ObjectId, std::vector<PredictionErrors>>& predictions) {
  std::vector<PredictionErrors> all;
  for (const auto& [id, of_object] : predictions) {
    all.resize(of_object.size());
    for (std::size_t i = 0; i < of_object.size(); ++i) {
      all[i].ahead = of_object[i].ahead;
      all[i] += of_object[i];
    }
  }
  return all;
}

void PrintBounds(std::ostream& out, const TrueSource& source, const Evaluation& found) {
  out << "\nHow far it was said to be at most, 95 times of 100, in metres: median; and how often "
         "it was no\nfarther.\n\n";
  std::vector<std::string> header = {"id", "what"};
  for (const Duration ahead : kAhead) {
    header.push_back(absl::StrCat(ToSeconds(ahead), " s"));
    header.push_back("within");
  }
  Table table(header);
  const auto add = [&](const std::string& id, const std::string& name,
                       const std::vector<PredictionErrors>& errors) {
    std::vector<std::string> row = {id, name};
    for (const PredictionErrors& e : errors) {
      row.push_back(TextOf(e.MedianBound(), 2));
      row.push_back(TextOf(e.Within(), 3));
    }
    table.AddRow(row);
  };
  for (const auto& [id, of_object] : found.predictions) {
    add(absl::StrCat(id), NameOf(source, id), of_object);
  }
  if (!found.predictions.empty()) add("", "all", Together(found.predictions));
  out << table.ToString();
}

void PrintFits(std::ostream& out, const TrueSource& source, const Evaluation& found) {
  out << "\nHow far from the true surface the occupied voxels of each object are, in metres: "
         "median, and\nwhat 95 % do not exceed; and how much of the surface that rays met has "
         "voxels.\n\n";
  Table table({"id", "what", "frames", "voxels", "error", "95 %", "covered"});
  for (const auto& [id, fit] : found.fits) {
    table.AddRow({absl::StrCat(id), NameOf(source, id), absl::StrCat(fit.growth.size()),
                  absl::StrCat(fit.errors_m.size()), TextOf(fit.Accuracy_m(), 3),
                  TextOf(fit.Quantile_m(kMost), 3), TextOf(fit.Completeness(), 3)});
  }
  out << table.ToString();
}

std::vector<SolidOverlap> Together(const std::map<ObjectId, std::vector<SolidOverlap>>& solids) {
  std::vector<SolidOverlap> all(kAhead.size());
  for (const auto& [id, of_object] : solids) {
    for (std::size_t i = 0; i < all.size(); ++i) all[i] += of_object[i];
  }
  return all;
}

void PrintSolids(std::ostream& out, const TrueSource& source, const Evaluation& found) {
  out << "\nHow well the solids that are predicted agree with the true ones to within a voxel: "
         "F-scores.\n\n";
  std::vector<std::string> header = {"id", "what"};
  for (const Duration ahead : kAhead) header.push_back(absl::StrCat(ToSeconds(ahead), " s"));
  Table table(header);
  const auto add = [&](const std::string& id, const std::string& name,
                       const std::vector<SolidOverlap>& overlaps) {
    std::vector<std::string> row = {id, name};
    for (const SolidOverlap& overlap : overlaps) row.push_back(TextOf(overlap.FScore(), 3));
    table.AddRow(row);
  };
  for (const auto& [id, overlaps] : found.solids) {
    add(absl::StrCat(id), NameOf(source, id), overlaps);
  }
  add("", "all", Together(found.solids));
  out << table.ToString();
}

void PrintStatic(std::ostream& out, const StaticFit& fit) {
  out << "\nThe static map, against the true world to within a voxel: of the voxels that it says "
         "are so, how\nmany are (precision); of the observed ones that are so, how many it says "
         "(recall).\n\n";
  Table table({"", "voxels", "precision", "recall"});
  table.AddRow({"occupied", absl::StrCat(fit.occupied), TextOf(fit.OccupiedPrecision(), 4),
                TextOf(fit.OccupiedRecall(), 4)});
  table.AddRow({"free", absl::StrCat(fit.free), TextOf(fit.FreePrecision(), 4),
                TextOf(fit.FreeRecall(), 4)});
  out << table.ToString() << "\n"
      << fit.Residual() << " occupied voxels are where nothing static is.\n";
}

// No number becomes null.
Json ToJson(const ObjectFit& fit) {
  return {{"occupied_voxels", fit.errors_m.size()},
          {"voxel_m", fit.voxel_m},
          {"accuracy_m", fit.Accuracy_m()},
          {"p95_m", fit.Quantile_m(kMost)},
          {"met_pieces", fit.met},
          {"completeness", fit.Completeness()},
          {"growth_voxels", fit.growth}};
}

Json ToJson(const StaticFit& fit) {
  return {
      {"occupied_voxels", fit.occupied},         {"free_voxels", fit.free},
      {"residual_voxels", fit.Residual()},       {"occupied_precision", fit.OccupiedPrecision()},
      {"occupied_recall", fit.OccupiedRecall()}, {"free_precision", fit.FreePrecision()},
      {"free_recall", fit.FreeRecall()}};
}

Json ToJson(const std::vector<PredictionErrors>& of_object) {
  Json json = Json::array();
  for (const PredictionErrors& e : of_object) {
    json.push_back({{"ahead_s", ToSeconds(e.ahead)},
                    {"count", e.errors_m.size()},
                    {"median_m", e.Median()},
                    {"p95_m", e.Quantile(kMost)},
                    {"median_bound_m", e.MedianBound()},
                    {"within_bound", e.Within()}});
  }
  return json;
}

// By kAhead.
Json ToJson(const std::vector<SolidOverlap>& overlaps) {
  Json json = Json::array();
  for (std::size_t i = 0; i < overlaps.size(); ++i) {
    json.push_back({{"ahead_s", ToSeconds(kAhead[i])},
                    {"precision", overlaps[i].Precision()},
                    {"recall", overlaps[i].Recall()},
                    {"f_score", overlaps[i].FScore()}});
  }
  return json;
}

}  // namespace

void PrintText(std::ostream& out, const TrueSource& source, const Evaluation& found) {
  out << source.frames.description << "\n\n";
  PrintPredictions(out, source, found);
  PrintBounds(out, source, found);
  if (!found.fits.empty()) PrintFits(out, source, found);
  if (!found.solids.empty()) PrintSolids(out, source, found);
  if (found.static_fit) PrintStatic(out, *found.static_fit);
}

void PrintJson(std::ostream& out, const TrueSource& source, const Evaluation& found) {
  Json json = {{"source", source.frames.description},
               {"truth", source.truth.description},
               {"frames", source.frames.frame_count},
               {"objects", Json::array()}};
  for (const auto& [id, of_object] : found.predictions) {
    Json object = {{"id", id}, {"name", NameOf(source, id)}, {"prediction", ToJson(of_object)}};
    const auto fit = found.fits.find(id);
    if (fit != found.fits.end()) object["reconstruction"] = ToJson(fit->second);
    const auto solids = found.solids.find(id);
    if (solids != found.solids.end()) object["solids"] = ToJson(solids->second);
    json["objects"].push_back(object);
  }
  json["prediction"] = ToJson(Together(found.predictions));
  if (!found.solids.empty()) json["solids"] = ToJson(Together(found.solids));
  if (found.static_fit) json["static"] = ToJson(*found.static_fit);
  Print(out, json);
}

}  // namespace clearway::cli
