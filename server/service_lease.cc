#include "server/handler.h"
#include "server/services.h"

namespace clearway {
namespace {

constexpr double kMaxTtl_s = 1e6;  // a Duration can hold it; the server's limit is lower

absl::StatusOr<Duration> ReadTtl(double ttl_s) {
  FieldReader read;
  read.Positive("ttl_s", ttl_s);
  if (!read.ok()) return read.status();
  return FromSeconds(std::min(ttl_s, kMaxTtl_s));
}

}  // namespace

grpc::Status LeaseHandlers::AcquireLease(grpc::ServerContext* context,
                                         const v1::AcquireLeaseRequest* request,
                                         v1::AcquireLeaseResponse* response) {
  return HandleUnary(
      core_, context, "AcquireLease", *request, *response, [&](const Peer& peer) -> absl::Status {
        absl::StatusOr<Duration> ttl = ReadTtl(request->ttl_s());
        if (!ttl.ok()) return ttl.status();
        absl::StatusOr<ScenePtr> scene =
            core_.SceneFor(request->selector(), GoneOf(core_, context));
        if (!scene.ok()) return scene.status();
        // The version outlives those that are kept.
        if (absl::Status room = core_.memory.Room(); !room.ok()) return room;
        absl::StatusOr<LeaseGrant> grant = core_.leases.Acquire(*scene, *ttl, peer.name);
        if (!grant.ok()) return grant.status();
        Write(static_cast<const Versioned&>(*grant), response->mutable_scene());
        response->set_lease_id(grant->id);
        response->set_granted_ttl_s(ToSeconds(grant->ttl));
        return absl::OkStatus();
      });
}

grpc::Status LeaseHandlers::RenewLease(grpc::ServerContext* context,
                                       const v1::RenewLeaseRequest* request,
                                       v1::RenewLeaseResponse* response) {
  return HandleUnary(core_, context, "RenewLease", *request, *response, [&]() -> absl::Status {
    absl::StatusOr<Duration> ttl = ReadTtl(request->ttl_s());
    if (!ttl.ok()) return ttl.status();
    absl::StatusOr<LeaseGrant> grant = core_.leases.Renew(request->lease_id(), *ttl);
    if (!grant.ok()) return grant.status();
    Write(static_cast<const Versioned&>(*grant), response->mutable_scene());
    response->set_granted_ttl_s(ToSeconds(grant->ttl));
    return absl::OkStatus();
  });
}

grpc::Status LeaseHandlers::ReleaseLease(grpc::ServerContext* context,
                                         const v1::ReleaseLeaseRequest* request,
                                         v1::ReleaseLeaseResponse* response) {
  return HandleUnary(core_, context, "ReleaseLease", *request, *response, [&] {
    core_.leases.Release(request->lease_id());
    Write(VersionOf(*core_.versions.Newest()), response->mutable_scene());
    return absl::OkStatus();
  });
}

}  // namespace clearway
