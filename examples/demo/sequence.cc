#include "demo/sequence.h"

#include <algorithm>
#include <filesystem>
#include <memory>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "clearway/sim/scenarios.h"

namespace clearway::demo {
namespace {

constexpr double kShiftStepM = 0.5;
constexpr int kShifts = 16;  // up to 8 m along the path, both ways

std::string NameOf(const std::map<ObjectId, std::string>& names, ObjectId id) {
  const auto name = names.find(id);
  return name != names.end() ? name->second : absl::StrCat("object ", id);
}

Crossing CrossingOf(const CrossingTask& task, Time now) {
  Crossing crossing;
  crossing.name = task.name;
  crossing.blocker = task.blocker;
  crossing.robot_size_m = task.robot_size_m;
  crossing.max_speed_mps = task.max_speed_mps;
  crossing.now = now;
  crossing.time_limit = task.time_limit;
  crossing.start_W = task.start_W.head<2>();
  crossing.goal_W = task.goal_W.head<2>();
  return crossing;
}

// From the left, then from the right; first where the object will be, then ever further away.
Problem ProblemOf(const Truth& truth, ObjectId blocker, const std::string& name, Time now) {
  Problem problem{name, blocker, {}};
  for (int shift = 0; shift <= kShifts; ++shift) {
    for (const int sign : {1, -1}) {
      if (shift == 0 && sign < 0) continue;
      for (const bool from_right : {false, true}) {
        problem.candidates.push_back([truth, blocker, name, now, shift, sign, from_right] {
          auto crossing = MakeCrossing(truth, blocker, now, sign * shift * kShiftStepM, from_right);
          if (crossing.ok()) crossing->name = name;
          return crossing;
        });
      }
    }
  }
  return problem;
}

// Of each recorded object, how far its box moved from its first to its last frame.
std::map<ObjectId, double> DistancesMoved(const LidarFolder& folder) {
  std::map<ObjectId, Eigen::Vector3d> first;
  std::map<ObjectId, double> moved_m;
  for (const RecordedBox& box : folder.boxes) {
    const auto [from, fresh] = first.try_emplace(box.id, box.T_W_B.translation);
    moved_m[box.id] = (box.T_W_B.translation - from->second).norm();
  }
  return moved_m;
}

// The lowest ids of objects that went far enough for their path to be a path.
std::vector<ObjectId> MovingObjects(const LidarFolder& folder, std::size_t most) {
  constexpr double kFarM = 10;
  std::vector<ObjectId> ids;
  for (const auto& [id, moved_m] : DistancesMoved(folder)) {
    if (moved_m >= kFarM && ids.size() < most) ids.push_back(id);
  }
  return ids;
}

}  // namespace

absl::StatusOr<Sequence> SimulatedSequence(const std::string& scenario) {
  const auto simulation = MakeScenario(scenario);
  if (!simulation.ok()) return simulation.status();
  const SimulationSpec& spec = simulation->spec();
  if (spec.tasks.empty()) {
    return absl::InvalidArgumentError(
        absl::StrCat("scenario '", scenario, "' poses no crossing; try 'crossing'"));
  }
  Sequence sequence;
  sequence.name = absl::StrCat("simulator, ", scenario);
  sequence.frames = simulation->Frames();
  const Time end = simulation->StampOf(spec.frame_count) + std::chrono::minutes(1);
  sequence.truth = TruthOf(std::make_shared<const World>(simulation->world()), end);
  for (const Body& body : simulation->world().bodies()) {
    if (body.id > 0) sequence.object_names[body.id] = absl::StrCat(body.name, " ", body.id);
  }
  for (const CrossingTask& task : spec.tasks) {
    const Crossing crossing = CrossingOf(task, simulation->StampOf(task.planning_frame));
    sequence.stops.push_back(
        {task.planning_frame,
         {{absl::StrCat(task.name, ", with ", NameOf(sequence.object_names, task.blocker),
                        " in the way"),
           task.blocker,
           {[crossing] { return crossing; }}}}});
  }
  std::ranges::stable_sort(sequence.stops, {}, &Stop::frame);
  return sequence;
}

absl::StatusOr<Sequence> RecordedSequence(const std::string& folder_name,
                                          const std::vector<std::size_t>& plan_after,
                                          Duration motions_over) {
  const auto folder = OpenLidarFolder(folder_name, {.motions_over = motions_over});
  if (!folder.ok()) return folder.status();
  Sequence sequence;
  sequence.name = std::filesystem::weakly_canonical(folder_name).filename().string();
  sequence.frames = folder->frames;
  sequence.truth = TruthOf(*folder);
  for (const RecordedBox& box : folder->boxes) {
    sequence.object_names[box.id] = absl::StrCat(absl::AsciiStrToLower(box.type), " ", box.id);
  }
  for (const std::size_t frame : plan_after) {
    if (frame >= folder->frames.frame_count) break;
    Stop stop{frame, {}};
    for (const ObjectId id : MovingObjects(*folder, 2)) {
      const std::string name =
          absl::StrFormat("frame %d, before %s", frame, NameOf(sequence.object_names, id));
      stop.problems.push_back(ProblemOf(sequence.truth, id, name, folder->poses[frame].stamp));
    }
    sequence.stops.push_back(std::move(stop));
  }
  if (sequence.stops.empty()) {
    return absl::InvalidArgumentError(absl::StrCat(
        folder_name, ": has ", folder->frames.frame_count, " frames, none of those to plan after"));
  }
  return sequence;
}

}  // namespace clearway::demo
