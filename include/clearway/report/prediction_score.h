// How far predicted objects are from where they really come, and whether that was foreseen.
#pragma once

#include <functional>
#include <map>
#include <vector>

#include "clearway/report/truth.h"
#include "clearway/scene/scene_snapshot.h"

namespace clearway {

// Distances in metres, one for each version in which the object was seen and whose truth reaches so
// far ahead.
struct PredictionErrors {
  Duration ahead;
  std::vector<double> errors_m;  // ascending
  // The bounds that were stated of them (PositionBound), ascending too, and how many kept within.
  std::vector<double> bounds_m;
  std::size_t within = 0;
  // By how much their axes are turned from the true ones, in radians, ascending.
  std::vector<double> turns_rad;

  // The error that this share (0 to 1) of the predictions does not exceed; NaN without any.
  double Quantile(double share) const;
  double Median() const { return Quantile(0.5); }
  double MedianBound() const;
  double TurnQuantile_rad(double share) const;
  // Share of those within their bounds; NaN without any.
  double Within() const {
    return static_cast<double>(within) / static_cast<double>(errors_m.size());
  }

  PredictionErrors& operator+=(const PredictionErrors& other);  // of the same time ahead
};

// One object's prediction, for one time ahead.
struct ScoredPrediction {
  const MovingObject& object;
  std::size_t ahead;  // index into the times ahead
  double error_m;
  double turn_rad;
};

// Scores the predictions of one version, as PredictionScore does: of objects whose newest pose is
// of its frame and not bridged, for those times ahead for which there is a true box.
void ForEachPrediction(const SceneSnapshot& scene, const Truth& truth,
                       const std::vector<Duration>& ahead,
                       const std::function<void(const ScoredPrediction&)>& visit);

// Collects prediction errors over the versions of a scene. An error is the distance between the
// middle of an object's true box at t_k + ahead and that of its true box at t_k, moved as the scene
// moves the object meanwhile: what the map gets wrong about the object's shape does not count. A
// turn is the angle between these boxes. One thread.
class PredictionScore {
 public:
  PredictionScore(Truth truth, std::vector<Duration> ahead);

  // The version after a frame. Objects count whose newest pose is of that frame and not bridged.
  void Add(const SceneSnapshot& scene);

  // By object, in the order of `ahead`.
  std::map<ObjectId, std::vector<PredictionErrors>> Errors() const;

 private:
  Truth truth_;
  std::vector<Duration> ahead_;
  std::map<ObjectId, std::vector<PredictionErrors>> errors_;  // in any order
};

}  // namespace clearway
