#include "clearway/scene/scene_snapshot.h"

#include <xxhash.h>

#include <algorithm>

#include "absl/strings/str_format.h"
#include "scene/dynamic_hits.h"

namespace clearway {
namespace {

// Feeds a scene's content to XXH3 in one canonical order. As operator== takes -0.0 and 0.0 for the
// same number, so does the hash.
class ContentHasher {
 public:
  explicit ContentHasher(const std::function<bool()>& cancelled)
      : cancelled_(cancelled), state_(XXH3_createState()) {
    XXH3_128bits_reset(state_);
  }
  ~ContentHasher() { XXH3_freeState(state_); }
  ContentHasher(const ContentHasher&) = delete;
  ContentHasher& operator=(const ContentHasher&) = delete;

  void Add(std::int64_t value) { XXH3_128bits_update(state_, &value, sizeof value); }
  void Add(double value) {
    value += 0.0;  // -0.0 becomes 0.0, every other number stays
    XXH3_128bits_update(state_, &value, sizeof value);
  }
  void Add(Time time) { Add(ToNanoseconds(time)); }
  void Add(const Eigen::Vector3d& v) {
    for (const double value : v) Add(value);
  }
  void Add(const Aabb& box) {
    Add(box.min);
    Add(box.max);
  }
  void Add(const Pose& pose) {
    for (const double value : pose.rotation.coeffs()) Add(value);
    Add(pose.translation);
  }
  void Add(const Twist& twist) {
    Add(twist.angular);
    Add(twist.linear);
  }
  template <class T>
  void Add(const std::optional<T>& value) {
    Add(std::int64_t{value.has_value()});
    if (value) Add(*value);
  }
  void Add(const std::vector<Aabb>& boxes) {
    Add(static_cast<std::int64_t>(boxes.size()));
    for (const Aabb& box : boxes) Add(box);
  }
  void Add(const std::vector<StampedPose>& poses) {
    Add(static_cast<std::int64_t>(poses.size()));
    for (const StampedPose& pose : poses) {
      Add(pose.stamp);
      Add(pose.T_W_O);
    }
  }
  void Add(const VoxelMap& map) {
    Add(map.grid().resolution_m());
    Add(static_cast<std::int64_t>(map.blocks().size()));
    map.blocks().AnyBlock([&](BlockKey key, const VoxelBlock& block) {
      const std::int32_t address[3] = {key.x, key.y, key.z};
      XXH3_128bits_update(state_, address, sizeof address);
      XXH3_128bits_update(state_, block.observed.words.data(), sizeof block.observed.words);
      XXH3_128bits_update(state_, block.log_odds.data(), sizeof block.log_odds);
      return ++blocks_ % kBlocksPerLook == 0 && cancelled_();
    });
  }
  void Add(const Completion& completion) {
    Add(completion.yaw_rad);
    Add(std::int64_t{completion.unseen_end});
    Add(std::int64_t{completion.length_seen});
  }
  void Add(const DynamicSpace& space) {
    Add(static_cast<std::int64_t>(space.voxels().size()));
    for (const DynamicVoxel& voxel : space.voxels()) {
      for (const std::int32_t i : {voxel.key.x, voxel.key.y, voxel.key.z}) Add(std::int64_t{i});
      Add(voxel.first_hit);
      Add(voxel.last_hit);
    }
  }
  void Add(const SceneParams& params);
  void Add(const MovingObject& object);
  void Add(const Shape& shape);
  void Add(const Mesh& mesh);

  std::string HexDigest() const {
    const XXH128_hash_t hash = XXH3_128bits_digest(state_);
    return absl::StrFormat("%016x%016x", hash.high64, hash.low64);
  }

 private:
  static constexpr int kBlocksPerLook = 1024;

