#include "wire/delta_wire.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "clearway/scene/given_object.h"
#include "wire/block_codec.h"
#include "wire/dynamic_wire.h"
#include "wire/robot_wire.h"
#include "wire/scene_wire.h"
#include "wire/status.h"

namespace clearway {
namespace {

constexpr std::size_t kTargetBytes = 1 << 20;  // of a part, as serialized

// Cuts a difference into parts.
class DeltaWriter {
 public:
  DeltaWriter(const SceneDifference& difference,
              const std::function<bool(const v1::SceneDeltaPart&)>& send)
      : difference_(difference), head_(difference.Head()), send_(send) {
    Begin();
    if (head_.params) Write(*head_.params, part_.mutable_params());
    part_.set_dynamic_changed(head_.dynamic_W.has_value());
    part_.mutable_removed_object_ids()->Add(head_.removed.begin(), head_.removed.end());
  }

  bool Run() {
    MapDelta blocks;
    difference_.ForEachBlock([&](BlockDelta block) {
      blocks.push_back(std::move(block));
      if (blocks.size() < kMaxBlocksPerPart) return true;
      AddBlocks(kStaticLabel, blocks);
      blocks.clear();
      return alive_;
    });
    if (!blocks.empty() && alive_) AddBlocks(kStaticLabel, blocks);
    if (head_.dynamic_W) AddDynamic(head_.dynamic_W->voxels());
    difference_.ForEachObject([&](const ObjectDelta& object) {
      AddObject(object);
      AddMap(object.id, object.map_O);
      return alive_;
    });
    part_.set_last(true);
    return alive_ && send_(part_);
  }

 private:
  void Begin() {
    part_.Clear();
    part_.set_from_version(head_.from_version);
    part_.set_to_version(head_.to_version);
    part_.set_stamp_ns(ToNanoseconds(head_.stamp));
    part_.set_part(next_part_++);
    bytes_ = 0;
  }
  void Added(std::size_t bytes) {
    bytes_ += bytes;
    if (bytes_ < kTargetBytes) return;
    alive_ = alive_ && send_(part_);
    Begin();
  }
  void AddMap(ObjectId id, const MapDelta& map) {
    for (std::size_t begin = 0; begin < map.size() && alive_; begin += kMaxBlocksPerPart) {
      const std::size_t count = std::min(kMaxBlocksPerPart, map.size() - begin);
      AddBlocks(id, std::span(map).subspan(begin, count));
    }
  }
  void AddBlocks(ObjectId id, std::span<const BlockDelta> blocks) {
    v1::MapPart* proto = part_.add_maps();
    proto->set_object_id(id);
    proto->set_zstd_block_deltas(CompressBlocks(blocks));
    Added(proto->zstd_block_deltas().size());
  }
  void AddDynamic(std::span<const DynamicVoxel> voxels) {
    constexpr std::size_t kMost = 1 << 15;
    for (; !voxels.empty() && alive_; voxels = voxels.subspan(std::min(kMost, voxels.size()))) {
      v1::DynamicVoxels* proto = part_.add_dynamic();
      Write(voxels.first(std::min(kMost, voxels.size())), head_.stamp, proto);
      Added(proto->ByteSizeLong());
    }
  }
  void AddObject(const ObjectDelta& object) {
    v1::ObjectDelta* proto = part_.add_objects();
    proto->set_object_id(object.id);
    proto->mutable_other_ids()->Add(object.also.begin(), object.also.end());
    for (const Time told : object.older_ids_told) {
      proto->add_older_ids_told_ns(ToNanoseconds(told));
    }
    proto->set_part_of_id(object.part_of);
    if (object.completion) {
      proto->mutable_completion()->set_yaw_rad(object.completion->yaw_rad);
      proto->mutable_completion()->set_unseen_end(object.completion->unseen_end);
      proto->mutable_completion()->set_length_seen(object.completion->length_seen);
    }
    for (const StampedPose& entry : object.history) {
      proto->add_history_ns(ToNanoseconds(entry.stamp));
      Append(entry.T_W_O, proto->mutable_history_world_from_object());
    }
    if (object.velocity_O) Write(*object.velocity_O, proto->mutable_velocity_object());
    if (!(object.bound == PositionBound{})) Write(object.bound, proto->mutable_bound());
    proto->set_tracked_since_ns(ToNanoseconds(object.tracked_since));
    proto->set_placed_at_ns(ToNanoseconds(object.placed_at));
    proto->set_estimated(object.estimated);
    proto->set_reported(object.reported);
    if (object.T_B_O) Write(*object.T_B_O, proto->mutable_box_from_object());
    proto->set_first_seen_ns(ToNanoseconds(object.first_seen));
    proto->set_last_seen_ns(ToNanoseconds(object.last_seen));
    proto->set_frames_seen(object.frames_seen);
    proto->set_bridged(object.bridged);
    if (!object.future.empty()) Write(object.future, proto->mutable_future());
    proto->set_keeps_future(object.keeps_future);
    if (!(object.future_velocity_O == Twist{})) {
      Write(object.future_velocity_O, proto->mutable_future_velocity_object());
    }
    proto->set_given(object.given);
    if (object.given_shape != nullptr) Write(*object.given_shape, proto->mutable_given_shape());
    Added(proto->ByteSizeLong());
  }

