#include <algorithm>
#include <cstdint>

#include "absl/strings/str_cat.h"
#include "server/describe_objects.h"
#include "server/handler.h"
#include "server/queries.h"
#include "server/services.h"
#include "wire/object_wire.h"

namespace clearway {
namespace {

constexpr std::uint64_t kPoseBytes = 64;  // of eight numbers in a reply

absl::Status KnowingObjects(absl::Status status) {
  return absl::IsNotFound(status) ? WithReason(std::move(status), "UNKNOWN_OBJECT") : status;
}

}  // namespace

grpc::Status ObjectHandlers::ListObjects(grpc::ServerContext* context,
                                         const v1::ListObjectsRequest* request,
                                         v1::ListObjectsResponse* response) {
  return HandleQuery(core_, context, "ListObjects", *request, *response,
                     [&](const SceneSnapshot& scene, const Gone& gone) -> absl::Status {
                       const absl::StatusOr<ObjectList> list = DescribeObjects(scene, gone);
                       if (!list.ok()) return list.status();
                       Write(VersionOf(scene), response->mutable_scene());
                       for (const ObjectInfo& object : list->objects) {
                         Write(object, response->add_objects());
                       }
                       return absl::OkStatus();
                     });
}

grpc::Status ObjectHandlers::GetObject(grpc::ServerContext* context,
                                       const v1::GetObjectRequest* request,
                                       v1::GetObjectResponse* response) {
  return HandleQuery(core_, context, "GetObject", *request, *response,
                     [&](const SceneSnapshot& scene, const Gone&) {
                       const MovingObject* object = scene.FindObject(request->object_id());
                       if (object == nullptr) {
                         return WithReason(absl::NotFoundError(absl::StrCat(
                                               "object_id: version ", scene.version,
                                               " has no object ", request->object_id())),
                                           "UNKNOWN_OBJECT");
                       }
                       Write(VersionOf(scene), response->mutable_scene());
                       Write(DescribeObject(scene, *object), response->mutable_object());
                       return absl::OkStatus();
                     });
}

grpc::Status ObjectHandlers::PredictPoses(grpc::ServerContext* context,
                                          const v1::PredictPosesRequest* request,
                                          v1::PredictPosesResponse* response) {
  return HandleQuery(
      core_, context, "PredictPoses", *request, *response,
      [&](const SceneSnapshot& scene, const Gone& gone) -> absl::Status {
        FieldReader read;
        const ServerLimits& limits = core_.config.limits;
        const std::uint64_t limit =
            std::min(limits.max_points_per_query, limits.max_message_bytes / kPoseBytes);
        read.AtMost("times_ns", request->times_ns_size(), limit);
        read.AtMost("object_ids", request->object_ids_size(), limit);
        read.Require(!request->times_ns().empty(), "times_ns", "is empty");
        if (!read.ok()) return read.status();
        const std::vector<Time> times =
            read.Times("times_ns", request->times_ns(), request->times_ns_size());
        if (!read.ok()) return read.status();
        absl::StatusOr<PredictedPoses> poses =
            AskPoses(scene, std::span(request->object_ids().data(), request->object_ids().size()),
                     times, limit, gone);
        if (!poses.ok()) return poses.status();
        Write(*poses, response);
        return absl::OkStatus();
      });
}

grpc::Status ObjectHandlers::AddObjects(grpc::ServerContext* context,
                                        const v1::AddObjectsRequest* request,
                                        v1::AddObjectsResponse* response) {
  return HandleUnary(core_, context, "AddObjects", *request, *response, [&]() -> absl::Status {
    absl::StatusOr<std::vector<GivenObject>> objects =
        ReadGivenObjects(*request, core_.config.limits);
    if (!objects.ok()) return objects.status();
    const auto change = [objects = *std::move(objects)](SceneBuilder& builder) {
      return builder.AddObjects(objects);
    };
    return ApplyChange(core_, context, change, Ingestor::Effect::kAdds, response);
  });
}

grpc::Status ObjectHandlers::RemoveObjects(grpc::ServerContext* context,
                                           const v1::RemoveObjectsRequest* request,
                                           v1::RemoveObjectsResponse* response) {
  return HandleUnary(core_, context, "RemoveObjects", *request, *response, [&]() -> absl::Status {
    FieldReader read;
    read.AtMost("object_ids", request->object_ids_size(), core_.config.limits.max_objects);
    if (!read.ok()) return read.status();
    const std::vector<ObjectId> ids(request->object_ids().begin(), request->object_ids().end());
    const auto change = [ids](SceneBuilder& builder) {
      return KnowingObjects(builder.RemoveObjects(ids));
    };
    return ApplyChange(core_, context, change, Ingestor::Effect::kTakesAway, response);
  });
}

grpc::Status ObjectHandlers::SetFutures(grpc::ServerContext* context,
                                        const v1::SetFuturesRequest* request,
                                        v1::SetFuturesResponse* response) {
  return HandleUnary(core_, context, "SetFutures", *request, *response, [&]() -> absl::Status {
    absl::StatusOr<std::vector<ObjectFuture>> futures = ReadFutures(*request, core_.config.limits);
    if (!futures.ok()) return futures.status();
    const auto change = [futures = *std::move(futures)](SceneBuilder& builder) {
      return KnowingObjects(builder.SetFutures(futures));
    };
    return ApplyChange(core_, context, change, Ingestor::Effect::kAdds, response);
  });
}

}  // namespace clearway
