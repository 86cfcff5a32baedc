#include "demo/run.h"

#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "clearway/client/scene_mirror.h"
#include "clearway/report/object_sheet.h"
#include "clearway/report/top_view.h"
#include "demo/case.h"
#include "demo/case_json.h"
#include "demo/questions.h"
#include "demo/replay.h"
#include "demo/server_process.h"

namespace clearway::demo {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kHorizonS = 12;  // predictions are asked for as long as a crossing takes
// In a second. Recorded boxes of parked vehicles jitter; on the KITTI drive 0.4 is too little.
constexpr double kRestDistanceM = 0.6;
constexpr double kMaxRangeM = 50;  // beyond, the beams of a LiDAR lie too far apart

std::vector<std::string> ServerFlags(const Sequence& sequence) {
  const double resolution_m = sequence.frames.resolution_m;
  return {"--log-level=warning",
          absl::StrCat("--scene-resolution-m=", resolution_m),
          absl::StrCat("--scene-object-resolution-m=", resolution_m),
          absl::StrCat("--scene-horizon-s=", kHorizonS),
          absl::StrCat("--scene-rest-distance-m=", kRestDistanceM),
          absl::StrCat("--scene-max-range-m=", kMaxRangeM)};
}

// One run; each step writes its part of the summary.
class Demo {
 public:
  Demo(const DemoOptions& options, const Sequence& sequence, std::ostream& out, bool is_terminal)
      : options_(options), sequence_(sequence), out_(out), is_terminal_(is_terminal) {}

  absl::Status Start() {
    auto server = ServerProcess::Start(options_.server, ServerFlags(sequence_));
    if (!server.ok()) return server.status();
    server_ = *std::move(server);
    auto connection = Connection::Open(server_->address());
    if (!connection.ok()) return connection.status();
    connection_ = *std::move(connection);
    auto mirror = SceneMirror::Follow(connection_);
    if (!mirror.ok()) return mirror.status();
    mirror_ = *std::move(mirror);
    replay_ = std::make_unique<Replay>(connection_, sequence_.frames, out_, is_terminal_);
    out_ << "Server " << server_->pid() << " at " << server_->address() << "\n"
         << "Sequence: " << sequence_.frames.description << "\n";
    summary_ = {{"sequence", sequence_.name},
                {"source", sequence_.frames.description},
                {"truth", sequence_.truth.description},
                {"stops", Json::array()}};
    return absl::OkStatus();
  }

  // Replays up to the stop and deals with its problems.
  absl::Status RunStop(const Stop& stop) {
    const auto scene = ReplayThrough(stop.frame);
    if (!scene.ok()) return scene.status();
    Json json{{"frame", stop.frame}, {"scene_version", (*scene)->version}};
    const SceneClient client(connection_);
    const auto objects = AskObjects(client, **scene, sequence_.object_names);
    if (!objects.ok()) return objects.status();
    const auto occupancy = AskOccupancy(client, **scene, sequence_.object_names);
    if (!occupancy.ok()) return occupancy.status();
    out_ << "\n" << objects->table << "\n" << occupancy->table;
    json["objects"] = objects->json;
    json["occupancy"] = occupancy->json;
    json["cases"] = Json::array();
    for (const Problem& problem : stop.problems) {
      const auto result =
          RunCase(connection_, **scene, problem, sequence_.truth, options_.planning);
      if (!result.ok()) return result.status();
      const std::string picture = absl::StrCat("case_", ++cases_, ".png");
      const absl::Status drawn = DrawCase(**scene, *result, sequence_, options_.output / picture);
      if (!drawn.ok()) return drawn;
      PrintCase(*result, picture);
      Json case_json = JsonOf(*result);
      case_json["picture"] = picture;
      json["cases"].push_back(std::move(case_json));
      all_passed_ = all_passed_ && result->Passed();
    }
    summary_["stops"].push_back(std::move(json));
    return absl::OkStatus();
  }

  // The rest of the sequence, and what is known after it.
  absl::Status Finish() {
    const auto scene = ReplayThrough(sequence_.frames.frame_count - 1);
    if (!scene.ok()) return scene.status();
    const auto objects = AskObjects(SceneClient(connection_), **scene, sequence_.object_names);
    if (!objects.ok()) return objects.status();
    out_ << "\nAfter the last frame:\n" << objects->table;
    if (const absl::Status drawn = DrawScene(**scene); !drawn.ok()) return drawn;
    const ReplayTotals& totals = replay_->totals();
    summary_["objects"] = objects->json;
    summary_["replay"] = {
        {"frames", totals.frames}, {"points", totals.points}, {"seconds", totals.seconds}};
    summary_["scene"] = {{"version", (*scene)->version},
                         {"hash", (*scene)->Hash()},
                         {"static_observed_voxels", (*scene)->static_map_W.observed_count()},
                         {"static_occupied_voxels", (*scene)->static_map_W.occupied_count()}};
    summary_["pictures"] = {"overview.png", "objects.png"};
    summary_["passed"] = all_passed_;
    mirror_.reset();
    replay_.reset();
    connection_.reset();
    return server_->Stop();
  }

