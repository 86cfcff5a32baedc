// A robot in the loop with what it sees: its LiDAR's scans become a scene, it plans on the newest
// version twice a second, drives on, and is judged by the simulator's own bodies.
//
//   clearway-closed-loop --seed 7
//   clearway-closed-loop --turning --inflation 0 --out no_inflation.png
//   clearway-closed-loop --noise --server build/release/server/clearway-server
#include <CLI/CLI.hpp>
#include <cstdio>

#include "closed_loop/loop.h"
#include "closed_loop/picture.h"
#include "closed_loop/server_scene.h"

namespace clearway::closed_loop {
namespace {

struct Settings {
  std::uint64_t seed = 1;
  bool turning = false, noise = false;
  std::optional<double> inflation_mps;  // by default what suits the SLAM
  double bound_multiple = 0;
  std::string server, out;
};

const char* WordFor(Choice choice) {
  switch (choice) {
    case Choice::kKept:
      return "keeps its way";
    case Choice::kPlanned:
      return "new way";
    case Choice::kEvaded:
      return "evades";
  }
  return "";
}

void Print(const LoopStep& step) {
  if (!step.decision) return;
  const Decision& decision = *step.decision;
  std::printf(
      "%5.1f s  at (%5.2f, %5.2f)  %-13s to (%5.2f, %5.2f) by %5.1f s, free for %4.1f s"
      "  [version %llu, %zu objects]\n",
      ToSeconds(step.time - Time()), step.robot_W.x(), step.robot_W.y(), WordFor(decision.choice),
      decision.path.end_W().x(), decision.path.end_W().y(),
      ToSeconds(decision.path.end_time() - Time()), ToSeconds(decision.free_until - step.time),
      static_cast<unsigned long long>(step.scene->version), step.scene->objects.size());
}

void Print(const LoopResult& result, const World& world) {
  for (const Collision& collision : result.collisions) {
    const Body* const body = world.FindObject(collision.object);
    std::printf("touches %s after %.2f s at (%.2f, %.2f)%s\n",
                body != nullptr ? body->name.c_str() : "what stands",
                ToSeconds(collision.time - Time()), collision.robot_W.x(), collision.robot_W.y(),
                collision.InTime() ? "" : ", seen less than a second before");
  }
  if (result.arrival) {
    std::printf("at the goal after %.1f s, ", ToSeconds(*result.arrival - Time()));
  } else {
    std::printf("never at the goal, ");
  }
  std::printf("%zu collisions\n", result.collisions.size());
}

absl::Status Run(const Settings& settings) {
  const Course course =
      MakeCourse(settings.seed, settings.turning ? Traffic::kTurning : Traffic::kSteady);
  LoopOptions options = MakeLoopOptions(settings.noise, true, settings.seed);
  if (settings.inflation_mps) options.navigator.inflation_mps = *settings.inflation_mps;
  options.navigator.bound_multiple = settings.bound_multiple;
  std::unique_ptr<SceneFeed> feed = std::make_unique<OwnScene>();
  if (!settings.server.empty()) {
    auto server = ServerScene::Start(settings.server);
    if (!server.ok()) return server.status();
    feed = *std::move(server);
  }
  ScenePtr shown;  // until it is there
  Time until;
  bool there = false;
  const auto result = RunLoop(course, options, *feed, [&](const LoopStep& step) {
    Print(step);
    if (there) return;
    shown = step.scene;
    until = step.time;
    there = (step.robot_W - course.errand.goal_W).norm() < kArrived_m;
  });
  if (!result.ok()) return result.status();
  Print(*result, course.world);
  if (settings.out.empty()) return absl::OkStatus();
  return WritePicture(course, *result, *shown, until, settings.out);
}

}  // namespace
}  // namespace clearway::closed_loop

int main(int argc, char** argv) {
  clearway::closed_loop::Settings settings;
  CLI::App app(
      "Drives a simulated robot with a LiDAR among moving objects for 30 s of simulated time.\n"
      "Example: clearway-closed-loop --seed 7 --turning --out course.png");
  app.option_defaults()->always_capture_default();
  app.add_option("--seed", settings.seed, "Of the world and the noise");
  app.add_flag("--turning", settings.turning, "Objects turn, stop and start again");
  app.add_flag("--noise", settings.noise, "SLAM errs as in Table I of DynORecon");
  app.add_option("--inflation", settings.inflation_mps,
                 "Metres a second by which predictions grow: 0.7, with --noise 1, unless given")
      ->check(CLI::Range(0.0, 2.0));
  app.add_option(
         "--bounds", settings.bound_multiple,
         "Beside that, so many times how far from its prediction each is in 95 of 100 cases")
      ->check(CLI::Range(0.0, 10.0));
  app.add_option("--server", settings.server,
                 "The server's program, to be started for the scene; without it, in this process")
      ->check(CLI::ExistingFile);
  app.add_option("--out", settings.out, "A picture of the way to the goal, PNG");
  CLI11_PARSE(app, argc, argv);
  const absl::Status status = clearway::closed_loop::Run(settings);
  if (!status.ok()) std::fprintf(stderr, "clearway-closed-loop: %s\n", status.ToString().c_str());
  return status.ok() ? 0 : 1;
}
