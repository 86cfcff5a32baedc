#include "cli/truth_source.h"

#include <filesystem>
#include <memory>
#include <utility>

#include "absl/strings/str_cat.h"

namespace clearway::cli {
namespace {

TrueSource OfSimulation(const Simulation& simulation) {
  const auto world = std::make_shared<const World>(simulation.world());
  TrueSource source{simulation.Frames(), {}, {}, simulation};
  source.truth = TruthOf(world, simulation.StampOf(simulation.frame_count() - 1));
  for (const ObjectId id : world->ObjectIds()) source.names[id] = world->FindObject(id)->name;
  return source;
}

TrueSource OfFolder(LidarFolder folder) {
  TrueSource source{folder.frames, TruthOf(folder), {}, std::nullopt};
  for (const RecordedBox& box : folder.boxes) source.names[box.id] = box.type;
  return source;
}

}  // namespace

absl::StatusOr<TrueSource> OpenTrueSource(const std::string& spec, const SourceFlags& flags) {
  if (KindOf(spec) == SourceKind::kSimulation) {
    const auto simulation = OpenSimulation(spec, flags);
    if (!simulation.ok()) return simulation.status();
    return OfSimulation(*simulation);
  }
  if (KindOf(spec) == SourceKind::kLidarFolder) {
    auto folder = OpenFolder(spec, flags, flags.allow_missing_points);
    if (!folder.ok()) return folder.status();
    if (folder->boxes.empty()) {
      return absl::InvalidArgumentError(absl::StrCat(
          spec,
          ": no boxes or poses of objects are recorded: nothing tells where they really were"));
    }
    return OfFolder(*std::move(folder));
  }
  if (!std::filesystem::exists(spec)) return absl::NotFoundError(spec + ": no such file");
  return absl::InvalidArgumentError(absl::StrCat(
      spec,
      ": does not tell what really happened; sim:NAME and folders of scans with boxes or poses of "
      "objects do"));
}

}  // namespace clearway::cli
