// clearway evaluate: what a scene made of its frames and foresaw, against the truth.
#include <algorithm>
#include <memory>
#include <numbers>
#include <optional>
#include <thread>
#include <vector>

#include "clearway/scene/scene_builder.h"
#include "clearway/sim/wrong_labels.h"
#include "cli/commands.h"
#include "cli/evaluation.h"
#include "cli/evaluation_html.h"
#include "cli/progress.h"

namespace clearway::cli {
namespace {

constexpr char kExamples[] =
    "  clearway evaluate sim:street --noise table1\n"
    "  clearway evaluate kitti0000_fov --poses icp --motion track --rest-distance 0.6 --json";

constexpr std::uint64_t kSeed = 1;  // of wrong labels

struct Flags {
  std::string spec;
  SourceFlags source;
  std::string motion = "last";
  double rest_distance_m = 0;
  double max_range_m = 50;
  double grazing_m = 0;
  double pose_error_m = 0, pose_error_deg = 0;
  double wrong_labels = 0;
  bool json = false;
  std::string html;
};

SceneParams ParamsOf(const TrueSource& source, const Flags& flags) {
  SceneParams params;
  params.resolution_m = params.object_resolution_m = source.frames.resolution_m;
  params.rays.max_range_m = flags.max_range_m;
  params.rays.grazing_m = flags.grazing_m;
  params.motion = flags.motion == "track" ? MotionModel::kTrack : MotionModel::kLastMotion;
  params.rest_distance_m = flags.rest_distance_m;
  params.object_pose_error_m = flags.pose_error_m;
  params.object_pose_error_rad = flags.pose_error_deg * std::numbers::pi / 180;
  return params;
}

absl::StatusOr<Evaluation> Evaluate(const TrueSource& source, const Flags& flags,
                                    const Terminal& terminal) {
  const SceneParams params = ParamsOf(source, flags);
  if (auto status = Validate(params); !status.ok()) return status;
  if (source.frames.frame_count == 0) {
    return absl::FailedPreconditionError(flags.spec + ": holds no frames");
  }
  ThreadPool pool(static_cast<int>(std::max(1u, std::thread::hardware_concurrency())));
  SceneBuilder builder(params, FrameLimits(), pool);
  Evaluator evaluator(source);
  ProgressBar progress(terminal.err, terminal.err_is_terminal, source.frames.frame_count);
  std::uint64_t points = 0;
  for (std::size_t k = 0; k < source.frames.frame_count; ++k) {
    const auto frame = source.frames.read(k);
    if (!frame.ok()) return frame.status();
    const auto report = builder.Apply(WithWrongLabels(*frame, flags.wrong_labels, kSeed));
    if (!report.ok()) return report.status();
    evaluator.Add(k, *frame, builder.Publish());
    points += frame->points_S.size();
    progress.Update(k + 1, points);
  }
  progress.Finish();
  return std::move(evaluator).Result();
}

absl::Status Run(const Flags& flags, const Terminal& terminal) {
  const auto source = OpenTrueSource(flags.spec, flags.source);
  if (!source.ok()) return source.status();
  const auto found = Evaluate(*source, flags, terminal);
  if (!found.ok()) return found.status();
  if (!flags.html.empty()) {
    if (auto status = WriteHtml(flags.html, *source, *found); !status.ok()) return status;
  }
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
  command
      ->add_option("--pose-error", flags->pose_error_m,
                   "As of clearway-server --scene-object-pose-error-m")
      ->check(Between(0, 10))
      ->capture_default_str();
  command->add_option("--pose-error-deg", flags->pose_error_deg, "The same of angles, in degrees")
      ->check(Between(0, 57))
      ->capture_default_str();
  command
      ->add_option("--wrong-labels", flags->wrong_labels,
                   "Give this share of the points a wrong label")
      ->check(Between(0, 1))
      ->capture_default_str();
  command->add_option("--html", flags->html, "Also write a page with tables, plots and pictures")
      ->type_name("FILE");
  command->add_flag("--json", flags->json, "Print JSON");
  AddSourceFlags(command, &flags->source);
}

}  // namespace clearway::cli
