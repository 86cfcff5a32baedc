#include <algorithm>
#include <array>
#include <iterator>
#include <string>

#include "absl/strings/str_cat.h"
#include "clearway/report/table.h"
#include "cli/evaluation.h"
#include "cli/prediction_text.h"
#include "cli/text.h"

namespace clearway::cli {
namespace {

// Nothing of what is as it should be.
void PrintPoints(std::ostream& out, const PointCounts& points) {
  const auto tell = [&](std::size_t count, const char* what) {
    if (count > 0) out << ", " << Grouped(count) << what;
  };
  out << Grouped(points.used) << " points used";
  tell(points.doubted, " of them doubted");
  tell(points.not_finite, " left out as not finite");
  tell(points.out_of_bounds, " as out of bounds");
  tell(points.ignored, " as to be ignored");
  if (points.frames_without > 0) out << "; frames without any: " << points.frames_without;
  out << ".\n\n";
}

void PrintFits(std::ostream& out, const TrueSource& source, const Evaluation& found) {
  out << "\nHow far from the true surface the occupied voxels of each object are, in metres: "
         "median, and\nwhat 95 % do not exceed; and how much of the surface that rays met has "
         "voxels.\n";
  if (!source.simulation) {
    out << "The surface is that of the recorded box, which an object does not fill (a cyclist less "
           "than a van);\ncovered is the share of the places in the box where a ray met the object "
           "that have voxels.\n";
  }
  out << "\n";
  Table table({"id", "what", "frames", "voxels", "error", "95 %", "covered"});
  for (const auto& [id, fit] : found.fits) {
    table.AddRow({absl::StrCat(id), NameOf(source, id), absl::StrCat(fit.growth.size()),
                  absl::StrCat(fit.errors_m.size()), FixedOrDash(fit.Accuracy_m(), 3),
                  FixedOrDash(fit.Quantile_m(kMost), 3), FixedOrDash(fit.Completeness(), 3)});
  }
  const ObjectFit all = Together(found.fits).together;
  table.AddRow({"", "all", "", absl::StrCat(all.errors_m.size()), FixedOrDash(all.Accuracy_m(), 3),
                FixedOrDash(all.Quantile_m(kMost), 3), FixedOrDash(all.Completeness(), 3)});
  out << table.ToString();
}

void PrintSizes(std::ostream& out, const TrueSource& source, const Evaluation& found) {
  out << "\nHow large the maps of the objects are along the axes of their true boxes, in metres: "
         "map / box.\n\n";
  Table table({"id", "what", "length", "width", "height"});
  for (const auto& [id, size] : found.sizes) {
    std::vector<std::string> row = {absl::StrCat(id), NameOf(source, id)};
    for (int axis = 0; axis < 3; ++axis) {
      row.push_back(absl::StrCat(FixedOrDash(size.mapped_m[axis], 2), " / ",
                                 FixedOrDash(size.true_m[axis], 2)));
    }
    table.AddRow(row);
  }
  out << table.ToString();
}

void PrintGrowth(std::ostream& out, const TrueSource& source, const Evaluation& found) {
  constexpr std::array kAfter_s = {1.0, 2.0, 5.0, 10.0};
  out << "\nHow the objects' maps grow: occupied voxels so many seconds after an object's first "
         "points, and at the\nend; a dash where it was not seen for so long.\n\n";
  std::vector<std::string> header = {"id", "what", "first voxels"};
  for (const double after_s : kAfter_s) header.push_back(absl::StrCat(after_s, " s"));
  header.insert(header.end(), {"end", "seen for"});
  Table table(header);
  for (const auto& [id, growth] : found.growth) {
    const double first_s = growth.front().x(), last_s = growth.back().x();
    std::vector<std::string> row = {absl::StrCat(id), NameOf(source, id),
                                    Fixed(growth.front().y(), 0)};
    for (const double after_s : kAfter_s) {
      // Stamps are a little off the beat: what follows within a microsecond counts.
      const auto later = std::ranges::find_if(
          growth, [&](const Eigen::Vector2d& at) { return at.x() > first_s + after_s + 1e-6; });
      const bool seen = last_s >= first_s + after_s - 1e-6;
      row.push_back(seen ? Fixed(std::prev(later)->y(), 0) : "-");
    }
    row.push_back(Fixed(growth.back().y(), 0));
    row.push_back(Fixed(last_s - first_s, 1) + " s");
    table.AddRow(row);
  }
  out << table.ToString();
}

void PrintResidue(std::ostream& out, const BoxResidue& residue) {
  out << "\nOf " << Grouped(residue.passed) << " voxels that objects filled at some time, "
      << Grouped(residue.occupied) << " are still occupied in the static map.\nAlso "
      << kStaticNotKnown << ".\n";
}

// What was said of places, in percent.
void AddShares(const Confusion::Counts& counts, std::vector<std::string>& row) {
  for (const auto said : {Confusion::kFree, Confusion::kOccupied, Confusion::kUnknown}) {
    row.push_back(FixedOrDash(100 * Confusion::Share(counts, said), 2));
  }
}

void AddShares(const Confusion& confusion, std::vector<std::string>& row) {
  AddShares(confusion.truly_free, row);
  AddShares(confusion.truly_occupied, row);
}

void PrintWays(std::ostream& out, const TrueSource& source, const Evaluation& found) {
  constexpr std::size_t kOfObjects = 2;  // of kWaysAhead
  const std::vector<std::string> shares = {"nothing: free", "occupied", "unknown",
                                           "object: free",  "occupied", "unknown"};
  const auto header = [&](std::vector<std::string> first) {
    first.insert(first.end(), shares.begin(), shares.end());
    return first;
  };
  out << "\nWhat is said of places that objects pass, in percent: where there is truly nothing, "
         "and in the\nmiddle of an object, be it one that nobody has seen yet.\n\n";
  Table whole(header({"ahead"}));
  for (std::size_t i = 0; i < found.ways.size(); ++i) {
    std::vector<std::string> row = {absl::StrCat(ToSeconds(kWaysAhead[i]), " s")};
    AddShares(found.ways[i], row);
    whole.AddRow(row);
  }
  out << whole.ToString() << "\nThe same of the places that each object passes, "
      << ToSeconds(kWaysAhead[kOfObjects]) << " s ahead.\n\n";
  Table by_object(header({"id", "what"}));
  for (const auto& [id, ways] : found.ways_of) {
    std::vector<std::string> row = {absl::StrCat(id), NameOf(source, id)};
    AddShares(ways[kOfObjects], row);
    by_object.AddRow(row);
  }
  out << by_object.ToString();
}

void PrintStatic(std::ostream& out, const StaticFit& fit) {
  out << "\nThe static map, against the true world to within a voxel: of the voxels that it says "
         "are so, how\nmany are (precision); of the observed ones that are so, how many it says "
         "(recall).\n\n";
  Table table({"", "voxels", "precision", "recall"});
  table.AddRow({"occupied", absl::StrCat(fit.occupied), FixedOrDash(fit.OccupiedPrecision(), 4),
                FixedOrDash(fit.OccupiedRecall(), 4)});
  table.AddRow({"free", absl::StrCat(fit.free), FixedOrDash(fit.FreePrecision(), 4),
                FixedOrDash(fit.FreeRecall(), 4)});
  out << table.ToString() << "\n"
      << fit.Residual() << " occupied voxels are where nothing static is.\n\n"
      << "What it says, in percent: right there, of a grid over its blocks where there is truly "
         "nothing; and\nwhere rays met a surface.\n\n";
  Table grid({"truly", "free", "occupied", "unknown"});
  const auto add = [&](const std::string& truly, const Confusion::Counts& counts) {
    std::vector<std::string> row = {truly};
    AddShares(counts, row);
    grid.AddRow(row);
  };
  add("nothing", fit.grid.truly_free);
  add("surface", fit.grid.truly_occupied);
  out << grid.ToString();
}

void PrintIdentities(std::ostream& out, const Identities& found) {
  out << "\nTimes that an object came back under a new id (" << IdentityScore::kFewestFrames
      << " frames or more before and after): " << found.came_back
      << ", of which known again: " << found.known_again
      << ".\nIds taken for another object's: " << found.wrong << ".\n";
}

void PrintUnlabelled(std::ostream& out, const Unlabelled& found) {
  const auto per_frame = [&](std::int64_t count) {
    return FixedOrDash(static_cast<double>(count) / static_cast<double>(found.frames), 1);
  };
  out << "\nOf movers that were not labelled, " << FixedOrDash(found.ShareOccupied(), 3)
      << " of the points lay in voxels that were occupied at once.\nVoxels that they had left but "
         "that stayed occupied: "
      << per_frame(found.trail) << " on average over the frames, at most " << found.most_trail
      << ",\nin the end " << found.last_trail << ".\n";
  if (found.dynamic == 0) return;
  out << "Voxels of dynamic space: " << per_frame(found.dynamic)
      << " on average. Of these they had "
      << "left " << per_frame(found.dynamic_left) << ", and in\n"
      << per_frame(found.dynamic_elsewhere) << " none of them ever was.\n";
}

}  // namespace

void PrintText(std::ostream& out, const TrueSource& source, const Evaluation& found) {
  out << source.frames.description << ", against " << source.truth.description << "\n";
  PrintPoints(out, found.points);
  for (const std::string& line : found.notes.Lines()) out << line << "\n";
  PrintPredictions(out, source, found);
  if (!found.sizes.empty()) PrintSizes(out, source, found);
  if (!found.fits.empty()) PrintFits(out, source, found);
  if (found.growth.empty()) {
    out << "\nNo object had points: nothing can be said of any.\n";
  } else if (found.predictions.empty()) {
    out << "\nNo object with points is one of which there is truth: labels and truth have no id in "
           "common.\n";
  }
  if (source.sizes_m.empty() && !source.simulation) {
    out << "\nSizes, accuracy, completeness, solids, residue and what is said of the places that "
           "objects pass are not\nknown: the source tells poses of objects but no boxes.\n";
  }
  if (!found.solids.empty()) PrintSolids(out, source, found);
  if (!found.growth.empty()) PrintGrowth(out, source, found);
  if (!found.ways.empty()) PrintWays(out, source, found);
  if (found.identities) PrintIdentities(out, *found.identities);
  if (found.unlabelled) PrintUnlabelled(out, *found.unlabelled);
  if (found.static_fit) PrintStatic(out, *found.static_fit);
  if (found.residue) PrintResidue(out, *found.residue);
}

}  // namespace clearway::cli
