#include "clearway/sim/scenarios.h"

#include <array>
#include <cmath>
#include <utility>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "sim/scenario_parts.h"

namespace clearway {
namespace {

struct Scenario {
  const char* name;
  SimulationSpec (*spec)(std::uint64_t seed);
};

// For worlds that do not depend on the seed.
template <SimulationSpec (*kSpec)()>
SimulationSpec Always(std::uint64_t) {
  return kSpec();
}

constexpr std::array<Scenario, 9> kScenarios = {{{"crossing", Always<CrossingSpec>},
                                                 {"street", Always<StreetSpec>},
                                                 {"lab", Always<LabSpec>},
                                                 {"small", Always<SmallSpec>},
                                                 {"occlusions", OcclusionsSpec},
                                                 {"queues", QueuesSpec},
                                                 {"swaps", SwapsSpec},
                                                 {"far_swaps", FarSwapsSpec},
                                                 {"articulated", Always<ArticulatedSpec>}}};

absl::Status Refused(const char* field, double value, const char* limit) {
  return absl::InvalidArgumentError(absl::StrCat(field, ": ", value, " is not ", limit));
}

absl::Status Within(const char* field, std::optional<int> value, int least, int most) {
  if (!value || (*value >= least && *value <= most)) return absl::OkStatus();
  return Refused(field, *value, absl::StrCat("in ", least, " to ", most).c_str());
}

absl::Status ValidateLength(const char* field, double value) {
  if (std::isfinite(value) && value >= 0) return absl::OkStatus();
  return Refused(field, value, "finite and at least 0");
}

absl::Status Validate(const char* field, const PoseErrorModel& error) {
  if (absl::Status status = ValidateLength(absl::StrCat(field, ".mean_rotation_rad").c_str(),
                                           error.mean_rotation_rad);
      !status.ok()) {
    return status;
  }
  return ValidateLength(absl::StrCat(field, ".mean_translation_m").c_str(),
                        error.mean_translation_m);
}

absl::Status ApplySensorOptions(const ScenarioOptions& options, SpinningLidar& lidar) {
  if (options.image_width_px) {
    return absl::InvalidArgumentError("image_width_px: this scenario's sensor is a LiDAR");
  }
  if (options.beams && *options.beams != 16 && *options.beams != 32 && *options.beams != 64) {
    return Refused("beams", *options.beams, "16, 32 or 64");
  }
  if (absl::Status status = Within("azimuth_steps", options.azimuth_steps, 1, 16'384);
      !status.ok()) {
    return status;
  }
  lidar.beams = options.beams.value_or(lidar.beams);
  lidar.azimuth_steps = options.azimuth_steps.value_or(lidar.azimuth_steps);
  return absl::OkStatus();
}

absl::Status ApplySensorOptions(const ScenarioOptions& options, DepthCamera& camera) {
  if (options.beams || options.azimuth_steps) {
    return absl::InvalidArgumentError(absl::StrCat(options.beams ? "beams" : "azimuth_steps",
                                                   ": this scenario's sensor is a depth camera"));
  }
  if (absl::Status status = Within("image_width_px", options.image_width_px, 4, 4'096);
      !status.ok()) {
    return status;
  }
  camera.width_px = options.image_width_px.value_or(camera.width_px);
  camera.height_px = camera.width_px * 3 / 4;
  return absl::OkStatus();
}

absl::Status Validate(const ScenarioOptions& options) {
  if (options.frame_count && (*options.frame_count < 1 || *options.frame_count > 1'000'000)) {
    return Refused("frame_count", static_cast<double>(*options.frame_count), "in 1 to 1000000");
  }
  for (const absl::Status& status : {ValidateLength("range_noise_m", options.range_noise_m),
                                     Validate("noise.sensor", options.noise.sensor),
                                     Validate("noise.object", options.noise.object)}) {
    if (!status.ok()) return status;
  }
  return absl::OkStatus();
}

absl::Status Apply(const ScenarioOptions& options, SimulationSpec& spec) {
  if (absl::Status status = Validate(options); !status.ok()) return status;
  spec.seed = options.seed;
  spec.noise = options.noise;
  spec.range_noise_m = options.range_noise_m;
  spec.report = options.report;
  spec.report_visible_only = options.report_visible_only;
  spec.keep_no_return = options.keep_no_return;
  spec.frame_count = options.frame_count.value_or(spec.frame_count);
  return std::visit([&](auto& sensor) { return ApplySensorOptions(options, sensor); }, spec.sensor);
}

}  // namespace

std::vector<std::string> ScenarioNames() {
  std::vector<std::string> names;
  for (const Scenario& scenario : kScenarios) names.emplace_back(scenario.name);
  return names;
}

absl::StatusOr<Simulation> MakeScenario(const std::string& name, const ScenarioOptions& options) {
  for (const Scenario& scenario : kScenarios) {
    if (name != scenario.name) continue;
    SimulationSpec spec = scenario.spec(options.seed);
    if (absl::Status status = Apply(options, spec); !status.ok()) return status;
    return Simulation(std::move(spec));
  }
  return absl::NotFoundError(
      absl::StrCat("scenario: \"", name, "\" is none of ", absl::StrJoin(ScenarioNames(), ", ")));
}

}  // namespace clearway
