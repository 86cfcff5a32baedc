#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"
#include "clearway/io/octomap_file.h"
#include "server/handler.h"
#include "server/map_export.h"
#include "server/services.h"

namespace clearway {
namespace {

absl::StatusOr<ExportTarget> ReadTarget(const v1::ExportMapRequest& request) {
  FieldReader read;
  switch (request.map_case()) {
    case v1::ExportMapRequest::kStaticMap:
      return StaticMapTarget{};
    case v1::ExportMapRequest::kObjectId:
      return ObjectTarget{request.object_id()};
    case v1::ExportMapRequest::kSceneAtNs: {
      const SceneAtTarget target{read.Stamp("scene_at_ns", true, request.scene_at_ns())};
      if (!read.ok()) return read.status();
      return target;
    }
    case v1::ExportMapRequest::MAP_NOT_SET:
      break;
  }
  return FieldError("map", "is missing: static_map, object_id or scene_at_ns");
}

absl::StatusOr<MapFormat> ReadFormat(int proto) {
  switch (proto) {
    case v1::MAP_FORMAT_BT:
      return MapFormat::kBt;
    case v1::MAP_FORMAT_OT:
      return MapFormat::kOt;
    case v1::MAP_FORMAT_PLY:
      return MapFormat::kPly;
    default:
      return FieldError("format", "must be one of BT, OT and PLY");
  }
}

// The bytes of all pieces; RESOURCE_EXHAUSTED before more is kept than allowed.
absl::StatusOr<std::string> ReadPieces(ServerCore& core, grpc::ServerContext& context,
                                       grpc::ServerReader<v1::LoadPriorRequest>& reader,
                                       int& format) {
  const std::uint64_t max_bytes = core.config.limits.max_prior_bytes;
  std::string bytes;
  v1::LoadPriorRequest request;
  Received received;
  bool first = true;
  while ((received = ReadNext(reader, request, context, core.streams)) == Received::kMessage) {
    if (std::exchange(first, false)) format = request.format();
    const std::uint64_t size = bytes.size() + request.data().size();
    if (size > max_bytes) return LimitError("data", size, max_bytes);
    if (size > bytes.capacity()) {  // which takes a copy
      if (absl::Status status = core.memory.Room(size); !status.ok()) return status;
    }
    bytes += request.data();
  }
  if (received == Received::kGarbage) return GarbageError();
  return bytes;
}

// As many as fill all blocks of the scene.
std::int64_t MaxVoxelsOf(const ServerLimits& limits) {
  constexpr std::int64_t kVoxelsPerBlock = kBlockSize * kBlockSize * kBlockSize;
  const std::int64_t most = OctomapLimits().max_voxels / kVoxelsPerBlock;
  return kVoxelsPerBlock *
         std::min<std::int64_t>(most, static_cast<std::int64_t>(limits.max_blocks));
}

// A small file may hold a large map.
absl::StatusOr<OctomapFile> Parse(ServerCore& core, const grpc::ServerContext* context,
                                  const std::string& bytes) {
  constexpr int kLooks = 64;  // from one look at the memory to the next
  const ServerLimits& server = core.config.limits;
  OctomapLimits limits;
  limits.max_bytes = server.max_prior_bytes;
  limits.max_voxels = MaxVoxelsOf(server);
  const Gone must_end = WorkOf(core, context);
  absl::Status room;
  int looks = 0;
  absl::StatusOr<OctomapFile> file =
      ParseOctomap("data", bytes, core.config.scene.Model(), limits, [&] {
        if (++looks % kLooks == 0) room = core.memory.Room();
        return !room.ok() || must_end();
      });
  if (!room.ok()) return room;
  if (!absl::IsResourceExhausted(file.status())) return file;
  return absl::ResourceExhaustedError(
      absl::StrCat(std::string(file.status().message()), " (limits.max_prior_bytes is ",
                   server.max_prior_bytes, ", limits.max_blocks ", server.max_blocks, ")"));
}

// Boxes without a volume would keep nothing out.
absl::Status CheckVolumes(const std::vector<Aabb>& boxes_W) {
  for (std::size_t i = 0; i < boxes_W.size(); ++i) {
    const Eigen::Vector3d size_m = boxes_W[i].Size();
    for (int axis = 0; axis < 3; ++axis) {
      if (size_m[axis] > 0) continue;
      return FieldError(absl::StrCat("boxes_world[", i, "].max_m.", std::string(1, "xyz"[axis])),
                        absl::StrCat("is ", NumberText(boxes_W[i].max[axis]),
                                     ", as the minimum; it must be above it"));
    }
  }
  return absl::OkStatus();
}

}  // namespace

grpc::Status MapHandlers::ExportMap(grpc::ServerContext* context,
                                    const v1::ExportMapRequest* request,
                                    grpc::ServerWriter<v1::ExportMapResponse>* writer) {
  return Handle(core_, context, "ExportMap", *request, [&]() -> absl::Status {
    const absl::StatusOr<MapFormat> format = ReadFormat(request->format());
    if (!format.ok()) return format.status();
    const absl::StatusOr<ExportTarget> target = ReadTarget(*request);
    if (!target.ok()) return target.status();
    const auto scene = core_.SceneFor(request->selector(), GoneOf(core_, context));
    if (!scene.ok()) return scene.status();
    Work work(core_, context);
    v1::ExportMapResponse response;
    Write(VersionOf(**scene), response.mutable_scene());
    const auto send = [&](std::string_view piece) {
      response.set_data(std::string(piece));
      work.Rest();
      return WriteTo(*writer, response, *context, core_.streams) && !work.MustEnd();
    };
    return ExportTo(send, **scene, *target, *format, [&] { return work.MustEnd(); });
  });
}

grpc::Status MapHandlers::LoadPrior(grpc::ServerContext* context,
                                    grpc::ServerReader<v1::LoadPriorRequest>* reader,
                                    v1::LoadPriorResponse* response) {
  return HandleStream(core_, context, "LoadPrior", [&]() -> absl::Status {
    int format = v1::MAP_FORMAT_UNSPECIFIED;
    absl::StatusOr<std::string> bytes = ReadPieces(core_, *context, *reader, format);
    if (!bytes.ok()) return bytes.status();
    if (format != v1::MAP_FORMAT_BT && format != v1::MAP_FORMAT_OT) {
      return FieldError("format", "must be BT or OT, in the first message");
    }
    absl::StatusOr<OctomapFile> file = Parse(core_, context, *bytes);
    if (!file.ok()) return file.status();
    const OctomapFormat wanted =
        format == v1::MAP_FORMAT_BT ? OctomapFormat::kBinary : OctomapFormat::kFull;
    if (file->format != wanted) return FieldError("format", "is not what the data is");
    return ApplyChange(
        core_, context,
        [map = std::move(file->map)](SceneBuilder& builder) { return builder.LoadPrior(map); },
        Ingestor::Effect::kAdds, response);
  });
}

grpc::Status MapHandlers::ClearRegion(grpc::ServerContext* context,
                                      const v1::ClearRegionRequest* request,
                                      v1::ClearRegionResponse* response) {
  return HandleUnary(core_, context, "ClearRegion", *request, *response, [&]() -> absl::Status {
    FieldReader read;
    const Aabb box_W = read.Box("box_world", request->has_box_world(), request->box_world());
    if (!read.ok()) return read.status();
    // The writer may come to it when this call has been given up.
    const auto cleared = std::make_shared<std::int64_t>(0);
    const auto change = [box_W, cleared](SceneBuilder& builder) {
      *cleared = builder.ClearRegion(box_W);
      return absl::OkStatus();
    };
    const absl::Status status =
        ApplyChange(core_, context, change, Ingestor::Effect::kTakesAway, response);
    if (!status.ok()) return status;
    const VoxelGrid grid(core_.config.scene.resolution_m);
    response->set_voxels_cleared(static_cast<std::uint64_t>(*cleared));
    response->set_voxels_in_box(static_cast<std::uint64_t>(grid.CentersIn(box_W).count()));
    return absl::OkStatus();
  });
}

grpc::Status MapHandlers::SetKeepOut(grpc::ServerContext* context,
                                     const v1::SetKeepOutRequest* request,
                                     v1::SetKeepOutResponse* response) {
  return HandleUnary(core_, context, "SetKeepOut", *request, *response, [&]() -> absl::Status {
    FieldReader read;
    read.AtMost("boxes_world", request->boxes_world_size(), core_.config.limits.max_boxes);
    std::vector<Aabb> boxes_W;
    for (int i = 0; i < request->boxes_world_size() && read.ok(); ++i) {
      boxes_W.push_back(
          read.Box(absl::StrCat("boxes_world[", i, "]"), true, request->boxes_world(i)));
    }
    if (!read.ok()) return read.status();
    if (auto status = CheckVolumes(boxes_W); !status.ok()) return status;
    const auto change = [boxes_W](SceneBuilder& builder) {
      builder.SetKeepOut(boxes_W);
      return absl::OkStatus();
    };
    return ApplyChange(core_, context, change, Ingestor::Effect::kTakesAway, response);
  });
}

grpc::Status MapHandlers::Reset(grpc::ServerContext* context, const v1::ResetRequest* request,
                                v1::ResetResponse* response) {
  return HandleUnary(core_, context, "Reset", *request, *response, [&]() -> absl::Status {
    const auto change = [](SceneBuilder& builder) {
      builder.Reset();
      return absl::OkStatus();
    };
    return ApplyChange(core_, context, change, Ingestor::Effect::kBeginsAnew, response);
  });
}

}  // namespace clearway