  absl::Status WriteSummary() const {
    const std::filesystem::path file = options_.output / "summary.json";
    std::ofstream stream(file);
    stream << summary_.dump(2) << "\n";
    stream.close();
    if (stream.fail()) return absl::InternalError(absl::StrCat("cannot write ", file.string()));
    out_ << "\nWritten to " << options_.output.string() << ": summary.json, " << cases_
         << (cases_ == 1 ? " case" : " cases") << ", overview.png, objects.png\n";
    return absl::OkStatus();
  }

  bool all_passed() const { return all_passed_; }

 private:
  absl::StatusOr<ScenePtr> ReplayThrough(std::size_t frame) {
    out_ << "\nFrames up to " << frame << "\n";
    const absl::Status status = replay_->Through(frame);
    if (!status.ok()) return status;
    return mirror_->WaitFor(replay_->totals().version, std::chrono::seconds(30));
  }

  void PrintCase(const CaseResult& result, const std::string& picture) {
    out_ << "\n" << result.name << "\n";
    if (!result.void_places.empty()) {
      out_ << "  void at " << result.void_places.size()
           << " places, first: " << result.void_places.front() << "\n";
    }
    if (result.crossing) {
      const Crossing& crossing = *result.crossing;
      if (crossing.shift_m != 0) {
        out_ << absl::StrFormat("  crossing shifted by %+.1f m along the object's path\n",
                                crossing.shift_m);
      }
      if (result.straight.touched != crossing.blocker) {
        out_ << absl::StrFormat(
            "  no place before object %d itself: this one is before object %d\n", crossing.blocker,
            result.straight.touched);
      }
      out_ << absl::StrFormat("  straight at %g m/s: touches object %d after %.2f s\n",
                              crossing.max_speed_mps, result.straight.touched,
                              ToSeconds(*result.straight.contact - crossing.now));
    }
    if (result.plan) {
      out_ << absl::StrFormat(
          "  plan (%s, %.1f s): version %d, margin %g m, inflation %g m/s, %d states checked, "
          "%.1f %% unknown space, closest %.2f m\n",
          result.plan->planner, result.planning_s, result.plan->version, result.margin_m,
          result.plan->inflation_mps, result.plan->states_checked,
          100 * result.plan->unknown_fraction, result.verdict.closest_m);
    }
    const char* const passed =
        result.KnownToTheEnd() ? "PASSED: " : "PASSED as far as it is recorded: ";
    out_ << "  " << (result.Passed() ? passed : "FAILED: ") << result.Conclusion() << "  ["
         << picture << "]\n";
  }

  absl::Status DrawScene(const SceneSnapshot& scene) const {
    TopViewOptions overview;
    overview.title =
        absl::StrCat(sequence_.name, ": the map after ", sequence_.frames.frame_count, " frames");
    overview.subtitle = absl::StrFormat("%d occupied voxels of %g m, %d objects",
                                        scene.static_map_W.occupied_count(),
                                        scene.params.resolution_m, scene.objects.size());
    overview.names = sequence_.object_names;
    overview.area_W = scene.static_map_W.OccupiedBox().Padded(2);
    const absl::Status status = WriteTopView(scene, overview, options_.output / "overview.png");
    if (!status.ok()) return status;
    ObjectSheetOptions sheet;
    sheet.title = absl::StrCat(sequence_.name, ": objects as reconstructed");
    sheet.names = sequence_.object_names;
    return WriteObjectSheet(scene, sheet, options_.output / "objects.png");
  }

  const DemoOptions& options_;
  const Sequence& sequence_;
  std::ostream& out_;
  bool is_terminal_;
  std::unique_ptr<ServerProcess> server_;
  std::shared_ptr<Connection> connection_;
  std::unique_ptr<SceneMirror> mirror_;
  std::unique_ptr<Replay> replay_;
  Json summary_;
  int cases_ = 0;
  bool all_passed_ = true;
};

}  // namespace

absl::StatusOr<bool> RunDemo(const DemoOptions& options, std::ostream& out, bool is_terminal) {
  const auto sequence = options.data.empty() ? SimulatedSequence(options.scenario)
                                             : RecordedSequence(options.data, options.plan_after);
  if (!sequence.ok()) return sequence.status();
  std::error_code error;
  std::filesystem::create_directories(options.output, error);
  if (error) {
    return absl::InvalidArgumentError(
        absl::StrCat("out: cannot make '", options.output.string(), "': ", error.message()));
  }
  Demo demo(options, *sequence, out, is_terminal);
  absl::Status status = demo.Start();
  for (const Stop& stop : sequence->stops) {
    if (status.ok()) status = demo.RunStop(stop);
  }
  if (status.ok()) status = demo.Finish();
  if (status.ok()) status = demo.WriteSummary();
  if (!status.ok()) return status;
  return demo.all_passed();
}

}  // namespace clearway::demo
