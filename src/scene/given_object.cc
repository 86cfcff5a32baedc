#include "scene/given_object.h"

#include <algorithm>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"
#include "clearway/geometry/hull.h"
#include "clearway/geometry/mesh_validation.h"
#include "clearway/geometry/solid_mesh.h"
#include "clearway/map/voxel_key.h"
#include "scene/group_motion.h"
#include "scene/object_motion.h"

namespace clearway {
namespace {

absl::Status Invalid(const std::string& field, const std::string& what) {
  return absl::InvalidArgumentError(absl::StrCat(field, ": ", what));
}

SceneObjects::iterator PlaceOf(ObjectId id, SceneObjects& objects) {
  return std::lower_bound(
      objects.begin(), objects.end(), id,
      [](const std::shared_ptr<const MovingObject>& object, ObjectId i) { return object->id < i; });
}

// By any of its ids.
SceneObjects::iterator Named(ObjectId id, SceneObjects& objects) {
  const auto place = PlaceOf(id, objects);
  if (place != objects.end() && (*place)->id == id) return place;
  return std::find_if(objects.begin(), objects.end(),
                      [&](const auto& object) { return object->IsCalled(id); });
}

// Whether they are parts of one object, or one of the other.
bool BelongTogether(const MovingObject& a, const MovingObject& b) {
  const auto whole_of = [](const MovingObject& object) {
    return object.part_of == kStaticLabel ? object.id : object.part_of;
  };
  return whole_of(a) == whole_of(b);
}

// A pose in the addressable space, at a stamp that may be calculated with.
absl::Status CheckPose(const std::string& pose_field, const std::string& stamp_field,
                       const StampedPose& pose, const SceneParams& params,
                       const FrameLimits& limits) {
  if (auto status = ValidateStamp(stamp_field, pose.stamp); !status.ok()) return status;
  if (auto status = ValidatePose(pose_field, pose.T_W_O, limits.max_coordinate_m); !status.ok()) {
    return status;
  }
  const VoxelGrid grid(params.resolution_m);
  if (grid.Addressable(pose.T_W_O.translation)) return absl::OkStatus();
  return Invalid(pose_field + ".translation_m",
                 absl::StrCat("lies outside the addressable space of ", NumberText(grid.limit_m()),
                              " m about the origin"));
}

// Within the shortest step that tells a velocity.
double SpeedBetween(const StampedPose& a, const StampedPose& b) {
  return (b.T_W_O.translation - a.T_W_O.translation).norm() /
         ToSeconds(std::max(b.stamp - a.stamp, kShortestStep));
}

absl::Status CheckFuture(const std::string& field, const std::vector<StampedPose>& poses,
                         const StampedPose& now, const SceneParams& params,
                         const FrameLimits& limits) {
  if (poses.size() > kMaxFuturePoses) {
    return absl::ResourceExhaustedError(
        absl::StrCat(field, ": ", poses.size(), " poses; the limit is ", kMaxFuturePoses));
  }
  const StampedPose* before = &now;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::string stamp_field = absl::StrCat(field, ".stamps_ns[", i, "]");
    const std::string pose_field = absl::StrCat(field, ".world_from_object[", i, "]");
    if (auto status = CheckPose(pose_field, stamp_field, poses[i], params, limits); !status.ok()) {
      return status;
    }
    if (poses[i].stamp <= before->stamp) {
      return Invalid(stamp_field,
                     absl::StrCat("is ", ToNanoseconds(poses[i].stamp), ", not after ",
                                  i == 0 ? "the object's pose at " : "the one before it, ",
                                  ToNanoseconds(before->stamp)));
    }
    if (const double speed_mps = SpeedBetween(*before, poses[i]); speed_mps > kMaxSpeed_mps) {
      return Invalid(pose_field, absl::StrCat("is reached at ", NumberText(speed_mps),
                                              " m/s; the limit is ", NumberText(kMaxSpeed_mps)));
    }
    before = &poses[i];
  }
  return absl::OkStatus();
}

// Null for a shape without one.
std::shared_ptr<const Mesh> MeshOf(const Shape& shape) {
  if (const auto* convex = std::get_if<ConvexPolytope>(&shape)) return convex->mesh;
  if (const auto* triangles = std::get_if<TriangleMesh>(&shape)) return triangles->mesh;
  return nullptr;
}

absl::Status CheckVelocity(const Twist& velocity_O) {
  const double linear_mps = velocity_O.linear.norm(), spin_radps = velocity_O.angular.norm();
  if (!(linear_mps <= kMaxSpeed_mps)) {  // so that it fails for NaN
    return Invalid("velocity_object.linear_mps",
                   absl::StrCat("is of length ", NumberText(linear_mps), "; the limit is ",
                                NumberText(kMaxSpeed_mps)));
  }
  if (!(spin_radps <= kMaxGivenSpin_radps)) {
    return Invalid("velocity_object.angular_radps",
                   absl::StrCat("is of length ", NumberText(spin_radps), "; the limit is ",
                                NumberText(kMaxGivenSpin_radps)));
  }
  return absl::OkStatus();
}

absl::Status Check(const GivenObject& given, const SceneParams& params, const FrameLimits& limits) {
  if (given.id <= kStaticLabel) {
    return Invalid("object_id", absl::StrCat("is ", given.id, "; object ids start at 1"));
  }
  if (auto status = ValidateGivenShape("shape", given.shape); !status.ok()) return status;
  if (auto status = CheckPose("world_from_object", "stamp_ns", given.pose, params, limits);
      !status.ok()) {
    return status;
  }
  if (given.velocity_O) {
    if (auto status = CheckVelocity(*given.velocity_O); !status.ok()) return status;
  }
  return CheckFuture("future", given.future, given.pose, params, limits);
}

StampedPose Normalized(const StampedPose& pose) {
  return {pose.stamp, {pose.T_W_O.rotation.normalized(), pose.T_W_O.translation}};
}

std::vector<StampedPose> Normalized(const std::vector<StampedPose>& poses) {
  std::vector<StampedPose> normalized;
  normalized.reserve(poses.size());
  for (const StampedPose& pose : poses) normalized.push_back(Normalized(pose));
  return normalized;
}

// What the scene keeps of the shape: a convex mesh is a polytope, without its holes.
Shape Kept(const Shape& shape) {
  const std::shared_ptr<const Mesh> mesh = MeshOf(shape);
  if (mesh == nullptr) return shape;
  const SolidMesh solid = SolidMeshOf(mesh);
  if (solid.note.empty()) return ConvexPolytope{solid.mesh};
  return ConvexPolytope{std::make_shared<const Mesh>(ConvexHullOf(solid.mesh->vertices))};
}

Mesh TurnedRound(Mesh mesh) {
  for (auto& [a, b, c] : mesh.triangles) std::swap(b, c);
  return mesh;
}

// Nobody knows which side of an open surface is the outer one.
absl::Status ValidateConvex(const std::string& field, const Mesh& mesh) {
  const absl::Status status = ValidateHull(field, mesh);
  return status.ok() || ValidateHull(field, TurnedRound(mesh)).ok() ? absl::OkStatus() : status;
}

}  // namespace

