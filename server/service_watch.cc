#include "clearway/collision/motion_rest.h"
#include "server/handler.h"
#include "server/motion_question.h"
#include "server/services.h"
#include "wire/motion_wire.h"

namespace clearway {
namespace {

// What is left of the motions at a version's stamp is put to it; what is over counts as free.
absl::StatusOr<MotionReply> AskVersion(ServerCore& core, const MotionQuestion& question,
                                       const ScenePtr& scene, const Gone& must_end) {
  const auto checker = core.robots.CheckerFor(question.robot_id, question.robot, scene);
  if (question.options.world_at) {
    return checker->CheckMotions(question.motions, question.options, must_end);
  }
  const std::size_t links = question.robot->robot().links.size();
  const MotionRest rest = RestOf(question.motions, links, scene->stamp);
  auto reply = checker->CheckMotions(rest.motions, question.options, must_end);
  if (!reply.ok()) return reply.status();
  std::vector<MotionAnswer> answers(question.motions.knot_counts.size());
  std::size_t end = 0;
  for (std::size_t m = 0; m < answers.size(); ++m) {
    end += question.motions.knot_counts[m];
    answers[m] = {SpaceStatus::kFree, question.motions.times[end - 1], std::nullopt};
  }
  for (std::size_t i = 0; i < rest.indices.size(); ++i) {
    answers[rest.indices[i]] = reply->answers[i];
  }
  reply->answers = std::move(answers);
  return reply;
}

// Which motions have become free or not since the last answers.
class Changes {
 public:
  explicit Changes(std::size_t motions) : free_(motions, true) {}

  // Whether there are any; on the first call there is something to say in any case.
  bool Note(const MotionReply& reply, v1::WatchMotionsResponse& response) {
    for (std::size_t m = 0; m < free_.size(); ++m) {
      const bool free = reply.answers[m].status == SpaceStatus::kFree;
      const auto index = static_cast<std::uint32_t>(m);
      if (free_[m] && !free) response.add_broken(index);
      if (!free_[m] && free) response.add_mended(index);
      free_[m] = free;
    }
    const bool first = std::exchange(first_, false);
    return first || response.broken_size() + response.mended_size() > 0;
  }

 private:
  bool first_ = true;
  std::vector<bool> free_;
};

absl::Status Watch(ServerCore& core, const v1::CheckMotionsRequest& request,
                   grpc::ServerContext& context,
                   grpc::ServerWriter<v1::WatchMotionsResponse>& writer) {
  const Gone gone = GoneOf(core, &context);
  const absl::StatusOr<MotionQuestion> question = ReadMotionQuestion(request, core);
  if (!question.ok()) return question.status();
  Changes changes(question->motions.knot_counts.size());
  std::uint64_t wanted = 0;
  while (!gone()) {
    const ScenePtr scene = core.versions.WaitFor(wanted, std::chrono::seconds(1), gone);
    if (core.draining) return DrainingError();
    if (scene == nullptr) continue;
    wanted = scene->version + 1;
    const auto reply = AskVersion(core, *question, scene, WorkOf(core, &context));
    if (!reply.ok()) return reply.status();
    v1::WatchMotionsResponse response;
    if (!changes.Note(*reply, response)) continue;
    Write(*reply, response.mutable_answers());
    if (!WriteTo(writer, response, context, core.streams)) break;
  }
  return absl::CancelledError("the client has gone");
}

}  // namespace

grpc::Status CheckHandlers::WatchMotions(grpc::ServerContext* context,
                                         const v1::WatchMotionsRequest* request,
                                         grpc::ServerWriter<v1::WatchMotionsResponse>* writer) {
  return Handle(core_, context, "WatchMotions", *request, [&](const Peer& peer) -> absl::Status {
    const Quota::Slot slot(core_.watch_streams, peer.name);
    if (!slot.status().ok()) return slot.status();
    FieldReader read;
    read.Require(request->has_motions(), "motions", "is missing");
    read.Require(!request->motions().has_selector(), "motions.selector",
                 "is not for watches: they see every version");
    if (!read.ok()) return read.status();
    const absl::Status status = Watch(core_, request->motions(), *context, *writer);
    return absl::IsInvalidArgument(status) || absl::IsNotFound(status)
               ? WithFieldPrefix("motions.", status)
               : status;
  });
}

}  // namespace clearway
