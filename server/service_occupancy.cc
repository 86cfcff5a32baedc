#include <algorithm>
#include <cstdint>

#include "server/handler.h"
#include "server/queries.h"
#include "server/services.h"
#include "wire/occupancy_wire.h"

namespace clearway {
namespace {

// The times of a question about whole areas: at least one.
std::vector<Time> ReadTimes(const google::protobuf::RepeatedField<std::int64_t>& times_ns,
                            std::uint64_t limit, FieldReader& read) {
  read.AtMost("times_ns", times_ns.size(), limit);
  read.Require(!times_ns.empty(), "times_ns", "is empty");
  if (!read.ok()) return {};
  return read.Times("times_ns", times_ns, times_ns.size());
}

constexpr std::uint64_t kCountsBytes = 32;  // of the counts of one time in a reply, at most

template <class Answer, class Response>
absl::Status Reply(const absl::StatusOr<Answer>& answer, Response* response) {
  if (answer.ok()) Write(*answer, response);
  return answer.status();
}

}  // namespace

grpc::Status OccupancyHandlers::GetPointOccupancy(grpc::ServerContext* context,
                                                  const v1::GetPointOccupancyRequest* request,
                                                  v1::GetPointOccupancyResponse* response) {
  return HandleQuery(
      core_, context, "GetPointOccupancy", *request, *response,
      [&](const SceneSnapshot& scene, const Gone& gone) -> absl::Status {
        const int points = request->points_m_size() / 3;
        FieldReader read;
        read.AtMost("points_m", points, core_.config.limits.max_points_per_query);
        read.CheckTriples("points_m", request->points_m(), true);
        read.CheckTimes("times_ns", request->times_ns(), points);
        if (!read.ok()) return read.status();
        const Eigen::Map<const Eigen::Matrix3Xf> points_W(request->points_m().data(), 3, points);
        const std::span times_ns(request->times_ns().data(), request->times_ns_size());
        PointWriter writer(VersionOf(scene), !scene.dynamic_W.voxels().empty(), points, response);
        return AskPoints(scene, points_W, times_ns, gone,
                         [&](std::size_t i, const PointOccupancy& point) { writer.Set(i, point); });
      });
}

grpc::Status OccupancyHandlers::GetBoxOccupancy(grpc::ServerContext* context,
                                                const v1::GetBoxOccupancyRequest* request,
                                                v1::GetBoxOccupancyResponse* response) {
  return HandleQuery(
      core_, context, "GetBoxOccupancy", *request, *response,
      [&](const SceneSnapshot& scene, const Gone& gone) -> absl::Status {
        const std::uint64_t limit = core_.config.limits.max_points_per_query;
        FieldReader read;
        const Aabb box_W = read.Box("box_world", request->has_box_world(), request->box_world());
        const std::uint64_t most_times = core_.config.limits.max_message_bytes / kCountsBytes;
        const auto times = ReadTimes(request->times_ns(), std::min(limit, most_times), read);
        if (!read.ok()) return read.status();
        return Reply(AskBox(scene, box_W, times, request->include_cells(), limit, gone), response);
      });
}

grpc::Status OccupancyHandlers::GetSliceOccupancy(grpc::ServerContext* context,
                                                  const v1::GetSliceOccupancyRequest* request,
                                                  v1::GetSliceOccupancyResponse* response) {
  return HandleQuery(
      core_, context, "GetSliceOccupancy", *request, *response,
      [&](const SceneSnapshot& scene, const Gone& gone) -> absl::Status {
        const std::uint64_t limit = core_.config.limits.max_points_per_query;
        FieldReader read;
        SliceQuestion slice;
        slice.z_m = read.Finite("z_m", request->z_m());
        slice.min_W = {read.Finite("min_x_m", request->min_x_m()),
                       read.Finite("min_y_m", request->min_y_m())};
        slice.max_W = {read.Finite("max_x_m", request->max_x_m()),
                       read.Finite("max_y_m", request->max_y_m())};
        read.Require(slice.min_W.x() <= slice.max_W.x(), "max_x_m", "is below min_x_m");
        read.Require(slice.min_W.y() <= slice.max_W.y(), "max_y_m", "is below min_y_m");
        if (request->has_cell_m()) slice.cell_m = read.Positive("cell_m", request->cell_m());
        const auto times = ReadTimes(request->times_ns(), limit, read);
        if (!read.ok()) return read.status();
        return Reply(AskSlice(scene, slice, times, limit, gone), response);
      });
}

grpc::Status OccupancyHandlers::CastRays(grpc::ServerContext* context,
                                         const v1::CastRaysRequest* request,
                                         v1::CastRaysResponse* response) {
  return HandleQuery(
      core_, context, "CastRays", *request, *response,
      [&](const SceneSnapshot& scene, const Gone& gone) -> absl::Status {
        FieldReader read;
        const std::uint64_t limit = core_.config.limits.max_points_per_query;
        read.AtMost("origins_m", request->origins_m_size() / 3, limit);
        const auto origins_W = read.Triples<float>("origins_m", request->origins_m(), true);
        const auto directions_W = read.Triples<float>("directions", request->directions(), true);
        read.Require(directions_W.size() == origins_W.size(), "directions",
                     "must be as many as origins_m");
        for (std::size_t i = 0; i < directions_W.size() && read.ok(); ++i) {
          if (directions_W[i].isZero(0)) {
            read.Fail("directions[" + std::to_string(3 * i) + "]", "is zero");
          }
        }
        const auto times = read.Times("times_ns", request->times_ns(), origins_W.size());
        const double max_range_m = read.Positive("max_range_m", request->max_range_m());
        if (!read.ok()) return read.status();
        return Reply(AskRays(scene, origins_W, directions_W, times, max_range_m,
                             core_.config.limits.max_ray_voxels, gone),
                     response);
      });
}

}  // namespace clearway
