// The gRPC services. Handlers translate between the wire and the server's parts, nothing else; the
// synchronous API suits them, as every handler either computes on its own thread or waits.
#pragma once

#include "clearway/v1/check_service.grpc.pb.h"
#include "clearway/v1/follow_service.grpc.pb.h"
#include "clearway/v1/ingest_service.grpc.pb.h"
#include "clearway/v1/lease_service.grpc.pb.h"
#include "clearway/v1/map_service.grpc.pb.h"
#include "clearway/v1/object_service.grpc.pb.h"
#include "clearway/v1/occupancy_service.grpc.pb.h"
#include "clearway/v1/plan_service.grpc.pb.h"
#include "clearway/v1/server_service.grpc.pb.h"
#include "server/core.h"

namespace clearway {

// Any thread may call any handler. The core must outlive the services.
class CheckHandlers final : public v1::CheckService::Service {
 public:
  explicit CheckHandlers(ServerCore& core) : core_(core) {}
  grpc::Status RegisterRobot(grpc::ServerContext* context, const v1::RegisterRobotRequest* request,
                             v1::RegisterRobotResponse* response) override;
  grpc::Status CheckStates(grpc::ServerContext* context, const v1::CheckStatesRequest* request,
                           v1::CheckStatesResponse* response) override;
  grpc::Status CheckMotions(grpc::ServerContext* context, const v1::CheckMotionsRequest* request,
                            v1::CheckMotionsResponse* response) override;
  grpc::Status WatchMotions(grpc::ServerContext* context, const v1::WatchMotionsRequest* request,
                            grpc::ServerWriter<v1::WatchMotionsResponse>* writer) override;
  grpc::Status FindSafeIntervals(grpc::ServerContext* context,
                                 const v1::FindSafeIntervalsRequest* request,
                                 v1::FindSafeIntervalsResponse* response) override;
  grpc::Status FindDepartureIntervals(grpc::ServerContext* context,
                                      const v1::FindDepartureIntervalsRequest* request,
                                      v1::FindDepartureIntervalsResponse* response) override;

 private:
  ServerCore& core_;
};

class FollowHandlers final : public v1::FollowService::Service {
 public:
  explicit FollowHandlers(ServerCore& core) : core_(core) {}
  grpc::Status FollowScene(grpc::ServerContext* context, const v1::FollowSceneRequest* request,
                           grpc::ServerWriter<v1::FollowSceneResponse>* writer) override;

 private:
  ServerCore& core_;
};

class IngestHandlers final : public v1::IngestService::Service {
 public:
  explicit IngestHandlers(ServerCore& core) : core_(core) {}
  grpc::Status PushFrame(grpc::ServerContext* context, const v1::PushFrameRequest* request,
                         v1::PushFrameResponse* response) override;
  grpc::Status PushFrames(
      grpc::ServerContext* context,
      grpc::ServerReaderWriter<v1::PushFramesResponse, v1::PushFramesRequest>* stream) override;

 private:
  ServerCore& core_;
};

class LeaseHandlers final : public v1::LeaseService::Service {
 public:
  explicit LeaseHandlers(ServerCore& core) : core_(core) {}
  grpc::Status AcquireLease(grpc::ServerContext* context, const v1::AcquireLeaseRequest* request,
                            v1::AcquireLeaseResponse* response) override;
  grpc::Status RenewLease(grpc::ServerContext* context, const v1::RenewLeaseRequest* request,
                          v1::RenewLeaseResponse* response) override;
  grpc::Status ReleaseLease(grpc::ServerContext* context, const v1::ReleaseLeaseRequest* request,
                            v1::ReleaseLeaseResponse* response) override;

 private:
  ServerCore& core_;
};

class MapHandlers final : public v1::MapService::Service {
 public:
  explicit MapHandlers(ServerCore& core) : core_(core) {}
  grpc::Status ExportMap(grpc::ServerContext* context, const v1::ExportMapRequest* request,
                         grpc::ServerWriter<v1::ExportMapResponse>* writer) override;
  grpc::Status LoadPrior(grpc::ServerContext* context,
                         grpc::ServerReader<v1::LoadPriorRequest>* reader,
                         v1::LoadPriorResponse* response) override;
  grpc::Status ClearRegion(grpc::ServerContext* context, const v1::ClearRegionRequest* request,
                           v1::ClearRegionResponse* response) override;
  grpc::Status SetKeepOut(grpc::ServerContext* context, const v1::SetKeepOutRequest* request,
                          v1::SetKeepOutResponse* response) override;
  grpc::Status Reset(grpc::ServerContext* context, const v1::ResetRequest* request,
                     v1::ResetResponse* response) override;

 private:
  ServerCore& core_;
};

class ObjectHandlers final : public v1::ObjectService::Service {
 public:
  explicit ObjectHandlers(ServerCore& core) : core_(core) {}
  grpc::Status ListObjects(grpc::ServerContext* context, const v1::ListObjectsRequest* request,
                           v1::ListObjectsResponse* response) override;
  grpc::Status GetObject(grpc::ServerContext* context, const v1::GetObjectRequest* request,
                         v1::GetObjectResponse* response) override;
  grpc::Status PredictPoses(grpc::ServerContext* context, const v1::PredictPosesRequest* request,
                            v1::PredictPosesResponse* response) override;
  grpc::Status AddObjects(grpc::ServerContext* context, const v1::AddObjectsRequest* request,
                          v1::AddObjectsResponse* response) override;
  grpc::Status RemoveObjects(grpc::ServerContext* context, const v1::RemoveObjectsRequest* request,
                             v1::RemoveObjectsResponse* response) override;
  grpc::Status SetFutures(grpc::ServerContext* context, const v1::SetFuturesRequest* request,
                          v1::SetFuturesResponse* response) override;

 private:
  ServerCore& core_;
};

class OccupancyHandlers final : public v1::OccupancyService::Service {
 public:
  explicit OccupancyHandlers(ServerCore& core) : core_(core) {}
  grpc::Status GetPointOccupancy(grpc::ServerContext* context,
                                 const v1::GetPointOccupancyRequest* request,
                                 v1::GetPointOccupancyResponse* response) override;
  grpc::Status GetBoxOccupancy(grpc::ServerContext* context,
                               const v1::GetBoxOccupancyRequest* request,
                               v1::GetBoxOccupancyResponse* response) override;
  grpc::Status GetSliceOccupancy(grpc::ServerContext* context,
                                 const v1::GetSliceOccupancyRequest* request,
                                 v1::GetSliceOccupancyResponse* response) override;
  grpc::Status CastRays(grpc::ServerContext* context, const v1::CastRaysRequest* request,
                        v1::CastRaysResponse* response) override;

 private:
  ServerCore& core_;
};

class PlanHandlers final : public v1::PlanService::Service {
 public:
  explicit PlanHandlers(ServerCore& core) : core_(core) {}
  grpc::Status Plan(grpc::ServerContext* context, const v1::PlanRequest* request,
                    grpc::ServerWriter<v1::PlanResponse>* writer) override;

 private:
  ServerCore& core_;
};

class InfoHandlers final : public v1::ServerService::Service {
 public:
  explicit InfoHandlers(ServerCore& core) : core_(core) {}
  grpc::Status GetServerInfo(grpc::ServerContext* context, const v1::GetServerInfoRequest* request,
                             v1::GetServerInfoResponse* response) override;
  grpc::Status GetStatus(grpc::ServerContext* context, const v1::GetStatusRequest* request,
                         v1::GetStatusResponse* response) override;

 private:
  ServerCore& core_;
};

}  // namespace clearway