absl::Status ValidateGivenShape(const std::string& field, const Shape& shape) {
  const bool has_mesh =
      std::holds_alternative<ConvexPolytope>(shape) || std::holds_alternative<TriangleMesh>(shape);
  if (!has_mesh) return Validate(field, shape);
  const std::shared_ptr<const Mesh> mesh = MeshOf(shape);
  if (mesh != nullptr && mesh->triangles.size() > kMaxGivenTriangles) {
    return absl::ResourceExhaustedError(absl::StrCat(
        field, ": ", mesh->triangles.size(), " triangles; the limit is ", kMaxGivenTriangles));
  }
  const std::string mesh_field =
      field + (std::holds_alternative<ConvexPolytope>(shape) ? ".convex" : ".mesh");
  if (auto status = ValidateMesh(mesh_field, mesh); !status.ok()) return status;
  const absl::Status status = ValidateConvex(mesh_field, *SolidMeshOf(mesh).mesh);
  if (status.ok()) return status;
  return absl::Status(status.code(),
                      absl::StrCat(status.message(),
                                   "; a mesh that is not convex has to be given in convex parts, "
                                   "each an object of its own"));
}

absl::Status AddGiven(const GivenObject& given, const SceneParams& params,
                      const FrameLimits& limits, SceneObjects& objects) {
  if (auto status = Check(given, params, limits); !status.ok()) return status;
  if (Named(given.id, objects) != objects.end()) {
    return absl::AlreadyExistsError(
        absl::StrCat("object_id: the scene has an object ", given.id, " already"));
  }
  if (objects.size() >= limits.max_objects) {
    return absl::ResourceExhaustedError(absl::StrCat("object_id: the scene holds ", objects.size(),
                                                     " objects; the limit is ",
                                                     limits.max_objects));
  }
  MovingObject object;
  object.id = given.id;
  object.map_O = VoxelMap(params.object_resolution_m, params.Model());
  object.given_shape = std::make_shared<const Shape>(Kept(given.shape));
  object.solid = SolidOf(*object.given_shape);
  if (object.solid->hull->triangles.empty()) return Invalid("shape", "has no volume");
  object.history = {Normalized(given.pose)};
  object.velocity_O = given.velocity_O.value_or(Twist{});
  object.first_seen = object.last_seen = object.placed_at = given.pose.stamp;
  object.reported = true;
  objects.insert(PlaceOf(given.id, objects), std::make_shared<const MovingObject>(WithFuture(
                                                 std::move(object), Normalized(given.future))));
  return absl::OkStatus();
}

absl::Status RemoveGiven(const std::string& field, ObjectId id, SceneObjects& objects) {
  const auto place = Named(id, objects);
  if (place == objects.end()) {
    return absl::NotFoundError(absl::StrCat(field, ": the scene has no object ", id));
  }
  if (!(*place)->given()) {
    return absl::NotFoundError(
        absl::StrCat(field, ": object ", id, " was reconstructed from scans, not given"));
  }
  const ObjectId first_id = (*place)->id;
  std::erase_if(objects, [&](const auto& object) {
    return object->id == first_id || (object->given() && object->part_of == first_id);
  });
  return absl::OkStatus();
}

absl::Status StateFuture(ObjectId id, const std::vector<StampedPose>& poses,
                         const SceneParams& params, const FrameLimits& limits,
                         SceneObjects& objects) {
  const auto place = Named(id, objects);
  if (place == objects.end()) {
    return absl::NotFoundError(absl::StrCat("object_id: the scene has no object ", id));
  }
  if (auto status = CheckFuture("future", poses, (*place)->history.back(), params, limits);
      !status.ok()) {
    return status;
  }
  const MovingObject before = **place;
  *place = std::make_shared<const MovingObject>(WithFuture(before, Normalized(poses)));
  for (auto& other : objects) {
    if (!BelongTogether(*other, before) || other->id == before.id) continue;
    const Pose T_W_O = PredictPose(before, other->t_k(), params.horizon).T_W_O;
    const Pose T_O_P = Inverse(T_W_O) * other->history.back().T_W_O;
    other = std::make_shared<const MovingObject>(WithFutureOf(*other, **place, T_O_P));
  }
  return absl::OkStatus();
}

}  // namespace clearway
