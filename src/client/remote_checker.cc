#include "clearway/client/remote_checker.h"

#include <algorithm>
#include <condition_variable>
#include <iterator>
#include <mutex>
#include <span>
#include <thread>

#include "absl/strings/str_cat.h"
#include "clearway/client/scene_client.h"
#include "client/call.h"
#include "client/registered_robot.h"
#include "wire/check_wire.h"
#include "wire/interval_wire.h"
#include "wire/motion_wire.h"

namespace clearway {
namespace {

// How many states go into one request: the server's limit, and half of a message.
std::size_t StatesPerRequest(const ServerLimits& limits, std::size_t links) {
  constexpr std::size_t kBytesPerPose = 7 * sizeof(double), kBytesPerTime = 10;
  const std::size_t by_bytes =
      limits.max_message_bytes / 2 / (links * kBytesPerPose + kBytesPerTime);
  return std::max<std::size_t>(1, std::min<std::size_t>(limits.max_states_per_batch, by_bytes));
}

// ask(begin, end, knot) -> absl::Status about motions [begin, end), the first of which begins at
// `knot`, as many as have `most` knots at a time.
template <class Ask>
absl::Status InParts(const MotionBatch& motions, std::size_t most, Ask&& ask) {
  const std::size_t count = motions.knot_counts.size();
  std::size_t begin = 0, knot = 0;
  do {  // an empty batch is asked too: its options may be wrong
    std::size_t end = begin, knots = 0;
    while (end < count && knots + motions.knot_counts[end] <= most) {
      knots += motions.knot_counts[end++];
    }
    if (end == begin && count > 0) {
      return absl::ResourceExhaustedError(
          absl::StrCat("knot_counts[", begin, "]: ", motions.knot_counts[begin],
                       " knots; the server takes at most ", most, " at once"));
    }
    if (absl::Status status = ask(begin, end, knot); !status.ok()) return status;
    begin = end;
    knot += knots;
  } while (begin < count);
  return absl::OkStatus();
}

using Intervals = std::vector<std::vector<TimeInterval>>;

}  // namespace

struct RemoteChecker::Impl {
  explicit Impl(RegisteredRobot r) : registered(std::move(r)) {}

  RegisteredRobot registered;
  LeaseGrant lease;

  std::mutex mutex;
  std::condition_variable stop_changed;
  bool stop = false;
  std::thread renewer;

  void Renew() {
    const SceneClient client(registered.connection());
    std::unique_lock lock(mutex);
    // A third of the time to live leaves two more attempts.
    while (!stop_changed.wait_for(lock, lease.ttl / 3, [&] { return stop; })) {
      lock.unlock();
      const absl::Status status = client.RenewLease(lease.id, lease.ttl).status();
      lock.lock();
      if (absl::IsFailedPrecondition(status)) return;  // gone for good: Check will say so
    }
  }

  absl::StatusOr<CheckReply> CheckPart(const StateBatch& states, const CheckOptions& options,
                                       std::size_t begin, std::size_t end) {
    v1::CheckStatesRequest request;
    request.mutable_selector()->set_lease_id(lease.id);
    request.set_robot_id(registered.id());
    Write(options, request.mutable_options());
    WriteStates(states, registered.robot().links.size(), begin, end, &request);
    auto response = Ask(&v1::CheckService::Stub::CheckStates, request);
    if (!response.ok()) return response.status();
    return ReadCheckReply(*response, end - begin, options);
  }

  // Motions [begin, end), the first of which begins at `knot`.
  absl::StatusOr<MotionReply> CheckPart(const MotionBatch& motions, const MotionOptions& options,
                                        std::size_t begin, std::size_t end, std::size_t knot) {
    v1::CheckMotionsRequest request;
    request.mutable_selector()->set_lease_id(lease.id);
    request.set_robot_id(registered.id());
    Write(options, &request);
    WriteMotions(motions, registered.robot().links.size(), begin, end, knot, &request);
    auto response = Ask(&v1::CheckService::Stub::CheckMotions, request);
    if (!response.ok()) return response.status();
    return ReadMotionReply(*response, end - begin);
  }

  absl::StatusOr<Intervals> FindPart(std::span<const Pose> T_W_L, const TimeInterval& window,
                                     const SafeIntervalOptions& options) {
    v1::FindSafeIntervalsRequest request;
    request.mutable_selector()->set_lease_id(lease.id);
    request.set_robot_id(registered.id());
    Write(T_W_L, window, options, &request);
    auto response = Ask(&v1::CheckService::Stub::FindSafeIntervals, request);
    if (!response.ok()) return response.status();
    return ReadTimeIntervals(response->intervals(), T_W_L.size() / registered.robot().links.size());
  }

  // As CheckPart.
  absl::StatusOr<Intervals> FindPart(const MotionBatch& edges, const TimeInterval& window,
                                     const DepartureIntervalOptions& options, std::size_t begin,
                                     std::size_t end, std::size_t knot) {
    v1::FindDepartureIntervalsRequest request;
    v1::CheckMotionsRequest& motions = *request.mutable_motions();
    motions.mutable_selector()->set_lease_id(lease.id);
    motions.set_robot_id(registered.id());
    Write(window, options, &request);
    WriteMotions(edges, registered.robot().links.size(), begin, end, knot, &motions);
    auto response = Ask(&v1::CheckService::Stub::FindDepartureIntervals, request);
    if (!response.ok()) return response.status();
    return ReadTimeIntervals(response->intervals(), end - begin);
  }

