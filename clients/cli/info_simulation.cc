#include "absl/strings/str_cat.h"
#include "clearway/report/table.h"
#include "cli/file_info.h"
#include "cli/text.h"

namespace clearway::cli {
namespace {

// Length of the path that an object's box drives during the frames.
double PathOf(const Simulation& simulation, ObjectId id) {
  double length_m = 0;
  for (std::size_t k = 1; k < simulation.frame_count(); ++k) {
    const auto before = simulation.world().T_W_B(id, simulation.StampOf(k - 1));
    const auto now = simulation.world().T_W_B(id, simulation.StampOf(k));
    if (before && now) length_m += (now->translation - before->translation).norm();
  }
  return length_m;
}

double SensorPath(const Simulation& simulation) {
  double length_m = 0;
  for (std::size_t k = 1; k < simulation.frame_count(); ++k) {
    length_m +=
        (simulation.TrueT_W_S(k).translation - simulation.TrueT_W_S(k - 1).translation).norm();
  }
  return length_m;
}

}  // namespace

absl::StatusOr<FileInfo> InfoOfSimulation(const std::string& spec, const SourceFlags& flags) {
  const auto simulation = OpenSimulation(spec, flags);
  if (!simulation.ok()) return simulation.status();
  const SimulationSpec& world = simulation->spec();
  const std::size_t frames = simulation->frame_count();
  const double duration_s =
      frames == 0 ? 0 : ToSeconds(world.period) * static_cast<double>(frames - 1);

  FileInfo info;
  info.text = absl::StrCat("simulation  ", world.name, "\n", "frames      ", Grouped(frames),
                           " over ", Fixed(duration_s, 1), " s\n", "sensor      moves ",
                           Fixed(SensorPath(*simulation), 1), " m\n", "voxel size  ",
                           Fixed(world.resolution_m, 3), " m suits it\n");
  info.json = {{"kind", "simulation"},
               {"name", world.name},
               {"frames", frames},
               {"duration_s", duration_s},
               {"resolution_m", world.resolution_m},
               {"objects", Json::array()}};
  Table table({"id", "name", "size", "path m"});
  for (const ObjectId id : simulation->world().ObjectIds()) {
    const Body& body = *simulation->world().FindObject(id);
    const double path_m = PathOf(*simulation, id);
    table.AddRow({absl::StrCat(id), body.name, Size(body.BoxB().Size()), Fixed(path_m, 1)});
    info.json["objects"].push_back({{"id", id},
                                    {"name", body.name},
                                    {"size_m", ToJson(body.BoxB().Size())},
                                    {"path_m", path_m}});
  }
  absl::StrAppend(&info.text, "objects     ", info.json["objects"].size(), "\n", table.ToString());
  return info;
}

}  // namespace clearway::cli
