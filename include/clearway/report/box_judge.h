// A scene of a recording, judged by the recorded boxes.
#pragma once

#include <map>
#include <vector>

#include "clearway/report/box_residue.h"
#include "clearway/report/met_surfaces.h"
#include "clearway/report/object_fit.h"
#include "clearway/report/solid_score.h"

namespace clearway {

// Collects what the versions of a scene say, as SurfaceJudge does of a simulated world. Read what
// it finds by what a box is: see TrueBodies. One thread.
class BoxJudge {
 public:
  // The truth's boxes have these sizes. How far ahead solids are compared.
  BoxJudge(const Truth& truth, const std::map<ObjectId, Eigen::Vector3d>& sizes_m,
           std::vector<Duration> ahead);

  // Frame k, of true labels, taken from where the scene has the sensor, and the version after it.
  // Solids are compared after every fifth frame.
  void Add(std::size_t k, const Frame& frame, const SceneSnapshot& scene);

  std::map<ObjectId, ObjectFit> Fits() const { return objects_.Fits(met_); }
  const std::map<ObjectId, std::vector<SolidOverlap>>& overlaps() const {
    return solids_.overlaps();
  }
  BoxResidue ResidueIn(const SceneSnapshot& scene) const { return residue_.Of(scene.static_map_W); }

 private:
  MetSurfaces met_;
  ObjectFitter objects_;
  SolidScore solids_;
  BoxResidueScore residue_;
};

}  // namespace clearway
