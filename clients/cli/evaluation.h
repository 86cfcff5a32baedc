// What clearway evaluate finds, and how it tells it.
#pragma once

#include <array>
#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "clearway/report/box_fit.h"
#include "clearway/report/box_judge.h"
#include "clearway/report/identity_score.h"
#include "clearway/report/prediction_score.h"
#include "clearway/report/surface_judge.h"
#include "clearway/report/unlabelled_score.h"
#include "clearway/report/way_confusion.h"
#include "clearway/scene/scene_builder.h"
#include "cli/object_notes.h"
#include "cli/truth_source.h"

namespace clearway::cli {

// How far ahead predictions are judged.
inline constexpr std::array kAhead = {
    std::chrono::milliseconds(500), std::chrono::milliseconds(1000),
    std::chrono::milliseconds(2000), std::chrono::milliseconds(3000)};

// How far ahead places are asked about: at once, too.
inline constexpr std::array kWaysAhead = {Duration::zero(), Duration(kAhead[0]),
                                          Duration(kAhead[1]), Duration(kAhead[2]),
                                          Duration(kAhead[3])};

// What became of the points of all frames.
struct PointCounts {
  std::size_t used = 0;
  std::size_t not_finite = 0, out_of_bounds = 0, ignored = 0;  // left out
  std::size_t doubted = 0;         // of those used, the ones whose label was
  std::size_t frames_without = 0;  // of which none was used
};

struct Evaluation {
  std::string command;                                            // that made it
  std::size_t frames = 0;                                         // that were applied
  std::map<ObjectId, std::vector<PredictionErrors>> predictions;  // by kAhead
  std::map<ObjectId, BoxFit> sizes;
  // After each frame that showed the object: seconds since the first frame, occupied voxels.
  std::map<ObjectId, std::vector<Eigen::Vector2d>> growth;
  ScenePtr scene;  // the last version
  PointCounts points;
  ObjectNotes notes;                                               // of the frames' reports
  std::map<ObjectId, std::shared_ptr<const MovingObject>> newest;  // dropped ones too
  // Where the true surfaces are known, or recorded boxes stand for them.
  std::map<ObjectId, ObjectFit> fits;
  std::map<ObjectId, std::vector<SolidOverlap>> solids;  // by kAhead
  std::optional<StaticFit> static_fit;                   // of simulations
  std::optional<BoxResidue> residue;                     // of recorded boxes
  std::optional<Identities> identities;                  // where objects came back under new ids
  std::optional<Unlabelled> unlabelled;                  // where some were not labelled
  // By kWaysAhead: of the places that any object passes, and of those that each passes. Empty if it
  // is not known how large objects are.
  std::vector<Confusion> ways;
  std::map<ObjectId, std::vector<Confusion>> ways_of;
};

// Why recorded boxes leave most of the static map unjudged.
inline constexpr char kStaticNotKnown[] =
    "precision and recall of the static map are not known: the true static world is not recorded";

inline constexpr double kMost = 0.95;  // the share whose error is told beside the median

std::string NameOf(const TrueSource& source, ObjectId id);  // empty if it has none
// All objects together, by kAhead.
std::vector<PredictionErrors> Together(
    const std::map<ObjectId, std::vector<PredictionErrors>>& predictions);
std::vector<SolidOverlap> Together(const std::map<ObjectId, std::vector<SolidOverlap>>& solids);

// Collects an evaluation over the frames of a source. One thread.
class Evaluator {
 public:
  // Of `unlabelled` the scene is told nothing.
  Evaluator(const TrueSource& source, const std::vector<ObjectId>& unlabelled);

  // Frame k, of true labels, what became of it, and the version after it, of objects under their
  // true ids.
  void Add(std::size_t k, const Frame& frame, const FrameReport& report, ScenePtr scene);

  // After the last frame; there must be one.
  Evaluation Result() &&;

 private:
  void AddPoints(const FrameReport& report);
  void AddObjects(const SceneSnapshot& scene);

  PredictionScore predictions_;
  BoxFitter boxes_;
  std::optional<SurfaceJudge> judge_;  // where the true surfaces are known
  std::optional<BoxJudge> box_judge_;  // where boxes stand for them
  std::optional<UnlabelledScore> unlabelled_;
  WayConfusion ways_;
  std::optional<Time> first_;
  Evaluation found_;
};

void PrintText(std::ostream& out, const TrueSource& source, const Evaluation& found);
void PrintJson(std::ostream& out, const TrueSource& source, const Evaluation& found);

}  // namespace clearway::cli
