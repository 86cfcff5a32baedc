#include "cli/truth_source.h"

#include <filesystem>
#include <memory>
#include <utility>

#include "absl/strings/str_cat.h"

namespace clearway::cli {
namespace {

TrueSource OfSimulation(const Simulation& simulation) {
  const auto world = std::make_shared<const World>(simulation.world());
  TrueSource source{simulation.Frames(), {}, {}, {}, simulation};
  source.truth = TruthOf(world, simulation.StampOf(simulation.frame_count() - 1));
  for (const ObjectId id : world->ObjectIds()) source.names[id] = world->FindObject(id)->name;
  return source;
}

TrueSource OfFolder(LidarFolder folder) {
  TrueSource source{folder.frames, TruthOf(folder), {}, {}, std::nullopt};
  for (const RecordedBox& box : folder.boxes) {
    source.names[box.id] = box.type;
    if (!box.size_m.isZero()) source.sizes_m[box.id] = box.size_m;
  }
  if (source.sizes_m.empty()) {
    source.truth.description = "the poses of objects that the source gives (sizes are not told)";
  }
  return source;
}

// Reads every frame once: what comes later is the truth of what is predicted before. Skips frames
// that cannot be read: the evaluation stops at them or leaves them out.
absl::StatusOr<TrueSource> OfRecording(const std::string& spec, const SourceFlags& flags) {
  auto frames = OpenSource(spec, flags);
  if (!frames.ok()) return frames.status();
  LidarFolder told;
  told.frames = *std::move(frames);
  SourceContent content;
  absl::Status unread;  // the first
  for (std::size_t k = 0; k < told.frames.frame_count; ++k) {
    const auto frame = told.frames.read(k);
    if (!frame.ok()) {
      unread.Update(frame.status());
      continue;
    }
    content.has_parts |= !frame->parts.empty();
    content.objects.insert(frame->labels.begin(), frame->labels.end());
    const int number = static_cast<int>(k);
    told.poses.push_back({number, frame->stamp, frame->T_W_S});
    for (const ObjectPose& pose : frame->poses) {
      told.boxes.push_back({number, pose.id, "", Eigen::Vector3d::Zero(), pose.T_W_B, -1});
    }
  }
  if (told.poses.empty() && !unread.ok()) return unread;
  content.objects.erase(content.objects.begin(), content.objects.upper_bound(kStaticLabel));
  if (auto status = CheckSourceContent(flags, spec, content); !status.ok()) return status;
  if (told.boxes.empty()) {
    return absl::InvalidArgumentError(absl::StrCat(
        spec,
        ": no frame gives the pose of an object, so nothing tells where objects really were; "
        "record the source with --objects poses, or evaluate sim:NAME or the folder itself"));
  }
  TrueSource source = OfFolder(std::move(told));
  source.truth.description = "the poses of objects that the recording gives (its source's own)";
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
  if (KindOf(spec) == SourceKind::kRecording) return OfRecording(spec, flags);
  return absl::InvalidArgumentError(absl::StrCat(spec, ": a map does not tell what happened"));
}

}  // namespace clearway::cli
