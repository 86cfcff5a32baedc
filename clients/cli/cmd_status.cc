// clearway status: what a server is doing.
#include <memory>

#include "clearway/client/scene_client.h"
#include "cli/commands.h"
#include "cli/json.h"
#include "cli/server_flags.h"
#include "cli/text.h"

namespace clearway::cli {
namespace {

constexpr char kExamples[] =
    "  clearway status\n"
    "  clearway status --hash --json --server unix:/run/clearway.sock";

struct Flags {
  ServerFlags server;
  bool hash = false;
  bool json = false;
};

Json AsJson(const ServerStatus& s) {
  Json json = ToJson(static_cast<const Versioned&>(s));
  if (!s.scene_hash.empty()) json["scene_hash"] = s.scene_hash;
  json.update(Json{{"uptime_s", s.uptime_s},
                   {"draining", s.draining},
                   {"frames_applied", s.frames_applied},
                   {"frames_refused", s.frames_refused},
                   {"frames_late", s.frames_late},
                   {"queued_frames", s.queued_frames},
                   {"points_used", s.points_used},
                   {"points_not_finite", s.points_not_finite},
                   {"objects", s.objects},
                   {"static_observed_voxels", s.static_observed_voxels},
                   {"static_occupied_voxels", s.static_occupied_voxels},
                   {"static_box_world", ToJson(s.static_box_W)},
                   {"robots", s.robots},
                   {"leases", s.leases},
                   {"follow_streams", s.follow_streams},
                   {"push_streams", s.push_streams},
                   {"watch_streams", s.watch_streams},
                   {"resident_bytes", s.resident_bytes},
                   {"heap_bytes_in_use", s.heap_bytes_in_use}});
  return json;
}

void PrintText(std::ostream& out, const std::string& address, const ServerStatus& s) {
  out << "server      " << address << ", up for " << Clock(s.uptime_s)
      << (s.draining ? ", draining" : "") << "\n"
      << "scene       version " << s.version << ", newest stamp " << Seconds(s.stamp) << "\n";
  if (!s.scene_hash.empty()) out << "hash        " << s.scene_hash << "\n";
  out << "frames      " << Grouped(s.frames_applied) << " applied (" << Grouped(s.frames_late)
      << " of them late), " << Grouped(s.frames_refused) << " refused since it started, "
      << Grouped(s.queued_frames) << " waiting\n"
      << "points      " << Grouped(s.points_used) << " used, " << Grouped(s.points_not_finite)
      << " not finite since it started\n"
      << "static map  " << Plural(s.static_observed_voxels, "voxel") << " observed, "
      << Grouped(s.static_occupied_voxels) << " of them occupied\n";
  if (!s.static_box_W.Empty()) {
    out << "            from " << Point(s.static_box_W.min, 1) << " to "
        << Point(s.static_box_W.max, 1) << " m\n";
  }
  out << "objects     " << s.objects << "\n"
      << "clients     " << Plural(s.push_streams, "push stream") << ", "
      << Plural(s.follow_streams, "follow stream") << ", "
      << Plural(s.watch_streams, "watch stream") << ", " << Plural(s.leases, "lease") << ", "
      << Plural(s.robots, "robot") << "\n"
      << "memory      " << Grouped(s.resident_bytes >> 20) << " MiB resident, "
      << Grouped(s.heap_bytes_in_use >> 20) << " MiB handed out by the heap\n";
}

absl::Status Run(const Flags& flags, const Terminal& terminal) {
  const auto connection = Connect(flags.server);
  if (!connection.ok()) return connection.status();
  const auto status = SceneClient(*connection).GetStatus(flags.hash);
  if (!status.ok()) return status.status();
  if (flags.json) {
    Print(terminal.out, AsJson(*status));
  } else {
    PrintText(terminal.out, flags.server.address, *status);
  }
  return absl::OkStatus();
}

}  // namespace

void AddStatus(Cli& cli) {
  auto flags = std::make_shared<Flags>();
  CLI::App* command = AddCommand(cli, "status", "Show what the server holds and does", kExamples,
                                 [flags, &cli] { return Run(*flags, cli.terminal); });
  command->add_flag("--hash", flags->hash, "Also the hash of the whole scene (walks all of it)");
  command->add_flag("--json", flags->json, "Print JSON");
  AddServerFlags(command, &flags->server);
}

}  // namespace clearway::cli
