// clearway evaluate: what a scene foresaw, against what really happened.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <thread>

#include "absl/strings/str_cat.h"
#include "clearway/report/prediction_score.h"
#include "clearway/report/table.h"
#include "clearway/scene/scene_builder.h"
#include "cli/commands.h"
#include "cli/json.h"
#include "cli/progress.h"
#include "cli/text.h"
#include "cli/truth_source.h"

namespace clearway::cli {
namespace {

constexpr char kExamples[] =
    "  clearway evaluate sim:street --noise table1\n"
    "  clearway evaluate kitti0000_fov --poses icp --rest-distance 0.6 --json";

// How far ahead.
constexpr std::array kAhead = {std::chrono::milliseconds(500), std::chrono::milliseconds(1000),
                               std::chrono::milliseconds(2000), std::chrono::milliseconds(3000)};
constexpr double kMost = 0.95;  // the share of predictions whose error is told beside the median

struct Flags {
  std::string spec;
  SourceFlags source;
  double rest_distance_m = 0;
  double max_range_m = 50;
  bool json = false;
};

using Errors = std::map<ObjectId, std::vector<PredictionErrors>>;

SceneParams ParamsOf(const TrueSource& source, const Flags& flags) {
  SceneParams params;
  params.resolution_m = params.object_resolution_m = source.frames.resolution_m;
  params.rays.max_range_m = flags.max_range_m;
  params.rest_distance_m = flags.rest_distance_m;
  return params;
}

absl::StatusOr<Errors> Evaluate(const TrueSource& source, const SceneParams& params,
                                const Terminal& terminal) {
  ThreadPool pool(static_cast<int>(std::max(1u, std::thread::hardware_concurrency())));
  SceneBuilder builder(params, FrameLimits(), pool);
  PredictionScore score(source.truth, {kAhead.begin(), kAhead.end()});
  ProgressBar progress(terminal.err, terminal.err_is_terminal, source.frames.frame_count);
  std::uint64_t points = 0;
  for (std::size_t k = 0; k < source.frames.frame_count; ++k) {
    const auto frame = source.frames.read(k);
    if (!frame.ok()) return frame.status();
    if (const auto report = builder.Apply(*frame); !report.ok()) return report.status();
    score.Add(*builder.Publish());
    points += frame->points_S.size();
    progress.Update(k + 1, points);
  }
  progress.Finish();
  return score.Errors();
}

std::string NameOf(const TrueSource& source, ObjectId id) {
  const auto name = source.names.find(id);
  return name == source.names.end() ? "" : name->second;
}

void PrintText(std::ostream& out, const TrueSource& source, const Errors& errors) {
  out << source.frames.description << "\n\n"
      << "How far from its true place each object is predicted, in metres: median, and what 95 % "
         "of "
         "the\npredictions do not exceed.\n\n";
  std::vector<std::string> header = {"id", "what", "predictions"};
  for (const Duration ahead : kAhead) {
    header.push_back(absl::StrCat(ToSeconds(ahead), " s"));
    header.push_back("95 %");
  }
  Table table(header);
  const auto text = [](double error_m) { return std::isnan(error_m) ? "-" : Fixed(error_m, 2); };
  for (const auto& [id, of_object] : errors) {
    std::vector<std::string> row = {absl::StrCat(id), NameOf(source, id),
                                    absl::StrCat(of_object[0].errors_m.size())};
    for (const PredictionErrors& e : of_object) {
      row.push_back(text(e.Median()));
      row.push_back(text(e.Quantile(kMost)));
    }
    table.AddRow(row);
  }
  out << table.ToString();
}

Json AsJson(const TrueSource& source, const Errors& errors) {
  Json json = {{"source", source.frames.description},
               {"truth", source.truth.description},
               {"frames", source.frames.frame_count},
               {"objects", Json::array()}};
  for (const auto& [id, of_object] : errors) {
    Json object = {{"id", id}, {"name", NameOf(source, id)}, {"prediction", Json::array()}};
    for (const PredictionErrors& e : of_object) {  // no number becomes null
      object["prediction"].push_back({{"ahead_s", ToSeconds(e.ahead)},
                                      {"count", e.errors_m.size()},
                                      {"median_m", e.Median()},
                                      {"p95_m", e.Quantile(kMost)}});
    }
    json["objects"].push_back(object);
  }
  return json;
}

absl::Status Run(const Flags& flags, const Terminal& terminal) {
  const auto source = OpenTrueSource(flags.spec, flags.source);
  if (!source.ok()) return source.status();
  const SceneParams params = ParamsOf(*source, flags);
  if (auto status = Validate(params); !status.ok()) return status;
  const auto errors = Evaluate(*source, params, terminal);
  if (!errors.ok()) return errors.status();
  if (flags.json) {
    Print(terminal.out, AsJson(*source, *errors));
  } else {
    PrintText(terminal.out, *source, *errors);
  }
  return absl::OkStatus();
}

}  // namespace

void AddEvaluate(Cli& cli) {
  auto flags = std::make_shared<Flags>();
  CLI::App* command =
      AddCommand(cli, "evaluate", "Compare what a scene foresees with what really happens",
                 kExamples, [flags, &cli] { return Run(*flags, cli.terminal); });
  command
      ->add_option("input", flags->spec,
                   "A folder of LiDAR scans with boxes, or sim:NAME: they know\nthe truth")
      ->required();
  command
      ->add_option("--rest-distance", flags->rest_distance_m,
                   "As of clearway-server --scene-rest-distance-m")
      ->check(Between(0, 100))
      ->capture_default_str();
  command->add_option("--max-range", flags->max_range_m, "How far rays are used, in metres")
      ->check(Between(0.1, 1000))
      ->capture_default_str();
  command->add_flag("--json", flags->json, "Print JSON");
  AddSourceFlags(command, &flags->source);
}

}  // namespace clearway::cli
