// clearway evaluate: what a scene made of its frames and foresaw, against the truth.
#include <algorithm>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <thread>
#include <vector>

#include "absl/strings/str_cat.h"
#include "clearway/scene/scene_builder.h"
#include "cli/commands.h"
#include "cli/evaluation.h"
#include "cli/evaluation_html.h"
#include "cli/frame_range.h"
#include "cli/frame_reader.h"
#include "cli/left_out_text.h"
#include "cli/message.h"
#include "cli/progress.h"
#include "cli/told_frames.h"

namespace clearway::cli {
namespace {

constexpr char kExamples[] =
    "  clearway evaluate sim:street --noise table1\n"
    "  clearway evaluate sim:street --grazing 4 --wrong-labels 0.05 --filter-labels\n"
    "  clearway evaluate sim:street --unlabelled 1,2 --dynamic-life 1\n"
    "  clearway evaluate sim:occlusions --seed 3 --forget 0.5 --reidentify\n"
    "  clearway evaluate ~/data/kitti0000_fov --poses icp --motion track --rest-distance 0.6 "
    "--json\n"
    "  clearway evaluate ~/data/kitti0000_fov --poses oxts --motion track --sensor-error 0\n"
    "  clearway evaluate ~/data/kitti0000_fov --from 5s --to 9.9s\n"
    "  clearway evaluate ~/data/kitti0000_fov --motion track --object-voxel 0.05 --html drive.html";

struct Flags {
  std::string spec;
  SourceFlags source;
  FrameRangeFlags range;
  std::string motion = "last", solid{kSolidModeNames[0]},
              motion_from_points{kMotionFromPointsNames[0]};
  double rest_distance_m = 0;
  std::optional<double> object_voxel_m;
  double max_range_m = 50;
  double grazing_m = 0;
  double pose_error_m = 0, pose_error_deg = 0;
  std::optional<double> sensor_error_m, sensor_error_deg;
  bool reidentify = false, filter_labels = false, clear_objects = false;
  double dynamic_life_s = 0;
  ErrorFlags errors;
  bool allow_stamp_jump = false, keep_going = false;
  bool json = false;
  std::string html;
};

// What is not given suits the source; but if one is given as 0, poses are to be left as they are.
void SetSensorError(const FrameSource& source, const Flags& flags, SceneParams& params) {
  const bool left =
      flags.sensor_error_m.value_or(1) == 0 || flags.sensor_error_deg.value_or(1) == 0;
  params.sensor_pose_error_m = left ? 0 : source.sensor_pose_error_m;
  params.sensor_pose_error_rad = left ? 0 : source.sensor_pose_error_rad;
  if (flags.sensor_error_m) params.sensor_pose_error_m = *flags.sensor_error_m;
  if (flags.sensor_error_deg) {
    params.sensor_pose_error_rad = *flags.sensor_error_deg * std::numbers::pi / 180;
  }
}

SceneParams ParamsOf(const TrueSource& source, const Flags& flags) {
  SceneParams params;
  params.resolution_m = source.frames.resolution_m;
  params.object_resolution_m = flags.object_voxel_m.value_or(source.frames.resolution_m);
  params.rays.max_range_m = flags.max_range_m;
  params.rays.grazing_m = flags.grazing_m;
  params.motion = flags.motion == "track" ? MotionModel::kTrack : MotionModel::kLastMotion;
  params.motion_from_points = static_cast<MotionFromPoints>(
      std::ranges::find(kMotionFromPointsNames, flags.motion_from_points) -
      kMotionFromPointsNames.begin());
  params.solid = static_cast<SolidMode>(std::ranges::find(kSolidModeNames, flags.solid) -
                                        kSolidModeNames.begin());
  params.rest_distance_m = flags.rest_distance_m;
  params.object_pose_error_m = flags.pose_error_m;
  params.object_pose_error_rad = flags.pose_error_deg * std::numbers::pi / 180;
  SetSensorError(source.frames, flags, params);
  params.reidentify = flags.reidentify;
  params.filter_labels = flags.filter_labels;
  params.clear_objects_by_rays = flags.clear_objects;
  params.dynamic_life = FromSeconds(flags.dynamic_life_s);
  return params;
}

// Called after each frame: its number, the frame as it is and as it was told, and what became of
// it.
using AfterFrame = std::function<void(std::size_t k, Frame frame, const Frame& told,
                                      const FrameReport& report, SceneBuilder& builder)>;

absl::Status MakeScene(FrameReader& reader, FrameRange range, const SceneParams& params,
                       const Flags& flags, const Terminal& terminal, FrameTeller& teller,
                       const AfterFrame& after) {
  ThreadPool pool(static_cast<int>(std::max(1u, std::thread::hardware_concurrency())));
  SceneBuilder builder(params, FrameLimits(), pool);
  ProgressBar progress(terminal.err, terminal.err_is_terminal, range.size());
  std::size_t applied = 0, points = 0;
  for (std::size_t k = range.first; k < range.end; ++k) {
    std::optional<Frame> frame = reader.Read(k);
    if (reader.stopped()) return reader.Result();
    if (!frame) continue;
    const Frame told = teller.Tell(*frame);
    const auto report = builder.Apply(told, {.allow_stamp_jump = flags.allow_stamp_jump});
    if (!report.ok()) {
      return InContext(absl::StrCat("frame ", k, " of ", flags.spec), report.status());
    }
    ++applied;
    points += frame->points_S.size();
    after(k, *std::move(frame), told, *report, builder);
    progress.Update(k + 1 - range.first, points);
  }
  progress.Finish();
  return applied > 0 ? absl::OkStatus() : reader.Result();
}

// The scene that is evaluated next is made once before: what is predicted is judged by how the
// world will have been corrected by then.
absl::Status CarryTruth(FrameRange range, const SceneParams& params, const Flags& flags,
                        const Terminal& terminal, TrueSource& source) {
  WorldCorrections corrections(Duration::max());
  FrameTeller teller(flags.errors);
  const auto add = [&](std::size_t, const Frame& frame, const Frame&, const FrameReport& report,
                       SceneBuilder&) {
    if (report.late_by > Duration::zero())
      return;  // placed by what is known of the frames about it
    corrections.Add(frame.stamp, *report.T_W_S * Inverse(frame.T_W_S));
  };
  terminal.err
      << "note: goes over the frames twice, first to see where registering puts the scans\n";
  const LeftOut before = *source.frames.left_out;
  FrameReader reader(source.frames, flags.keep_going);
  absl::Status status = MakeScene(reader, range, params, flags, terminal, teller, add);
  if (!status.ok()) return status;
  *source.frames.left_out = before;  // the next pass comes by the same frames
  source.truth = CarriedBy(std::move(corrections), source.truth);
  source.truth.description += ", where the sensor saw them (scans are registered to the map)";
  return absl::OkStatus();
}

absl::StatusOr<Evaluation> Evaluate(const TrueSource& source, FrameReader& reader, FrameRange range,
                                    const SceneParams& params, const Flags& flags,
                                    const Terminal& terminal) {
  Evaluator evaluator(source, flags.errors.unlabelled);
  FrameTeller teller(flags.errors);
  const auto add = [&](std::size_t k, Frame frame, const Frame& told, const FrameReport& report,
                       SceneBuilder& builder) {
    frame.T_W_S = *report.T_W_S;
    evaluator.Add(k, frame, report, teller.WithTrueNames(told, builder.Publish()));
  };
  auto status = MakeScene(reader, range, params, flags, terminal, teller, add);
  if (!status.ok()) return status;
  Evaluation found = std::move(evaluator).Result();
  found.identities = teller.identities();
  return found;
}

absl::Status Run(const Flags& flags, const Cli& cli) {
  const Terminal& terminal = cli.terminal;
  if (!flags.html.empty()) {
    if (auto status = CheckPage(flags.html); !status.ok()) return status;
  }
  auto source = OpenTrueSource(flags.spec, flags.source);
  if (!source.ok()) return source.status();
  const auto range = FramesIn(flags.range, flags.spec, source->frames);
  if (!range.ok()) return range.status();
  if (range->size() < source->frames.frame_count) {
    absl::StrAppend(&source->frames.description, ", frames ", range->first, " to ", range->end - 1);
  }
  const SceneParams params = ParamsOf(*source, flags);
  if (auto status = Validate(params); !status.ok()) return status;
  if (params.MendsSensorPoses() && !source->simulation) {
    if (auto status = CarryTruth(*range, params, flags, terminal, *source); !status.ok())
      return status;
  }
  FrameReader reader(source->frames, flags.keep_going);
  auto found = Evaluate(*source, reader, *range, params, flags, terminal);
  if (!found.ok()) return found.status();
  found->command = cli.command_line;
  if (!flags.html.empty()) {
    if (auto status = WriteHtml(flags.html, *source, *found); !status.ok()) return status;
  }
  const LeftOut& left_out = *source->frames.left_out;
  if (!left_out.Empty()) terminal.err << "warning: " << LeftOutText(left_out);
  flags.json ? PrintJson(terminal.out, *source, *found) : PrintText(terminal.out, *source, *found);
  return reader.Result();
}

}  // namespace

void AddEvaluate(Cli& cli) {
  auto flags = std::make_shared<Flags>();
  CLI::App* command =
      AddCommand(cli, "evaluate", "Compare maps and predictions with what is really there",
                 kExamples, [flags, &cli] { return Run(*flags, cli); });
  command
      ->add_option("input", flags->spec,
                   "A folder of LiDAR scans with boxes (CARLA's, too), a\nKITTI, TUM RGB-D or "
                   "ClusterSLAM sequence with poses of\nobjects, DynoSAM's logs, a recording whose "
                   "frames give\nposes of objects, or sim:NAME, whose truth is exact")
      ->required();
  AddFrameRangeFlags(command, &flags->range);
  command->add_option("--motion", flags->motion, "As of clearway-server --scene-motion")
      ->check(CLI::IsMember({"last", "track"}))
      ->capture_default_str();
  command
      ->add_option("--motion-from-points", flags->motion_from_points,
                   "As of clearway-server --scene-motion-from-points: auto,\non or off")
      ->check(CLI::IsMember(
          std::vector<std::string>(kMotionFromPointsNames.begin(), kMotionFromPointsNames.end())))
      ->capture_default_str();
  command->add_option("--solid", flags->solid, "As of clearway-server --scene-solid")
      ->check(
          CLI::IsMember(std::vector<std::string>(kSolidModeNames.begin(), kSolidModeNames.end())))
      ->capture_default_str();
  command
      ->add_option("--rest-distance", flags->rest_distance_m,
                   "As of clearway-server --scene-rest-distance-m")
      ->check(Between(0, 100))
      ->capture_default_str();
  command
      ->add_option("--object-voxel", flags->object_voxel_m,
                   "As of clearway-server --scene-object-resolution-m (unless\ngiven, what suits "
                   "the source)")
      ->check(Between(0.01, 10));
  command->add_option("--max-range", flags->max_range_m, "How far rays are used, in metres")
      ->check(Between(0.1, 1000))
      ->capture_default_str();
  command
      ->add_option("--grazing", flags->grazing_m,
                   "As of clearway-server --scene-grazing-m: with 4\nthe static map keeps what "
                   "rays only graze (98 % of\nsim:street's surface instead of 75)")
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
      ->add_option(
          "--sensor-error", flags->sensor_error_m,
          "As of clearway-server --scene-sensor-pose-error-m (unless\ngiven, what suits the "
          "source: 1 for oxts poses, 0 for\nothers); recorded boxes are then judged where "
          "the sensor\nsaw them")
      ->check(Between(0, 10));
  command
      ->add_option(
          "--sensor-error-deg", flags->sensor_error_deg,
          "The same of angles, in degrees (1.15 for oxts poses, or 0\nwith --sensor-error 0)")
      ->check(Between(0, 57));
  command->add_flag("--reidentify", flags->reidentify,
                    "As of clearway-server --scene-reidentify: for input\nwhose ids change, or "
                    "with --forget");
  command->add_flag("--filter-labels", flags->filter_labels,
                    "As of clearway-server --scene-filter-labels");
  command->add_flag("--clear-objects", flags->clear_objects,
                    "As of clearway-server --scene-clear-objects-by-rays");
  command
      ->add_option("--dynamic-life", flags->dynamic_life_s,
                   "As of clearway-server --scene-dynamic-life-s")
      ->check(Between(0, 1000))
      ->capture_default_str();
  command->add_flag("--allow-stamp-jump", flags->allow_stamp_jump,
                    "Go on across gaps of more than an hour between stamps");
  AddKeepGoingFlag(command, &flags->keep_going);
  command->add_option("--html", flags->html, "Also write a page with tables, plots and pictures")
      ->check([](const std::string& file) { return file.empty() ? "name a file" : ""; })
      ->type_name("FILE");
  command->add_flag("--json", flags->json, "Print JSON");
  AddErrorFlags(command, &flags->errors);
  AddSourceFlags(command, &flags->source);
}

}  // namespace clearway::cli
