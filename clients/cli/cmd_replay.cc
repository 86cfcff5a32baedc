// clearway replay: frames of any source to a server.
#include <functional>
#include <memory>

#include "absl/strings/str_cat.h"
#include "clearway/client/frame_sender.h"
#include "cli/ack_tally.h"
#include "cli/commands.h"
#include "cli/frame_range.h"
#include "cli/frame_reader.h"
#include "cli/json.h"
#include "cli/left_out_text.h"
#include "cli/message.h"
#include "cli/open_source.h"
#include "cli/pace.h"
#include "cli/progress.h"
#include "cli/replay_summary.h"
#include "cli/server_flags.h"
#include "cli/source_notes.h"
#include "cli/text.h"
#include "cli/told_frames.h"

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
  FrameRangeFlags range;
  std::string wait = "applied";
  double reconnect_for_s = 60;
  bool keep_going = false;
  bool allow_stamp_jump = false;
  std::uint64_t sensor_run = 0;
  bool quiet = false;
  bool json = false;
};

// Frames of the source through one stream; returns what stopped it early.
absl::Status SendAll(FrameReader& reader, FrameRange range, const Flags& flags, FrameSender& sender,
                     AckTally& tally, ProgressBar& progress) {
  Pace pace(flags.rate);
  FrameTeller teller(flags.errors);
  for (std::size_t i = range.first; i < range.end; ++i) {
    std::optional<Frame> frame = reader.Read(i);
    if (reader.stopped()) return absl::OkStatus();
    if (!frame) continue;
    frame->sensor_run ^= sender.sensor_run();  // keeps apart the runs of a recording
    pace.WaitFor(frame->stamp);
    tally.Sent(*frame);
    if (const absl::Status status = sender.Send(teller.Tell(*frame)); !status.ok()) return status;
    if (!flags.keep_going && tally.counts().refused > 0) return absl::OkStatus();
    progress.Update(tally.counts().answered + reader.unread(), tally.counts().points);
  }
  return absl::OkStatus();
}

// Says when the connection is lost and when it is back.
ReconnectOptions Reconnect(const Flags& flags, AckTally& tally,
                           std::function<void(const std::string&)> note) {
  ReconnectOptions reconnect;
  reconnect.give_up_after = FromSeconds(flags.reconnect_for_s);
  reconnect.on_change = [address = flags.server.address, &tally, note,
                         restarts = std::uint64_t{0}](const StreamState& state) mutable {
    if (!state.connected) {
      note(absl::StrCat("note: the connection to ", address, " is lost (",
                        std::string(state.last_error.message()), "); trying again"));
    } else if (state.server_restarts > restarts) {
      restarts = state.server_restarts;
      tally.ServerRestarted();
      note(
          absl::StrCat("warning: connected to ", address,
                       " again, but the server restarted: the scene of the frames so far is gone"));
    } else if (state.reconnects > 0) {
      note(absl::StrCat("note: connected to ", address,
                        " again; frames without an answer are sent again"));
    }
  };
  return reconnect;
}

std::string Sent(const AckTally::Counts& counts) {
  return absl::StrCat("; ", Plural(counts.answered, "frame"),
                      counts.answered == 1 ? " was" : " were", " sent");
}

