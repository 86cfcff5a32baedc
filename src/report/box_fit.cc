#include "clearway/report/box_fit.h"

#include <array>
#include <vector>

#include "clearway/scene/object_extent.h"

namespace clearway {
namespace {

std::array<std::vector<double>, 3> CentersAlongAxes(const VoxelMap& map_O, const Pose& T_B_O) {
  std::array<std::vector<double>, 3> centers;
  map_O.blocks().ForEach([&](BlockKey key, const VoxelBlock& block) {
    block.occupied.ForEach([&](int index) {
      const Eigen::Vector3d center_B = T_B_O * map_O.grid().CenterOf(VoxelAt(key, index));
      for (int axis = 0; axis < 3; ++axis) centers[axis].push_back(center_B[axis]);
    });
  });
  return centers;
}

}  // namespace

void BoxFitter::Add(const SceneSnapshot& scene) {
  for (const auto& object : scene.objects) {
    if (object->last_seen != scene.stamp || object->bridged) continue;
    const auto box = BoxOf(truth_, object->id, scene.stamp);
    if (!box || box->size_m.isZero()) continue;  // some sources tell poses alone
    Seen& seen = seen_[object->id];
    if (seen.object != nullptr && seen.object->first_seen != object->first_seen) seen = {};
    seen.object = object;
    seen.size_m = box->size_m;
    seen.T_O_B.Add(Inverse(object->history.back().T_W_O) * box->T_W_B);
  }
}

std::map<ObjectId, BoxFit> BoxFitter::Fits() const {
  std::map<ObjectId, BoxFit> fits;
  for (const auto& [id, seen] : seen_) {
    const auto centers = CentersAlongAxes(seen.object->map_O, Inverse(seen.T_O_B.Value()));
    if (centers[0].empty()) continue;
    fits[id] = {seen.size_m,
                {SpanOf(centers[0]).length, SpanOf(centers[1]).length, SpanOf(centers[2]).length}};
  }
  return fits;
}

}  // namespace clearway
