// The part of SceneBuilder on what is told of objects.
#include <utility>

#include "absl/strings/str_cat.h"
#include "clearway/scene/scene_builder.h"
#include "scene/given_object.h"

namespace clearway {
namespace {

// The error in the item's own field: "objects[3].world_from_object".
absl::Status InItem(const char* items, std::size_t i, const absl::Status& status) {
  if (status.ok()) return status;
  return absl::Status(status.code(), absl::StrCat(items, "[", i, "].", status.message()));
}

}  // namespace

absl::Status SceneBuilder::ChangeObjects(const std::function<absl::Status(SceneObjects&)>& change) {
  SceneObjects objects = scene_.objects;
  if (absl::Status status = change(objects); !status.ok()) return status;
  scene_.objects = std::move(objects);
  changed_ = true;
  return absl::OkStatus();
}

absl::Status SceneBuilder::AddObject(const GivenObject& object) {
  return ChangeObjects(
      [&](SceneObjects& objects) { return AddGiven(object, scene_.params, limits_, objects); });
}

absl::Status SceneBuilder::AddObjects(std::span<const GivenObject> given) {
  return ChangeObjects([&](SceneObjects& objects) {
    absl::Status status;
    for (std::size_t i = 0; i < given.size() && status.ok(); ++i) {
      status = InItem("objects", i, AddGiven(given[i], scene_.params, limits_, objects));
    }
    return status;
  });
}

absl::Status SceneBuilder::RemoveObject(ObjectId id) {
  return ChangeObjects(
      [&](SceneObjects& objects) { return RemoveGiven("object_id", id, objects); });
}

absl::Status SceneBuilder::RemoveObjects(std::span<const ObjectId> ids) {
  return ChangeObjects([&](SceneObjects& objects) {
    absl::Status status;
    for (std::size_t i = 0; i < ids.size() && status.ok(); ++i) {
      status = RemoveGiven(absl::StrCat("object_ids[", i, "]"), ids[i], objects);
    }
    return status;
  });
}

absl::Status SceneBuilder::SetFuture(ObjectId id, const std::vector<StampedPose>& poses) {
  return ChangeObjects([&](SceneObjects& objects) {
    return StateFuture(id, poses, scene_.params, limits_, objects);
  });
}

absl::Status SceneBuilder::SetFutures(std::span<const ObjectFuture> futures) {
  return ChangeObjects([&](SceneObjects& objects) {
    absl::Status status;
    for (std::size_t i = 0; i < futures.size() && status.ok(); ++i) {
      const auto& [id, poses] = futures[i];
      status = InItem("futures", i, StateFuture(id, poses, scene_.params, limits_, objects));
    }
    return status;
  });
}

}  // namespace clearway
