// clearway objects: the moving objects of the newest scene; given ones come and go with it too.
#include <memory>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "clearway/client/scene_client.h"
#include "clearway/report/table.h"
#include "cli/commands.h"
#include "cli/json.h"
#include "cli/mesh_notes.h"
#include "cli/scenario_file.h"
#include "cli/server_flags.h"
#include "cli/text.h"
#include "cli/values.h"

namespace clearway::cli {
namespace {

constexpr char kExamples[] =
    "  clearway objects\n"
    "  clearway objects --time +1.5          where they will be 1.5 s after the newest frame\n"
    "  clearway objects --add doors.json     objects of known shape, as in a scenario's "
    "\"objects\"\n"
    "  clearway objects --remove 7,8         such objects\n"
    "  clearway objects --json | jq '.objects[] | {id, speed_mps}'";

struct Flags {
  ServerFlags server;
  std::optional<TimeArgument> time;
  std::string add;
  std::vector<ObjectId> remove;
  bool json = false;
};

struct ObjectRow {
  ObjectInfo info;
  std::optional<PredictedPose> then = {};  // at the time asked for
};
using ObjectRows = std::vector<ObjectRow>;  // an object's parts follow it

ObjectRows RowsOf(const ObjectList& list) {
  ObjectRows rows;
  for (const ObjectInfo& object : list.objects) {
    rows.push_back({object});
    for (const ObjectInfo& part : object.parts) rows.push_back({part});
  }
  return rows;
}

// Objects that a newer scene has or lacks are matched by id.
absl::Status AddPredictions(const SceneClient& client, Time time, ObjectRows& rows) {
  const auto predicted = client.PredictPoses({}, {&time, 1});
  if (!predicted.ok()) return predicted.status();
  for (std::size_t i = 0; i < predicted->objects.size() && i < predicted->poses.size(); ++i) {
    for (ObjectRow& row : rows) {
      if (row.info.id == predicted->objects[i]) row.then = predicted->poses[i];
    }
  }
  return absl::OkStatus();
}

const char* NameOf(PoseSource source) {
  switch (source) {
    case PoseSource::kReported:
      return "REPORTED";
    case PoseSource::kEstimated:
      return "ESTIMATED";
    case PoseSource::kBridged:
      return "BRIDGED";
    case PoseSource::kFirstSight:
      break;
  }
  return "FIRST_SIGHT";
}

Json AsJson(const ObjectRow& row) {
  const ObjectInfo& o = row.info;
  Json json = {{"id", o.id},
               {"other_ids", o.also},
               {"parts", Json::array()},
               {"frames_seen", o.frames_seen},
               {"occupied_voxels", o.occupied_voxels},
               {"observed_voxels", o.observed_voxels},
               {"speed_mps", o.speed_mps},
               {"at_rest", o.at_rest},
               {"bridged", o.bridged},
               {"pose_source", NameOf(o.pose_source)},
               {"given", o.given},
               {"future_end_ns", nullptr},
               {"world_from_object", ToJson(o.T_W_O)},
               {"pose_stamp_ns", ToNanoseconds(o.t_k)},
               {"velocity_object", nullptr},
               {"bound", nullptr},
               {"size_m", ToJson(o.extent.size_m)},
               {"box_object", ToJson(o.box_O)},
               {"box_world", ToJson(o.box_W)},
               {"first_seen_ns", ToNanoseconds(o.first_seen)},
               {"last_seen_ns", ToNanoseconds(o.last_seen)}};
  if (o.velocity_O) {
    json["velocity_object"] = {{"angular_radps", ToJson(o.velocity_O->angular)},
                               {"linear_mps", ToJson(o.velocity_O->linear)}};
  }
  if (o.bound) {
    json["bound"] = {{"at_m", o.bound->at_m},
                     {"speed_mps", o.bound->speed_mps},
                     {"accel_mps2", o.bound->accel_mps2}};
  }
  if (o.future_end) json["future_end_ns"] = ToNanoseconds(*o.future_end);
  if (row.then) {
    json["predicted"] = {{"world_from_object", ToJson(row.then->T_W_O)},
                         {"beyond_horizon", row.then->beyond_horizon_radius_m.has_value()}};
  }
  return json;
}

// The id that it goes by, then those under which it was known again.
std::string IdsOf(const ObjectInfo& o) {
  if (!o.also.empty()) return absl::StrCat(o.id, ", ", absl::StrJoin(o.also, ", "));
  return o.part_of == kStaticLabel ? absl::StrCat(o.id) : absl::StrCat(o.id, " of ", o.part_of);
}

// "moving", and what else a planner's author wants to know of the motion.
std::string MotionOf(const ObjectInfo& o) {
  if (o.future_end) return "stated";
  if (o.bridged) return "bridged";
  if (!o.velocity_O) return "unknown";
  if (o.pose_source == PoseSource::kEstimated) return o.at_rest ? "at rest (est.)" : "estimated";
  return o.at_rest ? "at rest" : "moving";
}

void PrintText(std::ostream& out, const ObjectList& list, const ObjectRows& rows,
               std::optional<Time> time) {
  out << "scene version " << list.version << ", newest stamp " << Seconds(list.stamp) << ", "
      << Plural(list.objects.size(), "object") << "\n";
  if (rows.empty()) return;
  std::vector<std::string> header = {"id",        "frames", "voxels",   "size",
                                     "speed m/s", "motion", "position", "last seen"};
  if (time) header.push_back("at " + Seconds(*time));
  Table table(header);
  for (const ObjectRow& row : rows) {
    const ObjectInfo& o = row.info;
    std::vector<std::string> cells = {IdsOf(o),
                                      absl::StrCat(o.frames_seen),
                                      Grouped(o.occupied_voxels),
                                      Size(o.extent.size_m),
                                      Fixed(o.speed_mps, 2),
                                      MotionOf(o),
                                      Point(o.T_W_O.translation),
                                      o.given ? "given"
                                      : o.last_seen == list.stamp
                                          ? "now"
                                          : Seconds(list.stamp - o.last_seen) + " ago"};
    if (row.then) {
      cells.push_back(Point(row.then->T_W_O.translation) +
                      (row.then->beyond_horizon_radius_m ? " beyond horizon" : ""));
    }
    table.AddRow(std::move(cells));
  }
  out << table.ToString();
}

// Whatever of it fails, what came before is done.
absl::Status Change(const SceneClient& client, const Flags& flags, std::ostream& err) {
  if (!flags.remove.empty()) {
    if (auto removed = client.RemoveObjects(flags.remove); !removed.ok()) return removed.status();
  }
  if (flags.add.empty()) return absl::OkStatus();
  auto objects = LoadObjects(flags.add);
  if (!objects.ok()) return objects.status();
  PrintObjectNotes(*objects, err);
  const auto status = client.GetStatus();
  if (!status.ok()) return status.status();
  Delay(status->stamp - Time(), *objects);
  return client.AddObjects(*objects).status();
}

absl::Status Run(const Flags& flags, const Terminal& terminal) {
  const auto connection = Connect(flags.server);
  if (!connection.ok()) return connection.status();
  const SceneClient client(*connection);
  if (auto status = Change(client, flags, terminal.err); !status.ok()) return status;
  const auto list = client.ListObjects();
  if (!list.ok()) return list.status();
  ObjectRows rows = RowsOf(*list);
  std::optional<Time> time;
  if (flags.time) {
    time = flags.time->At(list->stamp);
    if (const absl::Status status = AddPredictions(client, *time, rows); !status.ok())
      return status;
  }
  if (!flags.json) {
    PrintText(terminal.out, *list, rows, time);
    return absl::OkStatus();
  }
  Json json = ToJson(static_cast<const Versioned&>(*list));
  if (time) json["time_ns"] = ToNanoseconds(*time);
  json["objects"] = Json::array();
  for (const ObjectRow& row : rows) {
    const bool is_part =
        !json["objects"].empty() && json["objects"].back()["id"] == row.info.part_of;
    (is_part ? json["objects"].back()["parts"] : json["objects"]).push_back(AsJson(row));
  }
  Print(terminal.out, json);
  return absl::OkStatus();
}

}  // namespace

void AddObjects(Cli& cli) {
  auto flags = std::make_shared<Flags>();
  CLI::App* command = AddCommand(cli, "objects", "List the moving objects", kExamples,
                                 [flags, &cli] { return Run(*flags, cli.terminal); });
  AddParsed(command, "--time", &flags->time, ParseTime,
            "Also where they are then: +seconds after the\nnewest stamp, or seconds of sensor time")
      ->type_name("TIME");
  command->add_flag("--json", flags->json, "Print JSON");
  command->add_option("--add", flags->add, "First add the given objects of this JSON file");
  command->add_option("--remove", flags->remove, "First remove these given objects")
      ->delimiter(',')
      ->type_name("ID");
  AddServerFlags(command, &flags->server);
}

}  // namespace clearway::cli
