#include "cli/id_notes.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"

namespace clearway::cli {
namespace {

// "1, 2, 3 and 40 more".
std::string Some(const std::set<ObjectId>& ids) {
  constexpr std::size_t kMost = 5;
  const std::size_t shown = std::min(ids.size(), kMost);
  const std::string some =
      absl::StrJoin(ids.begin(), std::next(ids.begin(), static_cast<std::ptrdiff_t>(shown)), ", ");
  return shown == ids.size() ? some : absl::StrCat(some, " and ", ids.size() - shown, " more");
}

}  // namespace

void IdNotes::Add(const Frame& frame) {
  for (const ObjectMotion& motion : frame.motions) placed_.insert(motion.id);
  for (const ObjectPose& pose : frame.poses) placed_.insert(pose.id);
  ObjectId last = kStaticLabel;
  for (const ObjectId label : frame.labels) {
    if (label > 0 && label != last) labels_.insert(label);
    last = label;
  }
}

std::string IdNotes::Line() const {
  if (placed_.empty() || WithoutPoints().size() < placed_.size()) return "";
  return absl::StrCat(
      "warning: motions and poses are of objects without points (ids ", Some(placed_), "), ",
      labels_.empty() ? "and no point has an object's label"
                      : absl::StrCat("points of others (labels ", Some(labels_), ")"),
      ": none was used");
}

Json IdNotes::WithoutPoints() const {
  std::vector<ObjectId> without;
  std::ranges::set_difference(placed_, labels_, std::back_inserter(without));
  return without;
}

}  // namespace clearway::cli
