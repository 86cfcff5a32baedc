#include "clearway/sim/simulation.h"

#include <algorithm>
#include <utility>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "sim/random.h"
#include "sim/ray_caster.h"

namespace clearway {
namespace {

// Which stream of random numbers is whose; an object's stream is its id.
constexpr std::uint64_t kSensorStream = 0;
constexpr std::uint64_t kRangeStream = std::uint64_t{1} << 63;

struct ObjectErrors {
  ObjectId id;
  std::vector<Pose> errors;  // by frame
};

std::vector<ObjectErrors> ErrorsOfObjects(const SimulationSpec& spec) {
  std::vector<ObjectErrors> objects;
  for (const ObjectId id : spec.world.ObjectIds()) {
    objects.push_back({id, ErrorsOfRun(spec.noise.object, spec.frame_count, spec.period, spec.seed,
                                       static_cast<std::uint64_t>(id))});
  }
  return objects;
}

}  // namespace

struct Simulation::State {
  explicit State(SimulationSpec given)
      : spec(std::move(given)),
        caster(spec.world),
        directions_S(RayDirections(spec.sensor)),
        sensor_errors(ErrorsOfRun(spec.noise.sensor, spec.frame_count, spec.period, spec.seed,
                                  kSensorStream)),
        object_errors(ErrorsOfObjects(spec)) {}
  State(const State&) = delete;  // the caster points into the spec
  State& operator=(const State&) = delete;

  void AddPoints(const Pose& T_W_S, std::size_t k, Frame& frame) const;
  bool Reports(ObjectId id, const Frame& frame) const;

  const SimulationSpec spec;
  const RayCaster caster;
  const std::vector<Eigen::Vector3d> directions_S;
  const std::vector<Pose> sensor_errors;          // by frame
  const std::vector<ObjectErrors> object_errors;  // ascending ids
};

void Simulation::State::AddPoints(const Pose& T_W_S, std::size_t k, Frame& frame) const {
  const double max_range_m = MaxRangeM(spec.sensor);
  const std::vector<RayHit> hits = caster.Cast(T_W_S, frame.stamp, directions_S, max_range_m);
  Random random(spec.seed, kRangeStream, k);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const bool hit = hits[i].range_m <= max_range_m;
    if (!hit && !spec.keep_no_return) continue;
    if (hits[i].range_m < MinRangeM(spec.sensor)) continue;  // blocked too near to be measured
    double range_m = hit ? hits[i].range_m : max_range_m;
    if (hit && spec.range_noise_m > 0) range_m += spec.range_noise_m * random.Normal();
    frame.points_S.push_back((range_m * directions_S[i]).cast<float>());
    frame.labels.push_back(hit ? spec.world.bodies()[hits[i].body].id : kStaticLabel);
    if (spec.keep_no_return) frame.no_return.push_back(hit ? 0 : 1);
  }
}

bool Simulation::State::Reports(ObjectId id, const Frame& frame) const {
  return !spec.report_visible_only ||
         std::find(frame.labels.begin(), frame.labels.end(), id) != frame.labels.end();
}

Simulation::Simulation(SimulationSpec spec)
    : state_(std::make_shared<const State>(std::move(spec))) {}

const SimulationSpec& Simulation::spec() const { return state_->spec; }

Time Simulation::StampOf(std::size_t k) const {
  return spec().start + static_cast<std::int64_t>(k) * spec().period;
}

Pose Simulation::TrueT_W_S(std::size_t k) const {
  return PoseAt(spec().sensor_trajectory, StampOf(k));
}

Pose Simulation::ReportedT_W_S(std::size_t k) const {
  return TrueT_W_S(k) * state_->sensor_errors[k];
}

std::optional<Pose> Simulation::ReportedT_W_B(ObjectId id, std::size_t k) const {
  for (const ObjectErrors& object : state_->object_errors) {
    if (object.id == id) return *world().T_W_B(id, StampOf(k)) * object.errors[k];
  }
  return std::nullopt;
}

Frame Simulation::MakeFrame(std::size_t k) const { return MakeFrameFrom(TrueT_W_S(k), k); }

Frame Simulation::MakeFrameFrom(const Pose& T_W_S, std::size_t k) const {
  Frame frame;
  frame.sensor_id = spec().name;
  frame.sequence = k;
  frame.stamp = StampOf(k);
  frame.T_W_S = T_W_S * state_->sensor_errors[k];
  state_->AddPoints(T_W_S, k, frame);
  for (const Body& body : world().bodies()) {
    if (body.part_of != kStaticLabel) frame.parts.push_back({body.id, body.part_of});
  }
  if (spec().report == ObjectReport::kNothing) return frame;
  for (const ObjectErrors& object : state_->object_errors) {
    if (!state_->Reports(object.id, frame)) continue;
    const Pose T_W_B = *ReportedT_W_B(object.id, k);
    if (spec().report == ObjectReport::kPoses) {
      frame.poses.push_back({object.id, T_W_B});
    } else if (k > 0) {
      const Pose H_W = T_W_B * Inverse(*ReportedT_W_B(object.id, k - 1));
      frame.motions.push_back({object.id, H_W, StampOf(k - 1)});
    }
  }
  return frame;
}

FrameSource Simulation::Frames() const {
  FrameSource source;
  source.description = absl::StrCat("simulation ", spec().name, ", seed ", spec().seed);
  source.frame_count = frame_count();
  source.resolution_m = spec().resolution_m;
  source.read = [simulation = *this](std::size_t k) -> absl::StatusOr<Frame> {
    if (k >= simulation.frame_count()) {
      return absl::OutOfRangeError(
          absl::StrCat("index ", k, ": the simulation has ", simulation.frame_count(), " frames"));
    }
    return simulation.MakeFrame(k);
  };
  return source;
}

}  // namespace clearway
