#include "cli/evaluation.h"
#include "cli/json.h"
#include "cli/left_out_text.h"

namespace clearway::cli {
namespace {

// No number becomes null.
Json ToJson(const PointCounts& points) {
  return {{"used", points.used},
          {"doubted", points.doubted},
          {"not_finite", points.not_finite},
          {"out_of_bounds", points.out_of_bounds},
          {"ignored", points.ignored},
          {"frames_without", points.frames_without}};
}

Json ToJson(const ObjectFit& fit) {
  return {{"occupied_voxels", fit.errors_m.size()},
          {"voxel_m", fit.voxel_m},
          {"accuracy_m", fit.Accuracy_m()},
          {"p95_m", fit.Quantile_m(kMost)},
          {"met_pieces", fit.met},
          {"completeness", fit.Completeness()}};
}

Json ToJson(const SceneFit& fit) {
  Json json = ToJson(fit.together);
  json["worst_accuracy_voxels"] = fit.worst_accuracy_voxels;
  json["worst_completeness"] = fit.worst_completeness;
  return json;
}

Json ToJson(const Confusion::Counts& counts) {
  return {{"free", counts[Confusion::kFree]},
          {"occupied", counts[Confusion::kOccupied]},
          {"unknown", counts[Confusion::kUnknown]}};
}

Json ToJson(const StaticFit& fit) {
  return {{"occupied_voxels", fit.occupied},
          {"free_voxels", fit.free},
          {"residual_voxels", fit.Residual()},
          {"occupied_precision", fit.OccupiedPrecision()},
          {"occupied_recall", fit.OccupiedRecall()},
          {"free_precision", fit.FreePrecision()},
          {"free_recall", fit.FreeRecall()},
          {"grid",
           {{"truly_free", ToJson(fit.grid.truly_free)},
            {"surfaces_met", ToJson(fit.grid.truly_occupied)}}}};
}

Json ToJson(const std::vector<PredictionErrors>& of_object) {
  Json json = Json::array();
  for (const PredictionErrors& e : of_object) {
    json.push_back({{"ahead_s", ToSeconds(e.ahead)},
                    {"count", e.errors_m.size()},
                    {"median_m", e.Median()},
                    {"p95_m", e.Quantile(kMost)},
                    {"median_turn_rad", e.TurnQuantile_rad(0.5)},
                    {"p95_turn_rad", e.TurnQuantile_rad(kMost)},
                    {"median_bound_m", e.MedianBound()},
                    {"within_bound", e.Within()}});
  }
  return json;
}

Json ToJson(const BoxFit& size) {
  return {{"true_m", cli::ToJson(size.true_m)},
          {"mapped_m", cli::ToJson(size.mapped_m)},
          {"worst_difference_m", size.WorstDifference_m()}};
}

// Seconds since the first frame, occupied voxels.
Json ToJson(const std::vector<Eigen::Vector2d>& growth) {
  Json json = Json::array();
  for (const Eigen::Vector2d& at : growth) {
    json.push_back({{"after_s", at.x()}, {"occupied_voxels", static_cast<std::int64_t>(at.y())}});
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
                    {"f_score", overlaps[i].FScore()},
                    {"whole_recall", overlaps[i].WholeRecall()},
                    {"whole_f_score", overlaps[i].WholeFScore()}});
  }
  return json;
}

// By kWaysAhead.
Json ToJson(const std::vector<Confusion>& ways) {
  Json json = Json::array();
  for (std::size_t i = 0; i < ways.size(); ++i) {
    json.push_back({{"ahead_s", ToSeconds(kWaysAhead[i])},
                    {"truly_free", ToJson(ways[i].truly_free)},
                    {"truly_occupied", ToJson(ways[i].truly_occupied)}});
  }
  return json;
}

}  // namespace

void PrintJson(std::ostream& out, const TrueSource& source, const Evaluation& found) {
  Json json = {{"clearway", CLEARWAY_VERSION},
               {"command", found.command},
               {"source", source.frames.description},
               {"truth", source.truth.description},
               {"frames", found.frames},
               {"points", ToJson(found.points)},
               {"reports", found.notes.AsJson()},
               {"left_out", cli::ToJson(*source.frames.left_out)},
               {"objects", Json::array()}};
  for (const auto& [id, of_object] : found.predictions) {
    Json object = {{"id", id}, {"name", NameOf(source, id)}, {"prediction", ToJson(of_object)}};
    const auto size = found.sizes.find(id);
    if (size != found.sizes.end()) object["size"] = ToJson(size->second);
    const auto fit = found.fits.find(id);
    if (fit != found.fits.end()) object["reconstruction"] = ToJson(fit->second);
    const auto growth = found.growth.find(id);
    if (growth != found.growth.end()) object["growth"] = ToJson(growth->second);
    const auto solids = found.solids.find(id);
    if (solids != found.solids.end()) object["solids"] = ToJson(solids->second);
    const auto ways = found.ways_of.find(id);
    if (ways != found.ways_of.end()) object["ways"] = ToJson(ways->second);
    json["objects"].push_back(object);
  }
  json["prediction"] = ToJson(Together(found.predictions));
  if (!found.fits.empty()) json["reconstruction"] = ToJson(Together(found.fits));
  if (!found.solids.empty()) json["solids"] = ToJson(Together(found.solids));
  if (!found.ways.empty()) json["ways"] = ToJson(found.ways);
  if (found.identities) {
    json["identities"] = {{"came_back", found.identities->came_back},
                          {"known_again", found.identities->known_again},
                          {"wrong", found.identities->wrong}};
  }
  if (found.unlabelled) {
    json["unlabelled"] = {{"occupied_at_once", found.unlabelled->ShareOccupied()},
                          {"mean_trail_voxels", found.unlabelled->MeanTrail()},
                          {"most_trail_voxels", found.unlabelled->most_trail},
                          {"last_trail_voxels", found.unlabelled->last_trail},
                          {"dynamic_voxels", found.unlabelled->dynamic},
                          {"dynamic_voxels_left", found.unlabelled->dynamic_left},
                          {"dynamic_voxels_elsewhere", found.unlabelled->dynamic_elsewhere}};
  }
  if (found.static_fit) json["static"] = ToJson(*found.static_fit);
  if (found.residue) {
    json["static"] = {{"residual_voxels", found.residue->occupied},
                      {"passed_voxels", found.residue->passed},
                      {"not_known", kStaticNotKnown}};
  }
  Print(out, json);
}

}  // namespace clearway::cli
