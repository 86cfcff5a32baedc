// Robot states against the static map of a real drive, unknown space free, against FCL on an
// fcl::OcTree of the same voxels: collision of four shapes at random poses of which half are free,
// with the OctoMap that scans were inserted into and with one that was read from a file (`_read`),
// and clearance up to 2 m at free ones. Then what each further moving object costs, near or not.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include "clearway/collision/scene_checker.h"
#include "drive_map.h"
#include "fcl_shapes.h"
#include "summary.h"

namespace clearway::bench {
namespace {

constexpr double kClearance_m = 2;
constexpr double kTurn_s = 0.1;  // of one benchmark, before another's

struct Case {
  std::shared_ptr<const FclChecker> fcl, fcl_read;
  std::shared_ptr<const SceneChecker> checker;
  StateBatch states;  // first those in contact, then as many free ones
  std::size_t free_from = 0;
  StateBatch Free(std::size_t count) const {
    StateBatch free;
    for (std::size_t i = free_from; i < std::min(states.times.size(), free_from + count); ++i) {
      free.times.push_back(states.times[i]);
      free.T_W_L.push_back(states.T_W_L[i]);
    }
    return free;
  }
};

Case MakeCase(const DriveMap& drive, const Shape& shape, std::size_t count) {
  Case made;
  made.fcl = std::make_shared<FclChecker>(shape, drive.tree);
  made.fcl_read = std::make_shared<FclChecker>(shape, drive.read_tree);
  made.checker = std::make_shared<SceneChecker>(drive.scene, Robot::SingleShape("robot", shape));
  Dice dice;
  std::vector<Pose> contact, free;
  while (contact.size() < count / 2 || free.size() < count / 2) {
    const Pose pose{dice.Rotation(), dice.PointIn(drive.box_W)};
    auto& kind = made.fcl->Collides(pose) ? contact : free;
    if (kind.size() < count / 2) kind.push_back(pose);
  }
  made.free_from = contact.size();
  made.states.T_W_L = std::move(contact);
  made.states.T_W_L.insert(made.states.T_W_L.end(), free.begin(), free.end());
  made.states.times.assign(made.states.T_W_L.size(), drive.scene->stamp);
  return made;
}

CheckOptions UnknownIsFree() {
  CheckOptions options;
  options.unknown = UnknownPolicy::kFree;
  return options;
}

// How many answers differ from FCL's, to which a mesh is a surface: a voxel inside one counts for
// ours alone.
int Differing(const std::vector<StateAnswer>& answers, const Case& c) {
  int differing = 0;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    differing += (answers[i].status != SpaceStatus::kFree) != (i < c.free_from);
  }
  return differing;
}

// Sets how many times as long FCL takes. The two take turns of about a tenth of a second, so that a
// machine that is slow for a while is so to both.
void Collide(benchmark::State& state, const std::string& name, const FclChecker& fcl,
             const Case& c) {
  using Clock = std::chrono::steady_clock;
  std::chrono::duration<double> fcl_s(0), ours_s(0);
  int checks = 0;
  std::vector<StateAnswer> answers;
  for (auto _ : state) {
    const auto start = Clock::now();
    int contacts = 0;
    for (const Pose& pose : c.states.T_W_L) contacts += fcl.Collides(pose);
    benchmark::DoNotOptimize(contacts);
    const auto middle = Clock::now();
    for (; (Clock::now() - middle) < (middle - start); ++checks) {
      answers = std::move(*c.checker->Check(c.states, UnknownIsFree())).answers;
    }
    fcl_s += middle - start;
    ours_s += Clock::now() - middle;
  }
  const int differing = Differing(answers, c);
  if (!name.starts_with("mesh") && differing > 0) state.SkipWithError("answers differ from FCL's");
  state.counters["collide_" + name + "_differing"] = differing;
  state.counters["collide_" + name + "_vs_fcl_x"] =
      static_cast<double>(checks) / static_cast<double>(state.iterations()) * (fcl_s / ours_s);
}

// Sets the largest difference from FCL's distance, where that is below 2 m.
void Clearance(benchmark::State& state, const Case& c, std::size_t count) {
  const StateBatch free = c.Free(count);
  CheckOptions options = UnknownIsFree();
  options.clearance_up_to_m = kClearance_m;
  std::vector<StateAnswer> answers;
  for (auto _ : state) answers = std::move(*c.checker->Check(free, options)).answers;
  double error_m = 0;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const double expected_m = std::min(kClearance_m, c.fcl->Distance(free.T_W_L[i]));
    error_m = std::max(error_m, std::abs(*answers[i].clearance_m - expected_m));
  }
  state.counters["clearance_error_m"] = error_m;
}

// `up_to_m` as FclChecker's.
void FclClearance(benchmark::State& state, const Case& c, std::size_t count, double up_to_m) {
  const StateBatch free = c.Free(count);
  for (auto _ : state) {
    double sum_m = 0;
    for (const Pose& pose : free.T_W_L) sum_m += c.fcl->Distance(pose, up_to_m);
    benchmark::DoNotOptimize(sum_m);
  }
}