absl::Status Run(const Flags& flags, const Terminal& terminal) {
  const auto source = OpenSource(flags.spec, flags.source);
  if (!source.ok()) return source.status();
  const auto range = FramesIn(flags.range, flags.spec, *source);
  if (!range.ok()) return range.status();
  const auto connection = Connect(flags.server);
  if (!connection.ok()) return connection.status();

  if (!flags.quiet) PrintSourceNotes(*source, (*connection)->server().params, terminal.err);

  AckTally tally;
  std::ostream nowhere(nullptr);
  ProgressBar progress(flags.quiet ? nowhere : terminal.err, terminal.err_is_terminal,
                       range->size());
  const auto note = [&](const std::string& line) {
    if (!flags.quiet) return progress.Note(line);
    terminal.err << line << std::endl;  // a lost connection is no progress
  };
  // Its stream uses what stands above.
  FrameSender sender(*connection,
                     {.sensor_run = flags.sensor_run, .allow_stamp_jump = flags.allow_stamp_jump});
  const AckLevel wait_for = flags.wait == "accepted" ? AckLevel::kAccepted : AckLevel::kApplied;
  absl::Status status = sender.OpenStream(tally.OnAck(), wait_for, Reconnect(flags, tally, note));
  if (!status.ok()) return status;
  FrameReader reader(*source, flags.keep_going);
  status = SendAll(reader, *range, flags, sender, tally, progress);
  const std::uint64_t reconnects = sender.state().reconnects;
  // The stream's end knows why it broke.
  if (const absl::Status closed = sender.CloseStream(); !closed.ok()) status = closed;
  const AckTally::Counts counts = tally.counts();
  progress.Update(counts.answered + reader.unread(), counts.points);
  progress.Finish();
  if (!status.ok()) {
    return InContext(absl::StrCat("after ", Plural(counts.answered, "frame"), " of ", range->size(),
                                  " were applied or refused"),
                     status);
  }
  if (reader.stopped()) return reader.Result(Sent(counts));

  if (!source->left_out->Empty()) terminal.err << "warning: " << LeftOutText(*source->left_out);
  if (flags.json) {
    Print(terminal.out, SummaryJson(counts, *source, reconnects, progress.state().elapsed_s));
  } else {
    PrintSummary(terminal.out, counts);
  }
  if (counts.refused > 0) {
    return InContext(absl::StrCat("frame ", counts.first_refused_sequence, " of ",
                                  counts.first_refused_sensor, " was refused"),
                     counts.first_refusal);
  }
  if (absl::Status unread = reader.Result(); !unread.ok()) return unread;
  if (counts.lost > 0) {
    return absl::DataLossError(absl::StrCat("the server restarted: its scene lacks the first ",
                                            Plural(counts.lost, "frame"),
                                            "; 'clearway reset', then replay again"));
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
                   "ClusterSLAM sequence, PCD or PLY files\nwith poses, DynoSAM's logs, or "
                   "sim:NAME (a scenario of\n'simulate')")
      ->required();
  command
      ->add_option(
          "--rate", flags->rate,
          "Times as fast as recorded; 1 is real time\n(default: as fast as the server goes)")
      ->check(Between(1e-3, 1e6));
  AddFrameRangeFlags(command, &flags->range);
  command->add_option("--wait", flags->wait, "When a frame counts as done: accepted or applied")
      ->check(CLI::IsMember({"accepted", "applied"}).description(""))
      ->capture_default_str();
  command
      ->add_option(
          "--reconnect-for", flags->reconnect_for_s,
          "Longest time to try again when the connection is lost, in\nseconds; 0 to give up "
          "at once")
      ->check(Between(0, 1e6))
      ->capture_default_str();
  AddKeepGoingFlag(command, &flags->keep_going,
                   "Go on after a frame that cannot be read or that the server\nrefuses; it is "
                   "left out (the exit code is 1 still)");
  command
      ->add_option("--sensor-run", flags->sensor_run,
                   "Part of each frame's name. With the same number, frames\nthat the server has "
                   "already are not applied twice\n(default: random for each replay)")
      ->check(NotNegative());
  command->add_flag("--allow-stamp-jump", flags->allow_stamp_jump,
                    "Send stamps further ahead than the server's\nmax_stamp_jump_s, too");
  command->add_flag("-q,--quiet", flags->quiet, "No progress on stderr");
  command->add_flag("--json", flags->json, "Print a summary as JSON");
  AddErrorFlags(command, &flags->errors);
  AddSourceFlags(command, &flags->source);
  AddServerFlags(command, &flags->server);
}

}  // namespace clearway::cli
