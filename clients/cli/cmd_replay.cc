// clearway replay: frames of any source to a server.
#include <cmath>
#include <memory>
#include <thread>

#include "absl/strings/str_cat.h"
#include "clearway/client/frame_sender.h"
#include "cli/ack_tally.h"
#include "cli/commands.h"
#include "cli/json.h"
#include "cli/left_out_text.h"
#include "cli/message.h"
#include "cli/open_source.h"
#include "cli/progress.h"
#include "cli/server_flags.h"
#include "cli/text.h"
#include "cli/told_frames.h"
#include "cli/values.h"

namespace clearway::cli {
namespace {

constexpr char kExamples[] =
    "  clearway replay crossing.cwr\n"
    "  clearway replay sim:street --noise table1 --rate 1\n"
    "  clearway replay sim:occlusions --seed 3 --forget 0.5\n"
    "  clearway replay ~/data/kitti0000_fov --poses icp --from 0 --to 59\n"
    "  clearway replay ~/data/rgbd_dataset_freiburg3_walking_xyz --stride 2 --max-depth 5";

struct Flags {
  ServerFlags server;
  SourceFlags source;
  ErrorFlags errors;
  std::string spec;
  std::optional<double> rate;
  std::size_t from = 0;
  std::optional<std::size_t> to;
  std::string wait = "applied";
  bool keep_going = false;
  bool quiet = false;
  bool json = false;
};

// Sleeps so that frames leave in the rhythm of their stamps, `rate` times as fast.
class Pace {
 public:
  explicit Pace(std::optional<double> rate) : rate_(rate) {}

  void WaitFor(Time stamp) {
    if (!rate_) return;
    if (!started_) first_ = stamp;
    started_ = true;
    std::this_thread::sleep_until(
        start_ + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                     std::chrono::duration<double>(ToSeconds(stamp - first_) / *rate_)));
  }