// Gives every state a time of its own within 5 s.
StateBatch Spread(StateBatch states, Time from) {
  for (std::size_t i = 0; i < states.times.size(); ++i) {
    states.times[i] = from + std::chrono::milliseconds(5 * i);
  }
  return states;
}

// States that the scene's one object overlaps, each at its own time.
StateBatch InTheObject(const SceneSnapshot& scene, std::size_t count) {
  const MovingObject& object = *scene.objects.front();
  StateBatch states;
  states.times.resize(count);
  states = Spread(std::move(states), scene.stamp);
  for (const Time t : states.times) {
    const Pose T_W_O = PredictPose(object, t, scene.params.horizon).T_W_O;
    states.T_W_L.push_back(T_W_O *
                           Pose{Eigen::Quaterniond::Identity(), object.solid->box_O.Center()});
  }
  return states;
}

bool AllOccupied(const SceneChecker& checker, const StateBatch& states) {
  const CheckReply reply = *checker.Check(states, UnknownIsFree());
  return std::all_of(reply.answers.begin(), reply.answers.end(), [](const StateAnswer& answer) {
    return answer.status == SpaceStatus::kOccupied;
  });
}

// What each of a crowd of moving objects adds to the check of a state. Sets the counter.
void Crowd(benchmark::State& state, const Case& c, const DriveMap& drive, const ScenePtr& crowded,
           const StateBatch& states, const std::string& counter) {
  using Clock = std::chrono::steady_clock;
  const SceneChecker alone(drive.scene, c.checker->robot());
  const SceneChecker with_objects(crowded, c.checker->robot());
  std::chrono::duration<double, std::nano> added(0);
  for (auto _ : state) {
    const auto start = Clock::now();
    benchmark::DoNotOptimize(alone.Check(states, UnknownIsFree()));
    const auto middle = Clock::now();
    benchmark::DoNotOptimize(with_objects.Check(states, UnknownIsFree()));
    added += (Clock::now() - middle) - (middle - start);
  }
  const double checks = static_cast<double>(state.iterations() * states.times.size());
  state.counters[counter] = added.count() / checks / static_cast<double>(crowded->objects.size());
}

void Register(const Effort& effort) {
  const DriveMap drive = MakeDriveMap(effort.quick ? 5 : 20);
  const auto add = [&](const std::string& name, const auto& run) {
    benchmark::RegisterBenchmark(name.c_str(), run)
        ->Unit(benchmark::kMillisecond)
        ->MinTime(kTurn_s)
        ->Repetitions(3 * effort.repetitions)
        ->ReportAggregatesOnly();
  };
  for (const auto& [name, shape] : BenchShapes()) {
    const auto c = std::make_shared<Case>(MakeCase(drive, shape, 10'000));
    add("collide_" + name, [=, name = name](auto& state) { Collide(state, name, *c->fcl, *c); });
    add("collide_" + name + "_read",
        [=, name = name + "_read"](auto& state) { Collide(state, name, *c->fcl_read, *c); });
    if (name == "sphere") {
      const double beside_m = drive.scene->static_map_W.ObservedBox().max.x() + 60;
      const auto add_crowd = [&](const std::string& counter, const ScenePtr& crowded,
                                 const StateBatch& states) {
        add(counter, [=](auto& state) { Crowd(state, *c, drive, crowded, states, counter); });
      };
      const Eigen::Vector3d beside_W(beside_m, 0, 0);
      const StateBatch free = Spread(c->Free(1000), drive.scene->stamp);
      add_crowd("collide_culled_ns_per_object", WithObjects(*drive.scene, 64, beside_W), free);
      add_crowd("collide_among_ns_per_object", WithObjects(*drive.scene, 64, drive.box_W.Center()),
                free);
      const ScenePtr one = WithObjects(*drive.scene, 1, beside_W);
      const StateBatch inside = InTheObject(*one, 1000);
      if (!AllOccupied(SceneChecker(one, c->checker->robot()), inside)) std::abort();
      add_crowd("collide_overlapped_ns_per_object", one, inside);
    }
    if (name != "box") continue;
    const std::size_t count = effort.quick ? 100 : 500;
    constexpr double kAnywhere_m = std::numeric_limits<double>::max();
    add("fcl_clearance", [=](auto& state) { FclClearance(state, *c, count, kAnywhere_m); });
    add("fcl_clearance_bounded",
        [=](auto& state) { FclClearance(state, *c, count, kClearance_m); });
    add("clearway_clearance", [=](auto& state) { Clearance(state, *c, count); });
  }
}

}  // namespace
}  // namespace clearway::bench

int main(int argc, char** argv) {
  return clearway::bench::Main(
      argc, argv, clearway::bench::Register,
      {{"clearance_vs_fcl_x", "fcl_clearance", "clearway_clearance"},
       {"clearance_vs_bounded_fcl_x", "fcl_clearance_bounded", "clearway_clearance"}},
      clearway::bench::Order::kInTurns);
}