  template <class Request, class Response>
  absl::StatusOr<Response> Ask(grpc::Status (v1::CheckService::Stub::*method)(grpc::ClientContext*,
                                                                              const Request&,
                                                                              Response*),
                               const Request& request) {
    const Connection& connection = *registered.connection();
    return registered.Ask(
        [&] { return Call(connection.options(), *connection.impl().check, method, request); });
  }
};

RemoteChecker::RemoteChecker(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

absl::StatusOr<std::unique_ptr<RemoteChecker>> RemoteChecker::Pin(
    std::shared_ptr<Connection> connection, Robot robot, const RemoteCheckerOptions& options) {
  auto registered = RegisteredRobot::At(connection, std::move(robot));
  if (!registered.ok()) return registered.status();
  auto impl = std::make_unique<Impl>(*std::move(registered));
  auto lease = SceneClient(connection).AcquireLease(options.lease_ttl, {options.min_version, ""});
  if (!lease.ok()) return lease.status();
  impl->lease = *std::move(lease);
  impl->renewer = std::thread([raw = impl.get()] { raw->Renew(); });
  return std::unique_ptr<RemoteChecker>(new RemoteChecker(std::move(impl)));
}

RemoteChecker::~RemoteChecker() {
  {
    std::lock_guard lock(impl_->mutex);
    impl_->stop = true;
  }
  impl_->stop_changed.notify_all();
  impl_->renewer.join();
  // If the server is gone, so is the lease: nothing to report.
  (void)SceneClient(impl_->registered.connection()).ReleaseLease(impl_->lease.id);
}

std::size_t RemoteChecker::states_per_request() const {
  return StatesPerRequest(impl_->registered.connection()->server().limits, robot().links.size());
}

absl::StatusOr<CheckReply> RemoteChecker::Check(const StateBatch& states,
                                                const CheckOptions& options) const {
  const std::size_t links = robot().links.size();
  if (states.T_W_L.size() != states.times.size() * links) {
    return absl::InvalidArgumentError(absl::StrCat("T_W_L: has ", states.T_W_L.size(),
                                                   " poses for ", states.times.size(),
                                                   " states of ", links, " links"));
  }
  const std::size_t step = states_per_request();
  CheckReply reply{version(), stamp(), {}};
  std::size_t begin = 0;
  do {  // an empty batch is asked too: its options may be wrong
    const std::size_t end = std::min(begin + step, states.times.size());
    auto part = impl_->CheckPart(states, options, begin, end);
    if (!part.ok()) return part.status();
    reply.answers.insert(reply.answers.end(), part->answers.begin(), part->answers.end());
    begin = end;
  } while (begin < states.times.size());
  return reply;
}

absl::StatusOr<MotionReply> RemoteChecker::CheckMotions(const MotionBatch& motions,
                                                        const MotionOptions& options) const {
  if (absl::Status status = Validate(motions, robot()); !status.ok()) return status;
  MotionReply reply{version(), stamp(), {}, 0, 0, {}};
  const auto ask = [&](std::size_t begin, std::size_t end, std::size_t knot) {
    auto part = impl_->CheckPart(motions, options, begin, end, knot);
    if (!part.ok()) return part.status();
    reply.horizon = part->horizon;
    reply.inflation_mps = part->inflation_mps;
    reply.bound_multiple = part->bound_multiple;
    reply.answers.insert(reply.answers.end(), part->answers.begin(), part->answers.end());
    return absl::OkStatus();
  };
  if (auto status = InParts(motions, states_per_request(), ask); !status.ok()) return status;
  return reply;
}

absl::StatusOr<Intervals> RemoteChecker::FindSafeIntervals(
    const std::vector<Pose>& T_W_L, const TimeInterval& window,
    const SafeIntervalOptions& options) const {
  const std::size_t links = robot().links.size(), most = states_per_request() * links;
  if (T_W_L.size() % links != 0) {
    return absl::InvalidArgumentError(absl::StrCat("world_from_link: has ", T_W_L.size(),
                                                   " poses, no multiple of the robot's ", links,
                                                   " links"));
  }
  Intervals intervals;
  std::size_t begin = 0;
  do {  // an empty batch is asked too: its options may be wrong
    const auto poses = std::span(T_W_L).subspan(begin, std::min(most, T_W_L.size() - begin));
    auto part = impl_->FindPart(poses, window, options);
    if (!part.ok()) return part.status();
    std::ranges::move(*part, std::back_inserter(intervals));
    begin += poses.size();
  } while (begin < T_W_L.size());
  return intervals;
}

absl::StatusOr<Intervals> RemoteChecker::FindDepartureIntervals(
    const MotionBatch& edges, const TimeInterval& window,
    const DepartureIntervalOptions& options) const {
  if (absl::Status status = Validate(edges, robot()); !status.ok()) return status;
  Intervals intervals;
  const auto ask = [&](std::size_t begin, std::size_t end, std::size_t knot) {
    auto part = impl_->FindPart(edges, window, options, begin, end, knot);
    if (!part.ok()) return part.status();
    std::ranges::move(*part, std::back_inserter(intervals));
    return absl::OkStatus();
  };
  if (auto status = InParts(edges, states_per_request(), ask); !status.ok()) return status;
  return intervals;
}

const Robot& RemoteChecker::robot() const { return impl_->registered.robot(); }
std::uint64_t RemoteChecker::version() const { return impl_->lease.version; }
Time RemoteChecker::stamp() const { return impl_->lease.stamp; }
const std::string& RemoteChecker::lease_id() const { return impl_->lease.id; }

}  // namespace clearway
