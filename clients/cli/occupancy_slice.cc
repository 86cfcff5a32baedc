#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "cli/json.h"
#include "cli/occupancy_answers.h"
#include "cli/slice_picture.h"
#include "cli/text.h"

namespace clearway::cli {
namespace {

constexpr double kDefaultReach_m = 50;
constexpr int kLabelColumns = 11;  // "    12.3 | "

absl::StatusOr<Aabb> AreaOf(const OccupancyFlags& flags, const ServerStatus& scene) {
  if (flags.area) return *flags.area;
  if (scene.static_box_W.Empty()) {
    return absl::FailedPreconditionError(
        "the scene is empty: send frames with 'clearway replay', or give --area");
  }
  Aabb area = scene.static_box_W;
  const Eigen::Vector3d middle = area.Center();
  area.min = area.min.cwiseMax((middle.array() - kDefaultReach_m).matrix());
  area.max = area.max.cwiseMin((middle.array() + kDefaultReach_m).matrix());
  return area;
}

// A voxel, or as many as keep the question within the server's limit.
double CellOf(const OccupancyFlags& flags, const Connection& connection, const Aabb& area,
              std::size_t times) {
  if (flags.cell_m) return *flags.cell_m;
  const double voxel_m = connection.server().params.resolution_m;
  const Eigen::Vector3d size = area.Size();
  const auto limit = static_cast<double>(connection.server().limits.max_points_per_query);
  double voxels = 1;
  while (std::ceil(size.x() / (voxels * voxel_m)) * std::ceil(size.y() / (voxels * voxel_m)) *
             static_cast<double>(times) >
         limit) {
    ++voxels;
  }
  return voxels * voxel_m;
}

Json AsJson(const SliceOccupancy& slice, const SliceQuestion& question,
            std::span<const Time> times) {
  Json json = ToJson(static_cast<const Versioned&>(slice));
  json.update(Json{{"z_m", question.z_m},
                   {"min_m", Json::array({question.min_W.x(), question.min_W.y()})},
                   {"cell_m", slice.cell_m},
                   {"columns", slice.columns},
                   {"rows", slice.rows},
                   {"legend", kSliceLegend},
                   {"times", Json::array()}});
  for (std::size_t i = 0; i < times.size(); ++i) {
    json["times"].push_back(
        {{"time_ns", ToNanoseconds(times[i])}, {"rows_from_lowest_y", CellRows(slice, i)}});
  }
  return json;
}

void PrintText(const SliceOccupancy& slice, const SliceQuestion& question,
               std::span<const Time> times, const Terminal& terminal) {
  const int width = std::max(20, terminal.columns - kLabelColumns);
  const int fold = std::max(1, (static_cast<int>(slice.columns) + width - 1) / width);
  terminal.out << "z " << Fixed(question.z_m, 2) << " m, x " << Fixed(question.min_W.x(), 1)
               << " to " << Fixed(question.max_W.x(), 1) << " m, y " << Fixed(question.min_W.y(), 1)
               << " to " << Fixed(question.max_W.y(), 1) << " m (y at the left); a character is "
               << Fixed(fold * slice.cell_m, 2) << " x " << Fixed(2 * fold * slice.cell_m, 2)
               << " m\n"
               << kSliceLegend << "\n";
  for (std::size_t i = 0; i < times.size(); ++i) {
    terminal.out << "\nat " << Seconds(times[i]) << " (scene version " << slice.version
                 << ", newest stamp " << Seconds(slice.stamp) << ")\n"
                 << PictureOf(FoldedLines(CellRows(slice, i), fold, 2 * fold), question.min_W.y(),
                              2 * fold * slice.cell_m);
  }
}

}  // namespace

absl::Status AnswerSlice(const OccupancyFlags& flags, const SceneClient& client,
                         const ServerStatus& scene, std::span<const Time> times,
                         const Connection& connection, const Terminal& terminal) {
  const auto area = AreaOf(flags, scene);
  if (!area.ok()) return area.status();
  SliceQuestion question;
  question.z_m = *flags.slice_z_m;
  question.min_W = area->min.head<2>();
  question.max_W = area->max.head<2>();
  question.cell_m = CellOf(flags, connection, *area, times.size());
  const auto slice = client.OccupancyOfSlice(question, times);
  if (!slice.ok()) return slice.status();
  if (flags.json) {
    Print(terminal.out, AsJson(*slice, question, times));
  } else {
    PrintText(*slice, question, times, terminal);
  }
  return absl::OkStatus();
}

}  // namespace clearway::cli
