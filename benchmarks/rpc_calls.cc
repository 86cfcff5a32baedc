#include "rpc_calls.h"

#include <grpcpp/grpcpp.h>

#include "clearway/v1/occupancy_service.grpc.pb.h"
#include "clearway/v1/server_service.grpc.pb.h"
#include "server/pollers.h"

namespace clearway::bench {
namespace {

constexpr std::size_t kBatches = 8;  // that each caller asks in turn

class EchoOccupancy final : public v1::OccupancyService::Service {
 public:
  grpc::Status GetPointOccupancy(grpc::ServerContext*, const v1::GetPointOccupancyRequest* request,
                                 v1::GetPointOccupancyResponse* response) override {
    const int points = request->points_m_size() / 3;
    response->mutable_scene()->set_version(20);
    response->mutable_scene()->set_stamp_ns(1'900'000'000);
    response->mutable_statuses()->Resize(points, v1::SPACE_STATUS_FREE);
    response->mutable_object_ids()->Resize(points, 0);
    response->mutable_fused_log_odds()->Resize(points, -2);
    return grpc::Status::OK;
  }
};

class EchoInfo final : public v1::ServerService::Service {
 public:
  grpc::Status GetServerInfo(grpc::ServerContext*, const v1::GetServerInfoRequest*,
                             v1::GetServerInfoResponse*) override {
    return grpc::Status::OK;
  }
};

std::shared_ptr<grpc::Channel> OwnChannel(const std::string& address) {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  return grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments);
}

absl::Status ToStatus(const grpc::Status& status) {
  return {static_cast<absl::StatusCode>(status.error_code()), status.error_message()};
}

void SetDeadline(grpc::ClientContext& context) {
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(10));
}

}  // namespace

struct EchoServer::Impl {
  EchoOccupancy occupancy;
  EchoInfo info;
  std::unique_ptr<grpc::Server> server;
  std::string address;
};

EchoServer::EchoServer() : impl_(std::make_unique<Impl>()) {
  grpc::ServerBuilder builder;
  int port = 0;
  builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port);
  builder.RegisterService(&impl_->occupancy);
  builder.RegisterService(&impl_->info);
  SetPollers(builder);
  impl_->server = builder.BuildAndStart();
  impl_->address = "127.0.0.1:" + std::to_string(port);
}

EchoServer::~EchoServer() = default;

const std::string& EchoServer::address() const { return impl_->address; }

LoadCall PointsCall(const std::string& address, const QuestionSpace& space, std::size_t points,
                    std::uint64_t seed) {
  RandomQuestions questions(space, seed);
  std::vector<v1::GetPointOccupancyRequest> requests(kBatches);
  for (v1::GetPointOccupancyRequest& request : requests) {
    for (const Eigen::Vector3f& p_W : questions.Points(points)) {
      request.mutable_points_m()->Add(p_W.begin(), p_W.end());
    }
    for (Time time : questions.Times(points)) request.add_times_ns(ToNanoseconds(time));
  }
  const std::shared_ptr stub = v1::OccupancyService::NewStub(OwnChannel(address));
  return [stub, requests = std::move(requests), next = std::size_t{0}]() mutable {
    grpc::ClientContext context;
    SetDeadline(context);
    v1::GetPointOccupancyResponse response;
    return ToStatus(stub->GetPointOccupancy(&context, requests[next++ % kBatches], &response));
  };
}

LoadCall EmptyCall(const std::string& address) {
  const std::shared_ptr stub = v1::ServerService::NewStub(OwnChannel(address));
  return [stub] {
    grpc::ClientContext context;
    SetDeadline(context);
    v1::GetServerInfoResponse response;
    return ToStatus(stub->GetServerInfo(&context, v1::GetServerInfoRequest(), &response));
  };
}

}  // namespace clearway::bench
