#include "clearway/report/identity_score.h"

namespace clearway {
namespace {

std::set<ObjectId> ObjectsIn(const Frame& frame) {
  std::set<ObjectId> ids;
  for (const ObjectId label : frame.labels) {
    if (label > kStaticLabel) ids.insert(label);
  }
  return ids;
}

}  // namespace

Identities& Identities::operator+=(const Identities& other) {
  came_back += other.came_back;
  known_again += other.known_again;
  wrong += other.wrong;
  return *this;
}

void IdentityScore::Add(const Frame& frame, const SceneSnapshot& scene,
                        const std::map<ObjectId, ObjectId>& true_ids) {
  horizon_ = scene.params.horizon;
  for (const ObjectId id : ObjectsIn(frame)) {
    const MovingObject* const object = scene.FindObject(id);
    if (object == nullptr || object->last_seen != scene.stamp) continue;
    std::vector<Visit>& visits = visits_[true_ids.at(id)];
    if (visits.empty() || visits.back().id != id) visits.push_back({id, frame.stamp, frame.stamp});
    visits.back().last = frame.stamp;
    ++visits.back().frames;
  }
  for (auto& [id, visits] : visits_) {
    if (visits.size() < 2 || visits.back().known_again) continue;
    const MovingObject* const object = scene.FindObject(visits.back().id);
    visits.back().known_again = object != nullptr && object->IsCalled(visits[visits.size() - 2].id);
  }
  for (const auto& object : scene.objects) {
    for (const ObjectId id : object->also) {
      if (true_ids.at(id) != true_ids.at(object->id)) wrong_.emplace(object->id, id);
    }
  }
}

Identities IdentityScore::Result() const {
  Identities found;
  found.wrong = wrong_.size();
  for (const auto& [id, visits] : visits_) {
    for (std::size_t i = 1; i < visits.size(); ++i) {
      const Visit& before = visits[i - 1];
      const Visit& after = visits[i];
      if (before.frames < kFewestFrames || after.frames < kFewestFrames) continue;
      if (after.first - before.last > horizon_) continue;
      ++found.came_back;
      found.known_again += after.known_again;
    }
  }
  return found;
}

}  // namespace clearway
