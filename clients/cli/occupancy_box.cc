#include "clearway/report/table.h"
#include "cli/json.h"
#include "cli/occupancy_answers.h"
#include "cli/text.h"

namespace clearway::cli {
namespace {

Json AsJson(const BoxOccupancy& box, std::span<const Time> times) {
  Json json = ToJson(static_cast<const Versioned&>(box));
  json["cell_m"] = box.cell_m;
  json["origin_m"] = ToJson(box.origin_W);
  json["cell_counts"] = box.cell_counts;
  json["times"] = Json::array();
  for (std::size_t i = 0; i < box.counts.size() && i < times.size(); ++i) {
    const BoxOccupancy::Counts& counts = box.counts[i];
    json["times"].push_back({{"time_ns", ToNanoseconds(times[i])},
                             {"free", counts.free},
                             {"unknown_space", counts.unknown_space},
                             {"beyond_horizon", counts.beyond_horizon},
                             {"occupied", counts.occupied},
                             {"out_of_bounds", counts.out_of_bounds}});
  }
  return json;
}

}  // namespace

absl::Status AnswerBox(const OccupancyFlags& flags, const SceneClient& client,
                       std::span<const Time> times, const Terminal& terminal) {
  const auto box = client.OccupancyOfBox(*flags.box, times, false);
  if (!box.ok()) return box.status();
  if (flags.json) {
    Print(terminal.out, AsJson(*box, times));
    return absl::OkStatus();
  }
  terminal.out << "scene version " << box->version << ", newest stamp " << Seconds(box->stamp)
               << "; " << box->cell_counts[0] << " x " << box->cell_counts[1] << " x "
               << box->cell_counts[2] << " cells of " << Fixed(box->cell_m, 2) << " m\n";
  Table table({"time", "free", "unknown", "beyond horizon", "occupied", "out of bounds"});
  for (std::size_t i = 0; i < box->counts.size() && i < times.size(); ++i) {
    const BoxOccupancy::Counts& counts = box->counts[i];
    table.AddRow({Seconds(times[i]), Grouped(counts.free), Grouped(counts.unknown_space),
                  Grouped(counts.beyond_horizon), Grouped(counts.occupied),
                  Grouped(counts.out_of_bounds)});
  }
  terminal.out << table.ToString();
  return absl::OkStatus();
}

}  // namespace clearway::cli
