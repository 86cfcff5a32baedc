// clearway evaluate: what a scene made of its frames and foresaw, against the truth.
#include <algorithm>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "clearway/scene/scene_builder.h"
#include "cli/commands.h"
#include "cli/evaluation.h"
#include "cli/progress.h"

namespace clearway::cli {
namespace {

constexpr char kExamples[] =
    "  clearway evaluate sim:street --noise table1\n"
    "  clearway evaluate kitti0000_fov --poses icp --motion track --rest-distance 0.6 --json";

struct Flags {
  std::string spec;
  SourceFlags source;
  std::string motion = "last";
  double rest_distance_m = 0;
  double max_range_m = 50;
  double grazing_m = 0;
  bool json = false;
};

SceneParams ParamsOf(const TrueSource& source, const Flags& flags) {
  SceneParams params;
  params.resolution_m = params.object_resolution_m = source.frames.resolution_m;
  params.rays.max_range_m = flags.max_range_m;
  params.rays.grazing_m = flags.grazing_m;
  params.motion = flags.motion == "track" ? MotionModel::kTrack : MotionModel::kLastMotion;
  params.rest_distance_m = flags.rest_distance_m;
  return params;
}

absl::StatusOr<Evaluation> Evaluate(const TrueSource& source, const SceneParams& params,
                                    const Terminal& terminal) {
  ThreadPool pool(static_cast<int>(std::max(1u, std::thread::hardware_concurrency())));
  SceneBuilder builder(params, FrameLimits(), pool);
  PredictionScore score(source.truth, {kAhead.begin(), kAhead.end()});
  std::optional<SurfaceJudge> judge;  // where the true surfaces are known
  if (source.simulation)
    judge.emplace(*source.simulation, std::vector<Duration>(kAhead.begin(), kAhead.end()));
  ProgressBar progress(terminal.err, terminal.err_is_terminal, source.frames.frame_count);
  std::uint64_t points = 0;
  for (std::size_t k = 0; k < source.frames.frame_count; ++k) {
    const auto frame = source.frames.read(k);
    if (!frame.ok()) return frame.status();
    if (const auto report = builder.Apply(*frame); !report.ok()) return report.status();
    const ScenePtr scene = builder.Publish();
    score.Add(*scene);
    if (judge) judge->Add(k, *frame, *scene);
    points += frame->points_S.size();
    progress.Update(k + 1, points);
  }
  progress.Finish();
  Evaluation found{score.Errors(), {}, {}, {}};
  if (judge) {
    found.fits = judge->Fits();
    found.solids = judge->overlaps();
    found.static_fit = judge->FitOfStatic(*builder.Publish());
  }
  return found;
}

absl::Status Run(const Flags& flags, const Terminal& terminal) {
  const auto source = OpenTrueSource(flags.spec, flags.source);
  if (!source.ok()) return source.status();
  const SceneParams params = ParamsOf(*source, flags);
  if (auto status = Validate(params); !status.ok()) return status;
  const auto found = Evaluate(*source, params, terminal);
  if (!found.ok()) return found.status();
  flags.json ? PrintJson(terminal.out, *source, *found) : PrintText(terminal.out, *source, *found);
  return absl::OkStatus();
}

}  // namespace

void AddEvaluate(Cli& cli) {
  auto flags = std::make_shared<Flags>();
  CLI::App* command =
      AddCommand(cli, "evaluate", "Compare maps and predictions with what is really there",
                 kExamples, [flags, &cli] { return Run(*flags, cli.terminal); });
  command
      ->add_option("input", flags->spec,
                   "A folder of LiDAR scans with boxes, or sim:NAME: they know\nthe truth")
      ->required();
  command->add_option("--motion", flags->motion, "As of clearway-server --scene-motion")
      ->check(CLI::IsMember({"last", "track"}))
      ->capture_default_str();
  command
      ->add_option("--rest-distance", flags->rest_distance_m,
                   "As of clearway-server --scene-rest-distance-m")
      ->check(Between(0, 100))
      ->capture_default_str();
  command->add_option("--max-range", flags->max_range_m, "How far rays are used, in metres")
      ->check(Between(0.1, 1000))
      ->capture_default_str();
  command->add_option("--grazing", flags->grazing_m, "As of clearway-server --scene-grazing-m")
      ->check(Between(0, 100))
      ->capture_default_str();
  command->add_flag("--json", flags->json, "Print JSON");
  AddSourceFlags(command, &flags->source);
}

}  // namespace clearway::cli
