#include "clearway/client/scene_client.h"

#include "client/call.h"
#include "wire/geometry_wire.h"
#include "wire/object_wire.h"
#include "wire/occupancy_wire.h"
#include "wire/scene_wire.h"
#include "wire/server_wire.h"

namespace clearway {
namespace {

template <class Stub, class Request, class Response, class Read>
auto Ask(const Connection& connection, const std::unique_ptr<Stub>& stub,
         grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Response*),
         const Request& request, Read&& read) -> decltype(read(Response())) {
  auto response = Call(connection.options(), *stub, method, request);
  if (!response.ok()) return response.status();
  return read(*response);
}

void Write(std::span<const Time> times, google::protobuf::RepeatedField<std::int64_t>* proto) {
  for (Time time : times) proto->Add(ToNanoseconds(time));
}

void Write(std::span<const Eigen::Vector3f> points, google::protobuf::RepeatedField<float>* proto) {
  for (const Eigen::Vector3f& point : points) {
    for (int i = 0; i < 3; ++i) proto->Add(point[i]);
  }
}

}  // namespace

absl::StatusOr<ServerInfo> SceneClient::GetServerInfo() const {
  return Ask(*connection_, connection_->impl().info, &v1::ServerService::Stub::GetServerInfo,
             v1::GetServerInfoRequest(), ReadServerInfo);
}

absl::StatusOr<ServerStatus> SceneClient::GetStatus(bool include_hash) const {
  v1::GetStatusRequest request;
  request.set_include_hash(include_hash);
  return Ask(*connection_, connection_->impl().info, &v1::ServerService::Stub::GetStatus, request,
             ReadServerStatus);
}

absl::StatusOr<ObjectList> SceneClient::ListObjects(const SceneQuery& query) const {
  v1::ListObjectsRequest request;
  Write(query, request.mutable_selector());
  const auto read = [](const v1::ListObjectsResponse& response) -> absl::StatusOr<ObjectList> {
    ObjectList list;
    static_cast<Versioned&>(list) = ReadVersion(response.scene());
    for (const v1::ObjectInfo& proto : response.objects()) {
      auto object = ReadObject(proto);
      if (!object.ok()) return object.status();
      list.objects.push_back(*std::move(object));
    }
    return list;
  };
  return Ask(*connection_, connection_->impl().object, &v1::ObjectService::Stub::ListObjects,
             request, read);
}

absl::StatusOr<ObjectInfo> SceneClient::GetObject(ObjectId id, const SceneQuery& query) const {
  v1::GetObjectRequest request;
  Write(query, request.mutable_selector());
  request.set_object_id(id);
  return Ask(*connection_, connection_->impl().object, &v1::ObjectService::Stub::GetObject, request,
             [](const v1::GetObjectResponse& response) { return ReadObject(response.object()); });
}

absl::StatusOr<PredictedPoses> SceneClient::PredictPoses(std::span<const ObjectId> ids,
                                                         std::span<const Time> times,
                                                         const SceneQuery& query) const {
  v1::PredictPosesRequest request;
  Write(query, request.mutable_selector());
  request.mutable_object_ids()->Add(ids.begin(), ids.end());
  Write(times, request.mutable_times_ns());
  return Ask(*connection_, connection_->impl().object, &v1::ObjectService::Stub::PredictPoses,
             request, [&](const v1::PredictPosesResponse& response) {
               return ReadPredictedPoses(response, times.size());
             });
}

absl::StatusOr<PointAnswers> SceneClient::OccupancyOfPoints(
    std::span<const Eigen::Vector3f> points_W, std::span<const Time> times,
    const SceneQuery& query) const {
  v1::GetPointOccupancyRequest request;
  Write(query, request.mutable_selector());
  Write(points_W, request.mutable_points_m());
  Write(times, request.mutable_times_ns());
  return Ask(*connection_, connection_->impl().occupancy,
             &v1::OccupancyService::Stub::GetPointOccupancy, request, ReadPoints);
}

absl::StatusOr<BoxOccupancy> SceneClient::OccupancyOfBox(const Aabb& box_W,
                                                         std::span<const Time> times,
                                                         bool include_cells,
                                                         const SceneQuery& query) const {
  v1::GetBoxOccupancyRequest request;
  Write(query, request.mutable_selector());
  Write(box_W, request.mutable_box_world());
  Write(times, request.mutable_times_ns());
  request.set_include_cells(include_cells);
  return Ask(*connection_, connection_->impl().occupancy,
             &v1::OccupancyService::Stub::GetBoxOccupancy, request, ReadBoxOccupancy);
}

absl::StatusOr<SliceOccupancy> SceneClient::OccupancyOfSlice(const SliceQuestion& slice,
                                                             std::span<const Time> times,
                                                             const SceneQuery& query) const {
  v1::GetSliceOccupancyRequest request;
  Write(query, request.mutable_selector());
  request.set_z_m(slice.z_m);
  request.set_min_x_m(slice.min_W.x());
  request.set_min_y_m(slice.min_W.y());
  request.set_max_x_m(slice.max_W.x());
  request.set_max_y_m(slice.max_W.y());
  if (slice.cell_m) request.set_cell_m(*slice.cell_m);
  Write(times, request.mutable_times_ns());
  return Ask(*connection_, connection_->impl().occupancy,
             &v1::OccupancyService::Stub::GetSliceOccupancy, request, ReadSlice);
}

absl::StatusOr<RayAnswers> SceneClient::CastRays(std::span<const Eigen::Vector3f> origins_W,
                                                 std::span<const Eigen::Vector3f> directions_W,
                                                 std::span<const Time> times, double max_range_m,
                                                 const SceneQuery& query) const {
  v1::CastRaysRequest request;
  Write(query, request.mutable_selector());
  Write(origins_W, request.mutable_origins_m());
  Write(directions_W, request.mutable_directions());
  Write(times, request.mutable_times_ns());
  request.set_max_range_m(max_range_m);
  return Ask(*connection_, connection_->impl().occupancy, &v1::OccupancyService::Stub::CastRays,
             request, ReadRays);
}

}  // namespace clearway