  const SceneDifference& difference_;
  const SceneDelta head_;
  const std::function<bool(const v1::SceneDeltaPart&)>& send_;
  v1::SceneDeltaPart part_;
  std::uint32_t next_part_ = 0;
  std::size_t bytes_ = 0;
  bool alive_ = true;
};

absl::StatusOr<ObjectDelta> ReadObjectDelta(const std::string& field,
                                            const v1::ObjectDelta& proto) {
  FieldReader read(field + ".");
  ObjectDelta object;
  object.id = proto.object_id();
  object.also.assign(proto.other_ids().begin(), proto.other_ids().end());
  for (const std::int64_t told_ns : proto.older_ids_told_ns()) {
    object.older_ids_told.push_back(read.Stamp("older_ids_told_ns", true, told_ns));
  }
  object.part_of = proto.part_of_id();
  if (proto.has_completion()) {
    const v1::Completion& completion = proto.completion();
    object.completion = {completion.yaw_rad(), completion.unseen_end(), completion.length_seen()};
  }
  const std::vector<Pose> poses = read.Poses(
      "history_world_from_object", proto.history_world_from_object(), proto.history_ns_size());
  for (int i = 0; i < proto.history_ns_size() && read.ok(); ++i) {
    object.history.push_back({read.Stamp("history_ns", true, proto.history_ns(i)), poses[i]});
  }
  if (proto.has_velocity_object()) {
    object.velocity_O = read.ReadTwist("velocity_object", proto.velocity_object());
  }
  if (proto.has_bound()) object.bound = read.ReadBound("bound", proto.bound());
  object.tracked_since = read.Stamp("tracked_since_ns", true, proto.tracked_since_ns());
  object.placed_at = read.Stamp("placed_at_ns", true, proto.placed_at_ns());
  object.estimated = proto.estimated();
  object.reported = proto.reported();
  if (proto.has_box_from_object()) {
    object.T_B_O = read.ReadPose("box_from_object", true, proto.box_from_object());
  }
  object.first_seen = read.Stamp("first_seen_ns", true, proto.first_seen_ns());
  object.last_seen = read.Stamp("last_seen_ns", true, proto.last_seen_ns());
  object.frames_seen = proto.frames_seen();
  object.bridged = proto.bridged();
  object.future = read.ReadTimedPoses("future", proto.future(), kMaxFuturePoses);
  object.keeps_future = proto.keeps_future();
  if (proto.has_future_velocity_object()) {
    object.future_velocity_O =
        read.ReadTwist("future_velocity_object", proto.future_velocity_object());
  }
  object.given = proto.given();
  if (proto.has_given_shape()) {
    object.given_shape =
        std::make_shared<const Shape>(ReadConvexShape("given_shape", proto.given_shape(), read));
  }
  if (!read.ok()) return read.status();
  return object;
}

}  // namespace

bool WriteDifference(const SceneDifference& difference,
                     const std::function<bool(const v1::SceneDeltaPart&)>& send) {
  return DeltaWriter(difference, send).Run();
}

absl::Status DeltaAssembler::Begin(const v1::SceneDeltaPart& part) {
  delta_ = {};
  objects_.clear();
  dynamic_.clear();
  FieldReader read;
  delta_.from_version = part.from_version();
  delta_.to_version = part.to_version();
  delta_.stamp = read.Stamp("stamp_ns", true, part.stamp_ns());
  if (!read.ok()) return read.status();
  if (part.dynamic_changed()) delta_.dynamic_W.emplace();
  if (!part.has_params()) return absl::OkStatus();
  absl::StatusOr<SceneParams> params = ReadSceneParams("params", part.params());
  if (params.ok()) delta_.params = *std::move(params);
  return params.status();
}

absl::Status DeltaAssembler::AddObjects(const v1::SceneDeltaPart& part) {
  for (int i = 0; i < part.objects_size(); ++i) {
    const std::string field = absl::StrCat("objects[", i, "]");
    absl::StatusOr<ObjectDelta> object = ReadObjectDelta(field, part.objects(i));
    if (!object.ok()) return object.status();
    if (!objects_.emplace(object->id, delta_.objects.size()).second) {
      return FieldError(field + ".object_id", "occurs twice");
    }
    delta_.objects.push_back(*std::move(object));
  }
  delta_.removed.insert(delta_.removed.end(), part.removed_object_ids().begin(),
                        part.removed_object_ids().end());
  return absl::OkStatus();
}

absl::Status DeltaAssembler::AddMaps(const v1::SceneDeltaPart& part) {
  for (int i = 0; i < part.maps_size(); ++i) {
    const v1::MapPart& map = part.maps(i);
    const std::string field = absl::StrCat("maps[", i, "]");
    const auto object = objects_.find(map.object_id());
    if (map.object_id() != kStaticLabel && object == objects_.end()) {
      return FieldError(field + ".object_id", "is not among the objects sent so far");
    }
    absl::StatusOr<MapDelta> blocks = DecompressBlocks(
        field + ".zstd_block_deltas", map.zstd_block_deltas(), kMaxBlocksPerPart, kMaxPartBytes);
    if (!blocks.ok()) return blocks.status();
    MapDelta& target = map.object_id() == kStaticLabel ? delta_.static_map_W
                                                       : delta_.objects[object->second].map_O;
    target.insert(target.end(), std::make_move_iterator(blocks->begin()),
                  std::make_move_iterator(blocks->end()));
  }
  return absl::OkStatus();
}

absl::Status DeltaAssembler::AddDynamic(const v1::SceneDeltaPart& part) {
  FieldReader read;
  for (const v1::DynamicVoxels& proto : part.dynamic()) {
    read.Require(delta_.dynamic_W.has_value(), "dynamic", "is said not to differ");
    ReadDynamic(proto, delta_.stamp, read, dynamic_);
  }
  return read.ok() ? absl::OkStatus() : read.status();
}

absl::StatusOr<std::optional<SceneDelta>> DeltaAssembler::Add(const v1::SceneDeltaPart& part) {
  if (part.part() != next_part_ ||
      (next_part_ > 0 &&
       (part.to_version() != delta_.to_version || part.from_version() != delta_.from_version))) {
    return absl::FailedPreconditionError(absl::StrCat(
        "part: is ", part.part(), " of version ", part.to_version(), "; expected ", next_part_));
  }
  if (part.part() == 0) {
    if (absl::Status status = Begin(part); !status.ok()) return status;
  }
  if (absl::Status status = AddObjects(part); !status.ok()) return status;
  if (absl::Status status = AddMaps(part); !status.ok()) return status;
  if (absl::Status status = AddDynamic(part); !status.ok()) return status;
  ++next_part_;
  if (!part.last()) return std::nullopt;
  next_part_ = 0;
  objects_.clear();
  if (delta_.dynamic_W) delta_.dynamic_W = DynamicSpace(std::exchange(dynamic_, {}));
  return std::optional<SceneDelta>(std::move(delta_));
}

}  // namespace clearway