 private:
  const std::optional<double> rate_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  bool started_ = false;
  Time first_;  // the first frame's
};

// Frames [first, end) of the source through one stream; returns what stopped it early.
absl::Status SendAll(const FrameSource& source, std::size_t first, std::size_t end,
                     const Flags& flags, FrameSender& sender, AckTally& tally,
                     ProgressBar& progress) {
  Pace pace(flags.rate);
  FrameTeller teller(flags.errors);
  for (std::size_t i = first; i < end; ++i) {
    const auto frame = source.read(i);
    if (!frame.ok()) return frame.status();
    pace.WaitFor(frame->stamp);
    tally.Sent(frame->points_S.size());
    if (const absl::Status status = sender.Send(teller.Tell(*frame)); !status.ok()) return status;
    if (!flags.keep_going && tally.counts().refused > 0) return absl::OkStatus();
    progress.Update(tally.counts().answered, tally.counts().points);
  }
  return absl::OkStatus();
}

Json AsJson(const AckTally::Counts& counts, const LeftOut& left_out, double seconds) {
  Json json = {{"frames", counts.answered},
               {"applied", counts.answered - counts.refused},
               {"refused", counts.refused},
               {"repeated", counts.repeated},
               {"points", counts.points},
               {"version", counts.last.version},
               {"stamp_ns", ToNanoseconds(counts.last.stamp)},
               {"elapsed_s", seconds},
               {"left_out", ToJson(left_out)}};
  if (counts.refused > 0) json["first_refusal"] = counts.first_refusal.ToString();
  return json;
}

void PrintText(std::ostream& out, const AckTally::Counts& counts) {
  out << "sent " << Plural(counts.answered, "frame");
  if (counts.refused > 0) out << " (" << counts.refused << " refused)";
  out << ", " << Plural(counts.points, "point");
  if (counts.last.version > 0) {
    out << "; scene version " << counts.last.version << ", newest stamp "
        << Seconds(counts.last.stamp);
  }
  out << "\n";
  if (counts.repeated > 0) {
    out << Plural(counts.repeated, "frame")
        << " had been sent before and changed nothing ('clearway reset' starts over)\n";
  }
}

// Not an error: coarser maps are often wanted.
void NoteResolution(const FrameSource& source, const SceneParams& params, std::ostream& err) {
  if (std::abs(source.resolution_m - params.resolution_m) < 1e-9) return;
  err << "note: these frames suit voxels of " << source.resolution_m << " m; the server has "
      << params.resolution_m << " m (clearway-server --scene-resolution-m)\n";
}

// Not an error either: it costs time to register scans.
void NotePoseError(const FrameSource& source, const SceneParams& params, std::ostream& err) {
  const bool drift = source.sensor_pose_error_m > 0 || source.sensor_pose_error_rad > 0;
  if (!drift || params.MendsSensorPoses()) return;
  err << "note: the sensor's poses are off by about " << source.sensor_pose_error_m
      << " m; the server takes them as they are (clearway-server --scene-sensor-pose-error-m "
      << source.sensor_pose_error_m << " --scene-sensor-pose-error-rad "
      << source.sensor_pose_error_rad << " registers scans to the map)\n";
}

absl::Status CheckRange(const Flags& flags, std::size_t frame_count) {
  if (frame_count == 0) return absl::FailedPreconditionError(flags.spec + ": holds no frames");
  const std::size_t to = flags.to.value_or(frame_count - 1);
  if (flags.from > to) {
    return UsageError(absl::StrCat("--from ", flags.from, " is after --to ", to));
  }
  if (to >= frame_count) {
    return UsageError(
        absl::StrCat("--to ", to, ": ", flags.spec, " ends at frame ", frame_count - 1));
  }
  return absl::OkStatus();
}

absl::Status Run(const Flags& flags, const Terminal& terminal) {
  const auto source = OpenSource(flags.spec, flags.source);
  if (!source.ok()) return source.status();
  if (const absl::Status status = CheckRange(flags, source->frame_count); !status.ok())
    return status;
  const std::size_t end = flags.to ? *flags.to + 1 : source->frame_count;
  const auto connection = Connect(flags.server);
  if (!connection.ok()) return connection.status();

  if (!flags.quiet) {
    NoteResolution(*source, (*connection)->server().params, terminal.err);
    NotePoseError(*source, (*connection)->server().params, terminal.err);
  }

  AckTally tally;
  FrameSender sender(*connection);
  const AckLevel wait_for = flags.wait == "accepted" ? AckLevel::kAccepted : AckLevel::kApplied;
  absl::Status status = sender.OpenStream(tally.OnAck(), wait_for);
  if (!status.ok()) return status;
  std::ostream nowhere(nullptr);
  ProgressBar progress(flags.quiet ? nowhere : terminal.err, terminal.err_is_terminal,
                       end - flags.from);
  status = SendAll(*source, flags.from, end, flags, sender, tally, progress);
  // The stream's end knows why it broke.
  if (const absl::Status closed = sender.CloseStream(); !closed.ok()) status = closed;
  const AckTally::Counts counts = tally.counts();
  progress.Update(counts.answered, counts.points);
  progress.Finish();
  if (!status.ok()) return status;

  if (!source->left_out->Empty()) terminal.err << "warning: " << LeftOutText(*source->left_out);
  if (flags.json) {
    Print(terminal.out, AsJson(counts, *source->left_out, progress.state().elapsed_s));
  } else {
    PrintText(terminal.out, counts);
  }
  if (counts.refused > 0) {
    return InContext(absl::StrCat("frame ", counts.first_refused_sequence, " of ",
                                  counts.first_refused_sensor, " was refused"),
                     counts.first_refusal);
  }
  return absl::OkStatus();
}

}  // namespace

void AddReplay(Cli& cli) {
  auto flags = std::make_shared<Flags>();
  CLI::App* command = AddCommand(cli, "replay", "Send frames to the server", kExamples,
                                 [flags, &cli] { return Run(*flags, cli.terminal); });
  command
      ->add_option("source", flags->spec,
                   "A recording, a folder of LiDAR scans (CARLA's, too), a\nKITTI, TUM RGB-D or "
                   "ClusterSLAM sequence, DynoSAM's\nlogs, or sim:NAME (a scenario of 'simulate')")
      ->required();
  command
      ->add_option(
          "--rate", flags->rate,
          "Times as fast as recorded; 1 is real time\n(default: as fast as the server goes)")
      ->check(Between(1e-3, 1e6));
  command->add_option("--from", flags->from, "First frame, counted from 0")->capture_default_str();
  command->add_option("--to", flags->to, "Last frame (default: the source's last)");
  command->add_option("--wait", flags->wait, "When a frame counts as done: accepted or applied")
      ->check(CLI::IsMember({"accepted", "applied"}).description(""))
      ->capture_default_str();
  command->add_flag("--keep-going", flags->keep_going,
                    "Go on after a refused frame (the exit code is 1 still)");
  command->add_flag("-q,--quiet", flags->quiet, "No progress on stderr");
  command->add_flag("--json", flags->json, "Print a summary as JSON");
  AddErrorFlags(command, &flags->errors);
  AddSourceFlags(command, &flags->source);
  AddServerFlags(command, &flags->server);
}

}  // namespace clearway::cli
