// The calls of SceneClient that hold, export or change the scene.
#include "clearway/client/scene_client.h"
#include "client/call.h"
#include "wire/geometry_wire.h"
#include "wire/object_wire.h"
#include "wire/scene_wire.h"

namespace clearway {
namespace {

constexpr std::size_t kPieceBytes = 1 << 20;

v1::MapFormat ToProto(MapFormat format) {
  return format == MapFormat::kBt   ? v1::MAP_FORMAT_BT
         : format == MapFormat::kOt ? v1::MAP_FORMAT_OT
                                    : v1::MAP_FORMAT_PLY;
}

template <class Stub, class Request, class Response>
absl::StatusOr<Versioned> Change(const Connection& connection, const std::unique_ptr<Stub>& stub,
                                 grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&,
                                                              Response*),
                                 const Request& request) {
  auto response = Call(connection.options(), *stub, method, request);
  if (!response.ok()) return response.status();
  return ReadVersion(response->scene());
}

}  // namespace

absl::StatusOr<LeaseGrant> SceneClient::AcquireLease(Duration ttl, const SceneQuery& query) const {
  v1::AcquireLeaseRequest request;
  Write(query, request.mutable_selector());
  request.set_ttl_s(ToSeconds(ttl));
  auto response = Call(connection_->options(), *connection_->impl().lease,
                       &v1::LeaseService::Stub::AcquireLease, request);
  if (!response.ok()) return response.status();
  return LeaseGrant{ReadVersion(response->scene()), response->lease_id(),
                    FromSeconds(response->granted_ttl_s())};
}

absl::StatusOr<LeaseGrant> SceneClient::RenewLease(const std::string& lease_id,
                                                   Duration ttl) const {
  v1::RenewLeaseRequest request;
  request.set_lease_id(lease_id);
  request.set_ttl_s(ToSeconds(ttl));
  auto response = Call(connection_->options(), *connection_->impl().lease,
                       &v1::LeaseService::Stub::RenewLease, request);
  if (!response.ok()) return response.status();
  return LeaseGrant{ReadVersion(response->scene()), lease_id,
                    FromSeconds(response->granted_ttl_s())};
}

absl::Status SceneClient::ReleaseLease(const std::string& lease_id) const {
  v1::ReleaseLeaseRequest request;
  request.set_lease_id(lease_id);
  return Change(*connection_, connection_->impl().lease, &v1::LeaseService::Stub::ReleaseLease,
                request)
      .status();
}

absl::StatusOr<Versioned> SceneClient::ExportMap(
    const ExportTarget& target, MapFormat format,
    const std::function<absl::Status(std::string_view)>& sink, const SceneQuery& query) const {
  v1::ExportMapRequest request;
  Write(query, request.mutable_selector());
  request.set_format(ToProto(format));
  if (const auto* object = std::get_if<ObjectTarget>(&target)) {
    request.set_object_id(object->id);
  } else if (const auto* at = std::get_if<SceneAtTarget>(&target)) {
    request.set_scene_at_ns(ToNanoseconds(at->time));
  } else {
    request.set_static_map(true);
  }
  grpc::ClientContext context;  // a long stream: no deadline
  const auto stream = connection_->impl().map->ExportMap(&context, request);
  Versioned scene;
  absl::Status sunk;
  v1::ExportMapResponse response;
  while (sunk.ok() && stream->Read(&response)) {
    scene = ReadVersion(response.scene());
    sunk = sink(response.data());
  }
  if (!sunk.ok()) context.TryCancel();
  const absl::Status status = FromGrpc(stream->Finish());
  if (!sunk.ok()) return sunk;
  if (!status.ok()) return status;
  return scene;
}

absl::StatusOr<Versioned> SceneClient::LoadPrior(MapFormat format,
                                                 std::string_view file_bytes) const {
  grpc::ClientContext context;  // a long stream: no deadline
  v1::LoadPriorResponse response;
  const auto stream = connection_->impl().map->LoadPrior(&context, &response);
  v1::LoadPriorRequest request;
  request.set_format(ToProto(format));
  std::size_t begin = 0;
  do {
    const std::string_view piece = file_bytes.substr(begin, kPieceBytes);
    request.set_data(piece.data(), piece.size());
    if (!stream->Write(request)) break;  // Finish says why
    begin += piece.size();
  } while (begin < file_bytes.size());
  stream->WritesDone();
  if (const absl::Status status = FromGrpc(stream->Finish()); !status.ok()) return status;
  return ReadVersion(response.scene());
}

absl::StatusOr<ClearedRegion> SceneClient::ClearRegion(const Aabb& box_W) const {
  v1::ClearRegionRequest request;
  Write(box_W, request.mutable_box_world());
  const auto response = Call(connection_->options(), *connection_->impl().map,
                             &v1::MapService::Stub::ClearRegion, request);
  if (!response.ok()) return response.status();
  return ClearedRegion{ReadVersion(response->scene()), response->voxels_cleared(),
                       response->voxels_in_box()};
}

absl::StatusOr<Versioned> SceneClient::SetKeepOut(std::span<const Aabb> boxes_W) const {
  v1::SetKeepOutRequest request;
  for (const Aabb& box : boxes_W) Write(box, request.add_boxes_world());
  return Change(*connection_, connection_->impl().map, &v1::MapService::Stub::SetKeepOut, request);
}

absl::StatusOr<Versioned> SceneClient::Reset() const {
  return Change(*connection_, connection_->impl().map, &v1::MapService::Stub::Reset,
                v1::ResetRequest());
}

absl::StatusOr<Versioned> SceneClient::AddObjects(std::span<const GivenObject> objects) const {
  v1::AddObjectsRequest request;
  for (const GivenObject& object : objects) Write(object, request.add_objects());
  return Change(*connection_, connection_->impl().object, &v1::ObjectService::Stub::AddObjects,
                request);
}

absl::StatusOr<Versioned> SceneClient::RemoveObjects(std::span<const ObjectId> ids) const {
  v1::RemoveObjectsRequest request;
  request.mutable_object_ids()->Add(ids.begin(), ids.end());
  return Change(*connection_, connection_->impl().object, &v1::ObjectService::Stub::RemoveObjects,
                request);
}

absl::StatusOr<Versioned> SceneClient::SetFutures(std::span<const ObjectFuture> futures) const {
  v1::SetFuturesRequest request;
  for (const ObjectFuture& future : futures) Write(future, request.add_futures());
  return Change(*connection_, connection_->impl().object, &v1::ObjectService::Stub::SetFutures,
                request);
}

}  // namespace clearway