  const std::function<bool()>& cancelled_;
  std::int64_t blocks_ = 0;
  XXH3_state_t* state_;
};

void ContentHasher::Add(const SceneParams& params) {
  Add(params.resolution_m);
  Add(params.object_resolution_m);
  for (double probability :
       {params.occupancy.hit, params.occupancy.miss, params.occupancy.clamp_min,
        params.occupancy.clamp_max, params.occupancy.occupied}) {
    Add(probability);
  }
  Add(params.rays.max_range_m);
  Add(std::int64_t{params.rays.discretize});
  Add(params.rays.grazing_m);
  Add(std::int64_t{params.rays.octomap_ends});
  Add(static_cast<std::int64_t>(params.solid));
  Add(std::int64_t{params.clear_objects_by_rays});
  for (Duration duration : {params.horizon, params.object_lifetime, params.history,
                            params.dynamic_life, params.dynamic_settle}) {
    Add(std::int64_t{duration.count()});
  }
  Add(static_cast<std::int64_t>(params.motion));
  Add(static_cast<std::int64_t>(params.motion_from_points));
  Add(params.rest_distance_m);
  Add(params.object_pose_error_m);
  Add(params.object_pose_error_rad);
  Add(params.sensor_pose_error_m);
  Add(params.sensor_pose_error_rad);
  Add(std::int64_t{params.reidentify});
  Add(std::int64_t{params.filter_labels});
  Add(params.keep_distance_m);
  Add(params.bounds_W);
  Add(params.keep_out_W);
  Add(params.self_filter_S);
}

void ContentHasher::Add(const MovingObject& object) {
  Add(std::int64_t{object.id});
  Add(static_cast<std::int64_t>(object.also.size()));
  for (const ObjectId id : object.also) Add(std::int64_t{id});
  for (const Time told : object.older_ids_told) Add(told);
  Add(std::int64_t{object.part_of});
  Add(object.map_O);
  Add(object.completion);
  Add(object.history);
  Add(object.velocity_O);
  for (const double value : {object.bound.at_m, object.bound.speed_mps, object.bound.accel_mps2}) {
    Add(value);
  }
  Add(object.tracked_since);
  Add(object.placed_at);
  Add(std::int64_t{object.estimated});
  Add(std::int64_t{object.reported});
  Add(object.T_B_O);
  Add(object.first_seen);
  Add(object.last_seen);
  Add(std::int64_t{object.frames_seen});
  Add(std::int64_t{object.bridged});
  Add(object.future);
  Add(object.future_velocity_O);
  Add(std::int64_t{object.given()});
  if (object.given()) Add(*object.given_shape);
}

void ContentHasher::Add(const Shape& shape) {
  Add(static_cast<std::int64_t>(shape.index()));
  struct Sizes {
    ContentHasher& hasher;
    void operator()(const Sphere& s) const { hasher.Add(s.radius_m); }
    void operator()(const Box& s) const { hasher.Add(s.size_m); }
    void operator()(const Capsule& s) const { (hasher.Add(s.radius_m), hasher.Add(s.length_m)); }
    void operator()(const Cylinder& s) const { (hasher.Add(s.radius_m), hasher.Add(s.length_m)); }
    void operator()(const ConvexPolytope& s) const { hasher.Add(*s.mesh); }
    void operator()(const TriangleMesh& s) const { hasher.Add(*s.mesh); }
  };
  std::visit(Sizes{*this}, shape);
}

void ContentHasher::Add(const Mesh& mesh) {
  Add(static_cast<std::int64_t>(mesh.vertices.size()));
  for (const Eigen::Vector3d& vertex : mesh.vertices) Add(vertex);
  Add(static_cast<std::int64_t>(mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles) {
    XXH3_128bits_update(state_, triangle.data(), sizeof triangle);
  }
}

bool SameShape(const MovingObject& a, const MovingObject& b) {
  return a.given_shape == b.given_shape ||
         (a.given() && b.given() && *a.given_shape == *b.given_shape);
}

bool SameObject(const MovingObject& a, const MovingObject& b) {
  return a.id == b.id && a.also == b.also && a.older_ids_told == b.older_ids_told &&
         a.part_of == b.part_of && a.map_O == b.map_O && a.completion == b.completion &&
         a.history == b.history && a.future == b.future &&
         a.future_velocity_O == b.future_velocity_O && SameShape(a, b) &&
         a.velocity_O == b.velocity_O && a.T_B_O == b.T_B_O && a.first_seen == b.first_seen &&
         a.last_seen == b.last_seen && a.frames_seen == b.frames_seen && a.bridged == b.bridged &&
         a.bound == b.bound && a.tracked_since == b.tracked_since && a.placed_at == b.placed_at &&
         a.estimated == b.estimated && a.reported == b.reported;
}

}  // namespace

const char* ToString(SpaceStatus status) {
  switch (status) {
    case SpaceStatus::kFree:
      return "free";
    case SpaceStatus::kUnknownSpace:
      return "unknown";
    case SpaceStatus::kBeyondHorizon:
      return "beyond horizon";
    case SpaceStatus::kOccupied:
      return "occupied";
    case SpaceStatus::kOutOfBounds:
      return "out of bounds";
    case SpaceStatus::kUnresolved:
      return "unresolved";
  }
  return "invalid";
}

SceneSnapshot SceneSnapshot::Empty(const SceneParams& params) {
  SceneSnapshot scene;
  scene.params = params;
  scene.static_map_W = VoxelMap(params.resolution_m, params.Model());
  return scene;
}

VoxelMap SceneSnapshot::LastingMap() const { return WithoutDynamic(static_map_W, dynamic_W); }

const MovingObject* SceneSnapshot::FindObject(ObjectId id) const {
  const auto found = std::lower_bound(
      objects.begin(), objects.end(), id,
      [](const std::shared_ptr<const MovingObject>& object, ObjectId i) { return object->id < i; });
  if (found != objects.end() && (*found)->id == id) return found->get();
  const auto other = std::find_if(objects.begin(), objects.end(),
                                  [&](const auto& object) { return object->IsCalled(id); });
  return other == objects.end() ? nullptr : other->get();
}

std::vector<const MovingObject*> SceneSnapshot::PartsOf(ObjectId whole) const {
  std::vector<const MovingObject*> parts;
  for (const auto& object : objects) {
    if (object->part_of == whole && whole != kStaticLabel) parts.push_back(object.get());
  }
  return parts;
}

std::string SceneSnapshot::Hash(const std::function<bool()>& cancelled) const {
  ContentHasher hasher(cancelled);
  hasher.Add(stamp);
  hasher.Add(params);
  hasher.Add(static_map_W);
  hasher.Add(dynamic_W);
  hasher.Add(static_cast<std::int64_t>(objects.size()));
  for (const auto& object : objects) hasher.Add(*object);
  return hasher.HexDigest();
}

bool SameContent(const SceneSnapshot& a, const SceneSnapshot& b) {
  return a.stamp == b.stamp && a.params == b.params && a.static_map_W == b.static_map_W &&
         a.dynamic_W == b.dynamic_W &&
         std::equal(a.objects.begin(), a.objects.end(), b.objects.begin(), b.objects.end(),
                    [](const auto& x, const auto& y) { return SameObject(*x, *y); });
}

}  // namespace clearway
