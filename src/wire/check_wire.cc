#include "wire/check_wire.h"

#include "absl/strings/str_cat.h"
#include "wire/scene_wire.h"
#include "wire/status.h"

namespace clearway {
namespace {

v1::UnknownSpacePolicy ToProto(UnknownPolicy policy) {
  return policy == UnknownPolicy::kBlocked ? v1::UNKNOWN_SPACE_POLICY_BLOCKED
         : policy == UnknownPolicy::kFree  ? v1::UNKNOWN_SPACE_POLICY_FREE
                                           : v1::UNKNOWN_SPACE_POLICY_TOLERATED;
}

UnknownPolicy ReadPolicy(int proto, FieldReader& read) {
  switch (proto) {
    case v1::UNKNOWN_SPACE_POLICY_BLOCKED:
      return UnknownPolicy::kBlocked;
    case v1::UNKNOWN_SPACE_POLICY_FREE:
      return UnknownPolicy::kFree;
    case v1::UNKNOWN_SPACE_POLICY_TOLERATED:
      return UnknownPolicy::kTolerated;
    default:
      read.Fail("unknown_space", "must say how unknown space counts; there is no default");
      return UnknownPolicy::kBlocked;
  }
}

}  // namespace

void Write(const CheckOptions& options, v1::CheckOptions* proto) {
  proto->set_unknown_space(ToProto(options.unknown));
  proto->set_max_unknown_fraction(options.max_unknown_fraction);
  proto->set_with_unknown_fraction(options.with_unknown_fraction);
  for (const Aabb& box : options.known_free_W) Write(box, proto->add_known_free_world());
  proto->set_padding_m(options.padding_m);
  proto->set_inflation_mps(options.inflation_mps);
  proto->set_bound_multiple(options.bound_multiple);
  proto->set_inflate_moving_only(options.inflate_moving_only);
  for (ObjectId id : options.ignored_objects) proto->add_ignored_object_ids(id);
  for (const auto& [link, object] : options.allowed_contacts) {
    v1::AllowedContact* contact = proto->add_allowed_contacts();
    contact->set_link(link);
    contact->set_object_id(object);
  }
  if (options.clearance_up_to_m) proto->set_clearance_up_to_m(*options.clearance_up_to_m);
}

absl::StatusOr<CheckOptions> ReadCheckOptions(const std::string& field,
                                              const v1::CheckOptions& proto,
                                              const ServerLimits& limits) {
  FieldReader read(field + ".");
  read.AtMost("known_free_world", proto.known_free_world_size(), limits.max_boxes);
  read.AtMost("ignored_object_ids", proto.ignored_object_ids_size(), limits.max_boxes);
  read.AtMost("allowed_contacts", proto.allowed_contacts_size(), limits.max_boxes);
  if (!read.ok()) return read.status();
  CheckOptions options;
  options.unknown = ReadPolicy(proto.unknown_space(), read);
  options.max_unknown_fraction =
      read.NotNegative("max_unknown_fraction", proto.max_unknown_fraction());
  options.with_unknown_fraction = proto.with_unknown_fraction();
  for (int i = 0; i < proto.known_free_world_size() && read.ok(); ++i) {
    options.known_free_W.push_back(
        read.Box(absl::StrCat("known_free_world[", i, "]"), true, proto.known_free_world(i)));
  }
  options.padding_m = read.NotNegative("padding_m", proto.padding_m());
  options.inflation_mps = read.NotNegative("inflation_mps", proto.inflation_mps());
  options.bound_multiple = read.NotNegative("bound_multiple", proto.bound_multiple());
  options.inflate_moving_only = proto.inflate_moving_only();
  options.ignored_objects.assign(proto.ignored_object_ids().begin(),
                                 proto.ignored_object_ids().end());
  for (const v1::AllowedContact& contact : proto.allowed_contacts()) {
    options.allowed_contacts.emplace_back(contact.link(), contact.object_id());
  }
  if (proto.has_clearance_up_to_m()) {
    options.clearance_up_to_m = read.NotNegative("clearance_up_to_m", proto.clearance_up_to_m());
  }
  if (!read.ok()) return read.status();
  return options;
}

void WriteStates(const StateBatch& states, std::size_t links, std::size_t begin, std::size_t end,
                 v1::CheckStatesRequest* proto) {
  for (std::size_t s = begin; s < end; ++s) {
    proto->add_times_ns(ToNanoseconds(states.times[s]));
    for (std::size_t l = 0; l < links; ++l) {
      Append(states.T_W_L[s * links + l], proto->mutable_world_from_link());
    }
  }
}

absl::StatusOr<StateBatch> ReadStates(const v1::CheckStatesRequest& proto, std::size_t links,
                                      const ServerLimits& limits) {
  FieldReader read;
  const std::size_t states = proto.times_ns_size();
  read.AtMost("times_ns", states, limits.max_states_per_batch);
  StateBatch batch;
  if (states > 0) batch.times = read.Times("times_ns", proto.times_ns(), states);
  if (read.ok()) {
    batch.T_W_L = read.Poses("world_from_link", proto.world_from_link(), states * links);
  }
  if (!read.ok()) return read.status();
  return batch;
}

void Write(const CheckReply& reply, v1::CheckStatesResponse* proto) {
  Write(Versioned{reply.version, reply.stamp}, proto->mutable_scene());
  for (const StateAnswer& answer : reply.answers) {
    proto->add_statuses(ToProto(answer.status));
    proto->add_links(answer.link);
    proto->add_object_ids(answer.object);
    if (answer.unknown_fraction) proto->add_unknown_fractions(*answer.unknown_fraction);
    if (answer.clearance_m) proto->add_clearances_m(*answer.clearance_m);
  }
}

absl::StatusOr<CheckReply> ReadCheckReply(const v1::CheckStatesResponse& proto, std::size_t states,
                                          const CheckOptions& options) {
  const bool with_unknown = options.NeedsUnknownFraction();
  const bool with_clearance = options.clearance_up_to_m.has_value();
  const auto fits = [&](int size) { return static_cast<std::size_t>(size) == states; };
  if (!fits(proto.statuses_size()) || !fits(proto.links_size()) || !fits(proto.object_ids_size()) ||
      (with_unknown && !fits(proto.unknown_fractions_size())) ||
      (with_clearance && !fits(proto.clearances_m_size()))) {
    return absl::InternalError(absl::StrCat(
        "the server's reply does not have one answer for each of ", states, " states"));
  }
  CheckReply reply;
  const Versioned scene = ReadVersion(proto.scene());
  reply.version = scene.version;
  reply.stamp = scene.stamp;
  reply.answers.resize(states);
  for (std::size_t s = 0; s < states; ++s) {
    StateAnswer& answer = reply.answers[s];
    answer.status = ReadSpaceStatus(proto.statuses(s));
    answer.link = proto.links(s);
    answer.object = proto.object_ids(s);
    if (with_unknown) answer.unknown_fraction = proto.unknown_fractions(s);
    if (with_clearance) answer.clearance_m = proto.clearances_m(s);
  }
  return reply;
}

}  // namespace clearway
