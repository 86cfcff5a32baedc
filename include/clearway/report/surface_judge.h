// A scene of a simulation, judged by the true surfaces.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "clearway/report/met_surfaces.h"
#include "clearway/report/object_fit.h"
#include "clearway/report/solid_score.h"
#include "clearway/report/static_fit.h"
#include "clearway/sim/simulation.h"

namespace clearway {

// Collects what the versions of a scene say of a simulated world. One thread.
class SurfaceJudge {
 public:
  // How far ahead solids are compared.
  SurfaceJudge(Simulation simulation, std::vector<Duration> ahead);

  // Frame k, of true labels, and the version after it. Solids are compared after every fifth frame:
  // that takes longer than all the rest.
  void Add(std::size_t k, const Frame& frame, const SceneSnapshot& scene);

  std::map<ObjectId, ObjectFit> Fits() const { return objects_.Fits(met_); }
  const std::map<ObjectId, std::vector<SolidOverlap>>& overlaps() const {
    return solids_.overlaps();
  }
  StaticFit FitOfStatic(const SceneSnapshot& scene) const {
    return FitOf(scene.static_map_W, *world_, met_);
  }

 private:
  Simulation simulation_;
  std::shared_ptr<const World> world_;
  MetSurfaces met_;
  ObjectFitter objects_;
  SolidScore solids_;
  std::size_t added_ = 0;  // frames
};

}  // namespace clearway
