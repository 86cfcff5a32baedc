#include "demo/run.h"

#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "clearway/client/scene_mirror.h"
#include "demo/case.h"
#include "demo/case_json.h"
#include "demo/case_text.h"
#include "demo/drive.h"
#include "demo/questions.h"
#include "demo/replay.h"
#include "demo/scene_pictures.h"
#include "demo/scene_setup.h"
#include "demo/server_process.h"

namespace clearway::demo {
namespace {

using Json = nlohmann::ordered_json;

// A drive, and the scene that it began with.
struct Driven {
  ScenePtr from;
  Drive drive;
};

// One run; each step writes its part of the summary.
class Demo {
 public:
  Demo(const DemoOptions& options, const Sequence& sequence, std::ostream& out, bool is_terminal)
      : options_(options), sequence_(sequence), out_(out), is_terminal_(is_terminal) {}

  absl::Status Start() {
    const SceneParams params = ParamsFor(sequence_, options_.drive);
    if (options_.drive) {
      auto hindsight = SceneAtTheEnd(sequence_, params);
      if (!hindsight.ok()) return hindsight.status();
      hindsight_ = *std::move(hindsight);
    }
    auto server = ServerProcess::Start(options_.server, ServerFlags(params));
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
      auto posed =
          PoseCase(connection_, **scene, hindsight_, problem, sequence_.truth, options_.planning);
      if (!posed.ok()) return posed.status();
      if (options_.drive && posed->place) {
        drives_.push_back({*scene, Drive(*std::move(posed), options_.planning)});
        drives_.back().drive.Step(*scene);
        continue;
      }
      const auto result = PlanCase(*std::move(posed), sequence_.truth, options_.planning);
      if (!result.ok()) return result.status();
      const auto case_json = Report(**scene, *result);
      if (!case_json.ok()) return case_json.status();
      json["cases"].push_back(*case_json);
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
    if (options_.drive) summary_["drives"] = Json::array();
    for (const Driven& driven : drives_) {
      const auto case_json = Report(*driven.from, driven.drive.Result(sequence_.truth));
      if (!case_json.ok()) return case_json.status();
      summary_["drives"].push_back(*case_json);
    }
    const absl::Status drawn = DrawScene(**scene, sequence_, options_.output);
    if (!drawn.ok()) return drawn;
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
    // Who drives has to see each of them.
    for (std::size_t next = replay_->totals().frames; !drives_.empty() && next < frame; ++next) {
      const auto scene = SceneAfter(next);
      if (!scene.ok()) return scene.status();
      for (Driven& driven : drives_) driven.drive.Step(*scene);
    }
    const auto scene = SceneAfter(frame);
    if (scene.ok())
      for (Driven& driven : drives_) driven.drive.Step(*scene);
    return scene;
  }

  absl::StatusOr<ScenePtr> SceneAfter(std::size_t frame) {
    const absl::Status status = replay_->Through(frame);
    if (!status.ok()) return status;
    return mirror_->WaitFor(replay_->totals().version, std::chrono::seconds(30));
  }

  // Draws and prints; the JSON names the picture.
  absl::StatusOr<Json> Report(const SceneSnapshot& scene, const CaseResult& result) {
    const std::string picture = absl::StrCat("case_", ++cases_, ".png");
    const absl::Status drawn = DrawCase(scene, result, sequence_, options_.output / picture);
    if (!drawn.ok()) return drawn;
    Print(result, picture, out_);
    Json json = JsonOf(result);
    json["picture"] = picture;
    all_passed_ = all_passed_ && result.Passed();
    return json;
  }

  const DemoOptions& options_;
  const Sequence& sequence_;
  std::ostream& out_;
  bool is_terminal_;
  std::unique_ptr<ServerProcess> server_;
  std::shared_ptr<Connection> connection_;
  std::unique_ptr<SceneMirror> mirror_;
  std::unique_ptr<Replay> replay_;
  ScenePtr hindsight_;  // if crossings are driven
  std::vector<Driven> drives_;
  Json summary_;
  int cases_ = 0;
  bool all_passed_ = true;
};

}  // namespace

absl::StatusOr<bool> RunDemo(const DemoOptions& options, std::ostream& out, bool is_terminal) {
  const auto sequence =
      options.data.empty() ? SimulatedSequence(options.scenario)
                           : RecordedSequence(options.data, options.plan_after,
                                              options.drive ? kDriveMotionsOver : Duration::zero());
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
