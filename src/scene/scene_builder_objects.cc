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

// Until then an object would stand still: a stamp far ahead of the frames is of another clock.
absl::Status SceneBuilder::CheckStart(const std::string& field, Time stamp) const {
  if (!has_frames_ || stamp - scene_.stamp <= limits_.max_stamp_jump) return absl::OkStatus();
  return absl::FailedPreconditionError(absl::StrCat(
      field, ": ", ToNanoseconds(stamp), " lies more than ", ToSeconds(limits_.max_stamp_jump),
      " s (max_stamp_jump_s) after the scene's newest frame, ", ToNanoseconds(scene_.stamp)));
}

absl::Status SceneBuilder::CheckStarts(const GivenObject& given) const {
  if (absl::Status status = CheckStart("stamp_ns", given.pose.stamp); !status.ok()) return status;
  return given.future.empty() ? absl::OkStatus()
                              : CheckStart("future.stamps_ns[0]", given.future.front().stamp);
}

absl::Status SceneBuilder::AddObject(const GivenObject& object) {
  return ChangeObjects([&](SceneObjects& objects) {
    absl::Status status = AddGiven(object, scene_.params, limits_, objects);
    return status.ok() ? CheckStarts(object) : status;
  });
}

absl::Status SceneBuilder::AddObjects(std::span<const GivenObject> given) {
  return ChangeObjects([&](SceneObjects& objects) {
    absl::Status status;
    for (std::size_t i = 0; i < given.size() && status.ok(); ++i) {
      status = AddGiven(given[i], scene_.params, limits_, objects);
      status = InItem("objects", i, status.ok() ? CheckStarts(given[i]) : status);
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

absl::Status SceneBuilder::SetOneFuture(const ObjectFuture& future, SceneObjects& objects) const {
  absl::Status status = StateFuture(future.id, future.poses, scene_.params, limits_, objects);
  if (!status.ok() || future.poses.empty()) return status;
  return CheckStart("future.stamps_ns[0]", future.poses.front().stamp);
}

absl::Status SceneBuilder::SetFuture(ObjectId id, const std::vector<StampedPose>& poses) {
  return ChangeObjects([&](SceneObjects& objects) { return SetOneFuture({id, poses}, objects); });
}

absl::Status SceneBuilder::SetFutures(std::span<const ObjectFuture> futures) {
  return ChangeObjects([&](SceneObjects& objects) {
    absl::Status status;
    for (std::size_t i = 0; i < futures.size() && status.ok(); ++i) {
      status = InItem("futures", i, SetOneFuture(futures[i], objects));
    }
    return status;
  });
}

}  // namespace clearway
