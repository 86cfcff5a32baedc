#include "cli/evaluation_html.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "absl/status/statusor.h"
#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "clearway/base/file.h"
#include "clearway/report/object_sheet.h"
#include "clearway/report/top_view.h"
#include "cli/left_out_text.h"
#include "cli/svg_plot.h"

namespace clearway::cli {
namespace {

constexpr std::string_view kBegin =
    "<!doctype html>\n<html lang='en'><meta charset='utf-8'>\n<title>Clearway: ";

std::string LabelOf(const TrueSource& source, ObjectId id) {
  return absl::StrCat(id, " ", NameOf(source, id));
}

// A value of each kAhead, where there is one.
PlotLine LineByAhead(const std::string& name, const std::vector<PredictionErrors>& errors,
                     const std::function<double(const PredictionErrors&)>& value) {
  PlotLine line{name, {}};
  for (const PredictionErrors& e : errors) {
    if (!std::isnan(value(e))) line.points.emplace_back(ToSeconds(e.ahead), value(e));
  }
  return line;
}

Plot PlotOfPredictions(const TrueSource& source, const Evaluation& found) {
  Plot plot{
      "How far objects are from where they were predicted", "seconds ahead", "median, m", {}, 0.1};
  for (const auto& [id, errors] : found.predictions) {
    plot.lines.push_back(LineByAhead(LabelOf(source, id), errors, &PredictionErrors::Median));
  }
  return plot;
}

Plot PlotOfBounds(const Evaluation& found) {
  const std::vector<PredictionErrors> all = Together(found.predictions);
  Plot plot{"How often they were no farther than was said (0.95 is meant)",
            "seconds ahead",
            "share",
            {},
            1};
  plot.lines.push_back(LineByAhead("all objects", all, &PredictionErrors::Within));
  plot.lines.push_back(LineByAhead("meant", all, [](const PredictionErrors&) { return kMost; }));
  return plot;
}

Plot PlotOfGrowth(const TrueSource& source, const Evaluation& found) {
  Plot plot{
      "How the objects' maps grow", "seconds since the first frame", "occupied voxels", {}, 1};
  for (const auto& [id, points] : found.growth) {
    plot.lines.push_back({LabelOf(source, id), points});
  }
  return plot;
}

// An <img> of what `write` makes in a file that nobody else uses. Titles are plain words.
absl::StatusOr<std::string> ImageOf(const std::string& title, const std::string& scratch_file,
                                    const std::function<absl::Status(const std::string&)>& write) {
  if (absl::Status status = write(scratch_file); !status.ok()) return status;
  constexpr std::uint64_t kMaxBytes = 100'000'000;
  const absl::StatusOr<std::string> bytes = ReadWholeFile(scratch_file, kMaxBytes);
  if (!bytes.ok()) return bytes.status();
  return absl::StrCat("<img alt='", title, "' style='max-width: 100%' src='data:image/png;base64,",
                      absl::Base64Escape(*bytes), "'>\n");
}

// What it is called in the scene: one that is out of sight is where it is thought to be.
std::string NameNow(const TrueSource& source, const SceneSnapshot& scene,
                    const MovingObject& object) {
  constexpr Duration kSeen = std::chrono::seconds(1);
  const Duration unseen = scene.stamp - object.last_seen;
  if (unseen <= kSeen) return LabelOf(source, object.id);
  return absl::StrFormat("%s, unseen for %.1f s", LabelOf(source, object.id), ToSeconds(unseen));
}

absl::StatusOr<std::string> PicturesOf(const std::string& scratch_file, const TrueSource& source,
                                       const Evaluation& found) {
  SceneSnapshot with_all_objects = *found.scene;
  with_all_objects.objects.clear();
  ObjectSheetOptions sheet;
  sheet.title = "The objects as they were last seen";
  for (const auto& [id, object] : found.newest) {
    with_all_objects.objects.push_back(object);
    sheet.names[id] = LabelOf(source, id);
  }
  const auto objects = ImageOf(sheet.title, scratch_file, [&](const std::string& file) {
    return WriteObjectSheet(with_all_objects, sheet, file);
  });
  if (!objects.ok()) return objects.status();
  TopViewOptions view;
  view.title = "The scene after the last frame";
  for (const auto& object : found.scene->objects) {
    view.names[object->id] = NameNow(source, *found.scene, *object);
  }
  const auto scene = ImageOf(view.title, scratch_file, [&](const std::string& file) {
    return WriteTopView(*found.scene, view, file);
  });
  if (!scene.ok()) return scene.status();
  return absl::StrCat(*objects, *scene);
}

// The file is scratch for the pictures before.
absl::Status WritePage(const std::string& file, const TrueSource& source, const Evaluation& found) {
  const auto pictures = PicturesOf(file, source, found);
  if (!pictures.ok()) return pictures.status();
  std::ostringstream tables;
  tables << LeftOutText(*source.frames.left_out);
  PrintText(tables, source, found);
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out << kBegin << Escaped(source.frames.description)
      << "</title>\n<body style='font-family: sans-serif; max-width: 1200px; margin: auto'>\n"
      << "<h1>Maps and predictions against the truth</h1>\n<p>Clearway " CLEARWAY_VERSION ": <code>"
      << Escaped(found.command) << "</code></p>\n"
      << SvgOf(PlotOfPredictions(source, found)) << SvgOf(PlotOfBounds(found))
      << SvgOf(PlotOfGrowth(source, found)) << "<pre>" << Escaped(tables.str()) << "</pre>\n"
      << *pictures << "</body></html>\n";
  out.close();
  if (out) return absl::OkStatus();
  return absl::InternalError(absl::StrCat(file, ": cannot be written"));
}

}  // namespace

absl::Status CheckPage(const std::string& html_file) {
  std::error_code ignored;
  const auto refused = [&](const char* why) {
    return absl::FailedPreconditionError(absl::StrCat("--html: ", html_file, why));
  };
  const std::filesystem::path path = html_file, folder = path.parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder, ignored)) {
    return refused(": there is no such folder");
  }
  const auto file = OutputFile(path);
  if (!file.ok()) {
    return absl::FailedPreconditionError(absl::StrCat("--html: ", file.status().message()));
  }
  if (!std::filesystem::exists(*file, ignored)) return absl::OkStatus();
  const absl::StatusOr<std::string> begin = ReadFileStart(path, kBegin.size());
  if (begin.ok() && *begin == kBegin) return absl::OkStatus();
  return refused(" exists and is no page; name another file");
}

absl::Status WriteHtml(const std::string& html_file, const TrueSource& source,
                       const Evaluation& found) {
  const auto file = OutputFile(html_file);
  if (!file.ok()) return file.status();
  const std::string partial = file->string() + ".partial";
  const absl::Status written = WritePage(partial, source, found);
  if (written.ok()) return MoveInto(partial, *file);
  std::error_code ignored;
  std::filesystem::remove(partial, ignored);
  return written;
}

}  // namespace clearway::cli
