// Motions through the static map of a real drive, unknown space free: proved free or shown in
// contact, against the same motions looked at in steps of half a voxel until the first contact,
// with the fast state checker and with FCL on an fcl::OcTree of the same voxels. Then with 64
// moving objects among them, which FCL has no form for.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include "clearway/collision/scene_checker.h"
#include "clearway/geometry/shape.h"
#include "collision/link_motion.h"
#include "costs.h"
#include "drive_map.h"
#include "fcl_shapes.h"
#include "summary.h"

namespace clearway::bench {
namespace {

constexpr double kStep_m = 0.05, kLasts_s = 2;  // contacts are told as finely by both
constexpr std::size_t kAtOnce = 16;             // states, before the next are asked about

struct Asked {
  MotionBatch motion;  // one
  StateBatch steps;
};

CheckOptions UnknownIsFree() {
  CheckOptions options;
  options.unknown = UnknownPolicy::kFree;
  return options;
}

bool IsFree(const SceneChecker& checker, const StateBatch& states) {
  const CheckReply reply = *checker.Check(states, UnknownIsFree());
  return std::all_of(reply.answers.begin(), reply.answers.end(),
                     [](const StateAnswer& a) { return a.status == SpaceStatus::kFree; });
}

// From a free pose, up to 3 m each way along the ground and a third of a metre up or down, turning
// by up to a radian about z.
Asked AnyMotion(Dice& dice, const SceneChecker& checker, const DriveMap& drive, double reach_m) {
  const Time begin = drive.scene->stamp, end = begin + FromSeconds(kLasts_s);
  Pose from{dice.Rotation(), dice.PointIn(drive.box_W)};
  while (!IsFree(checker, {{begin}, {from}})) from = {dice.Rotation(), dice.PointIn(drive.box_W)};
  const Eigen::AngleAxisd turn(dice.Uniform(-1, 1), Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d way = dice.PointIn({{-3, -3, -0.3}, {3, 3, 0.3}});
  const Pose to{turn * from.rotation, from.translation + way};
  Asked asked{{{2}, {begin, end}, {from, to}, {}}, {}};
  const double farthest_m = way.norm() + reach_m * std::abs(turn.angle());
  const int steps = std::max(1, static_cast<int>(std::ceil(farthest_m / kStep_m)));
  const LinkMotion motion(from, to, kLasts_s);
  for (int i = 0; i <= steps; ++i) {
    const double fraction = static_cast<double>(i) / steps;
    asked.steps.times.push_back(begin + FromSeconds(kLasts_s * fraction));
    asked.steps.T_W_L.push_back(motion.At(fraction));
  }
  return asked;
}

bool StepsAreFree(const SceneChecker& checker, const StateBatch& steps) {
  for (std::size_t i = 0; i < steps.times.size(); i += kAtOnce) {
    const auto count = static_cast<std::ptrdiff_t>(std::min(kAtOnce, steps.times.size() - i));
    const auto first = static_cast<std::ptrdiff_t>(i);
    const StateBatch some{{steps.times.begin() + first, steps.times.begin() + first + count},
                          {steps.T_W_L.begin() + first, steps.T_W_L.begin() + first + count}};
    if (!IsFree(checker, some)) return false;
  }
  return true;
}

double Median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Of all motions, the least of three measurements each.
struct Ratios {
  std::vector<double> sampled, sampled_free, sampled_blocked, fcl;
  std::size_t unresolved = 0, free_in_contact = 0;
};

template <class Work>
double LeastUs(Work&& work) {
  double least_us = Took<std::micro>(work);
  for (int i = 0; i < 2; ++i) least_us = std::min(least_us, Took<std::micro>(work));
  return least_us;
}

void Measure(const SceneChecker& checker, const FclChecker* fcl, const Asked& asked,
             Ratios& ratios) {
  const MotionOptions options{UnknownIsFree(), kStep_m, std::nullopt};
  SpaceStatus status{};
  const double proof_us =
      LeastUs([&] { status = checker.CheckMotions(asked.motion, options)->answers[0].status; });
  bool free = false;
  const double sampled = LeastUs([&] { free = StepsAreFree(checker, asked.steps); }) / proof_us;
  ratios.sampled.push_back(sampled);
  (status == SpaceStatus::kFree ? ratios.sampled_free : ratios.sampled_blocked).push_back(sampled);
  ratios.unresolved += status == SpaceStatus::kUnresolved;
  ratios.free_in_contact += status == SpaceStatus::kFree && !free;
  if (fcl == nullptr) return;
  const double fcl_us = LeastUs([&] {
    benchmark::DoNotOptimize(std::none_of(asked.steps.T_W_L.begin(), asked.steps.T_W_L.end(),
                                          [&](const Pose& pose) { return fcl->Collides(pose); }));
  });
  ratios.fcl.push_back(fcl_us / proof_us);
}

void Motions(benchmark::State& state, const DriveMap& drive, bool among, int count) {
  const ScenePtr scene = among ? WithObjects(*drive.scene, 64, drive.box_W.Center()) : drive.scene;
  const std::string suffix = among ? "_among_objects" : "";
  for (auto _ : state) {
    Ratios all;
    for (const auto& [name, shape] : BenchShapes()) {
      const SceneChecker checker(scene, Robot::SingleShape("robot", shape));
      const FclChecker fcl(shape, drive.tree);
      const double reach_m = 0.5 * BoundingBox(shape).Size().norm();
      Dice dice;
      Ratios ratios;
      for (int i = 0; i < count; ++i) {
        Measure(checker, among ? nullptr : &fcl, AnyMotion(dice, checker, drive, reach_m), ratios);
      }
      state.counters["motion_" + name + suffix + "_vs_sampled_x"] = Median(ratios.sampled);
      all.sampled.insert(all.sampled.end(), ratios.sampled.begin(), ratios.sampled.end());
      all.sampled_free.insert(all.sampled_free.end(), ratios.sampled_free.begin(),
                              ratios.sampled_free.end());
      all.sampled_blocked.insert(all.sampled_blocked.end(), ratios.sampled_blocked.begin(),
                                 ratios.sampled_blocked.end());
      all.fcl.insert(all.fcl.end(), ratios.fcl.begin(), ratios.fcl.end());
      all.unresolved += ratios.unresolved;
      all.free_in_contact += ratios.free_in_contact;
    }
    if (all.free_in_contact > 0) state.SkipWithError("a motion called free is in contact");
    state.counters["motion" + suffix + "_vs_sampled_x"] = Median(all.sampled);
    state.counters["motion" + suffix + "_free_vs_sampled_x"] = Median(all.sampled_free);
    state.counters["motion" + suffix + "_blocked_vs_sampled_x"] = Median(all.sampled_blocked);
    state.counters["motion" + suffix + "_unresolved_fraction"] =
        static_cast<double>(all.unresolved) / static_cast<double>(all.sampled.size());
    if (!among) state.counters["motion_vs_fcl_x"] = Median(all.fcl);
  }
}

void Register(const Effort& effort) {
  const auto drive = std::make_shared<DriveMap>(MakeDriveMap(effort.quick ? 5 : 20));
  const int count = effort.quick ? 200 : 1000;
  for (const bool among : {false, true}) {
    Add(among ? "motions_among_objects" : "motions", effort,
        [=](auto& state) { Motions(state, *drive, among, count); });
  }
}

}  // namespace
}  // namespace clearway::bench

int main(int argc, char** argv) {
  return clearway::bench::Main(argc, argv, clearway::bench::Register, {});
}
