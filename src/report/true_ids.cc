#include "clearway/report/true_ids.h"

#include <utility>

namespace clearway {

ScenePtr WithTrueIds(const SceneSnapshot& scene, const std::map<ObjectId, ObjectId>& true_ids) {
  std::map<ObjectId, std::shared_ptr<const MovingObject>> newest;
  for (const auto& object : scene.objects) {
    auto& known = newest[true_ids.at(object->id)];
    if (known == nullptr || known->last_seen <= object->last_seen) known = object;
  }
  SceneSnapshot renamed = scene;
  renamed.objects.clear();
  for (const auto& [id, object] : newest) {
    MovingObject copy = *object;
    copy.id = id;
    copy.also.clear();
    copy.older_ids_told.clear();
    const auto whole = true_ids.find(copy.part_of);
    if (whole != true_ids.end()) copy.part_of = whole->second;
    renamed.objects.push_back(std::make_shared<const MovingObject>(std::move(copy)));
  }
  return std::make_shared<const SceneSnapshot>(std::move(renamed));
}

}  // namespace clearway
