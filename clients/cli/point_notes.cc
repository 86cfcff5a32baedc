#include "cli/point_notes.h"

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "cli/text.h"

namespace clearway::cli {

void PointNotes::Add(const FrameReport& report) {
  used_ += report.points_used;
  ignored_ += report.points_ignored;
  not_finite_ += report.points_not_finite;
  self_ += report.points_self;
  out_of_bounds_ += report.points_out_of_bounds;
  given_ += report.points_given;
}

std::vector<std::string> PointNotes::Lines() const {
  std::vector<std::string> reasons;
  const auto add = [&](std::size_t count, const char* reason) {
    if (count > 0) reasons.push_back(absl::StrCat(Grouped(count), " ", reason));
  };
  add(ignored_, "labelled -1");
  add(not_finite_, "not finite");
  add(self_, "on the robot's own body (self filter)");
  add(out_of_bounds_, "out of the scene's bounds");
  std::vector<std::string> lines;
  const std::size_t left_out = ignored_ + not_finite_ + self_ + out_of_bounds_;
  if (left_out > 0) {
    lines.push_back(
        absl::StrCat("left out ", Plural(left_out, "point"), ": ", absl::StrJoin(reasons, ", ")));
  }
  if (left_out > 0 && used_ == 0) lines.push_back("warning: no point was used");
  if (given_ > 0) {
    lines.push_back(absl::StrCat(Plural(given_, "point"),
                                 " of given objects cleared space, but added nothing to them"));
  }
  return lines;
}

Json PointNotes::AsJson() const {
  return {{"used", used_},
          {"ignored", ignored_},
          {"not_finite", not_finite_},
          {"self", self_},
          {"out_of_bounds", out_of_bounds_},
          {"given", given_}};
}

}  // namespace clearway::cli
