#include "wire/motion_wire.h"

#include "absl/strings/str_cat.h"
#include "wire/check_wire.h"
#include "wire/scene_wire.h"

namespace clearway {
namespace {

std::optional<MotionWitness> ReadWitness(const v1::CheckMotionsResponse& proto, int m, Time from) {
  MotionWitness witness;
  witness.from = from;
  witness.until = TimeFromNanoseconds(proto.contact_ns(m));
  witness.link = proto.links(m);
  witness.object = proto.object_ids(m);
  if (proto.has_voxels(m)) {
    witness.voxel = VoxelKey{proto.voxels(3 * m), proto.voxels(3 * m + 1), proto.voxels(3 * m + 2)};
  }
  return witness;
}

}  // namespace

void Write(const MotionOptions& options, v1::CheckMotionsRequest* proto) {
  Write(options.check, proto->mutable_options());
  proto->set_contact_resolution_m(options.contact_resolution_m);
  if (options.world_at) proto->set_world_at_ns(ToNanoseconds(*options.world_at));
}

absl::StatusOr<MotionOptions> ReadMotionOptions(const v1::CheckMotionsRequest& proto,
                                                const ServerLimits& limits) {
  absl::StatusOr<CheckOptions> check = ReadCheckOptions("options", proto.options(), limits);
  if (!check.ok()) return check.status();
  FieldReader read("options.");
  constexpr char kNot[] = "is not answered for motions";
  read.Require(!check->clearance_up_to_m, "clearance_up_to_m", kNot);
  read.Require(!check->with_unknown_fraction, "with_unknown_fraction", kNot);
  if (!read.ok()) return read.status();
  MotionOptions options;
  options.check = *std::move(check);
  if (proto.has_contact_resolution_m()) options.contact_resolution_m = proto.contact_resolution_m();
  if (proto.has_world_at_ns()) options.world_at = TimeFromNanoseconds(proto.world_at_ns());
  return options;
}

void WriteMotions(const MotionBatch& motions, std::size_t links, std::size_t begin, std::size_t end,
                  std::size_t knot, v1::CheckMotionsRequest* proto) {
  std::size_t last = knot;
  for (std::size_t m = begin; m < end; ++m) {
    proto->add_knot_counts(static_cast<std::uint32_t>(motions.knot_counts[m]));
    last += motions.knot_counts[m];
  }
  for (std::size_t k = knot; k < last; ++k) proto->add_times_ns(ToNanoseconds(motions.times[k]));
  for (std::size_t i = knot * links; i < last * links; ++i) {
    Append(motions.T_W_L[i], proto->mutable_world_from_link());
    if (!motions.deviations_m.empty()) proto->add_deviations_m(motions.deviations_m[i]);
  }
}

absl::StatusOr<MotionBatch> ReadMotions(const v1::CheckMotionsRequest& proto, std::size_t links,
                                        const ServerLimits& limits) {
  FieldReader read;
  const std::size_t knots = proto.times_ns_size();
  read.AtMost("times_ns", knots, limits.max_states_per_batch);
  read.AtMost("knot_counts", proto.knot_counts_size(), limits.max_states_per_batch);
  MotionBatch batch;
  if (knots > 0) batch.times = read.Times("times_ns", proto.times_ns(), knots);
  if (read.ok()) {
    batch.T_W_L = read.Poses("world_from_link", proto.world_from_link(), knots * links);
  }
  if (!read.ok()) return read.status();
  batch.knot_counts.assign(proto.knot_counts().begin(), proto.knot_counts().end());
  batch.deviations_m.assign(proto.deviations_m().begin(), proto.deviations_m().end());
  return batch;
}

void Write(const MotionReply& reply, v1::CheckMotionsResponse* proto) {
  Write(Versioned{reply.version, reply.stamp}, proto->mutable_scene());
  proto->set_horizon_ns(reply.horizon.count());
  proto->set_inflation_mps(reply.inflation_mps);
  proto->set_bound_multiple(reply.bound_multiple);
  for (const MotionAnswer& answer : reply.answers) {
    const MotionWitness witness = answer.witness.value_or(MotionWitness{});
    const VoxelKey voxel = witness.voxel.value_or(VoxelKey{});
    proto->add_statuses(ToProto(answer.status));
    proto->add_free_until_ns(ToNanoseconds(answer.free_until));
    proto->add_contact_ns(ToNanoseconds(witness.until));
    proto->add_links(witness.link);
    proto->add_object_ids(witness.object);
    proto->add_has_voxels(witness.voxel.has_value());
    for (const std::int32_t index : {voxel.x, voxel.y, voxel.z}) proto->add_voxels(index);
  }
}

absl::StatusOr<MotionReply> ReadMotionReply(const v1::CheckMotionsResponse& proto,
                                            std::size_t motions) {
  for (const int size : {proto.statuses_size(), proto.free_until_ns_size(), proto.contact_ns_size(),
                         proto.links_size(), proto.object_ids_size(), proto.has_voxels_size()}) {
    if (static_cast<std::size_t>(size) == motions && proto.voxels_size() == 3 * size) continue;
    return absl::InternalError(absl::StrCat(
        "the server's reply does not have one answer for each of ", motions, " motions"));
  }
  const Versioned scene = ReadVersion(proto.scene());
  MotionReply reply{
      scene.version,          scene.stamp, Duration(proto.horizon_ns()), proto.inflation_mps(),
      proto.bound_multiple(), {}};
  reply.answers.resize(motions);
  for (int m = 0; m < proto.statuses_size(); ++m) {
    MotionAnswer& answer = reply.answers[m];
    answer.status = ReadSpaceStatus(proto.statuses(m));
    answer.free_until = TimeFromNanoseconds(proto.free_until_ns(m));
    if (answer.status == SpaceStatus::kFree || answer.status == SpaceStatus::kUnresolved) continue;
    answer.witness = ReadWitness(proto, m, answer.free_until);
  }
  return reply;
}

}  // namespace clearway
