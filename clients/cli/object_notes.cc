#include "cli/object_notes.h"

#include "absl/strings/str_cat.h"
#include "cli/text.h"

namespace clearway::cli {
namespace {

constexpr std::size_t kMaxObjects = 1'000;  // that are told apart

const char* NameOf(ObjectIssueKind kind) {
  switch (kind) {
    case ObjectIssueKind::kTurnTooLarge:
      return "TURN_TOO_LARGE";
    case ObjectIssueKind::kMotionTooFar:
      return "MOTION_TOO_FAR";
    case ObjectIssueKind::kMotionConflict:
      return "MOTION_CONFLICT";
    case ObjectIssueKind::kMotionTooFast:
      return "MOTION_TOO_FAST";
    case ObjectIssueKind::kContradicted:
      return "CONTRADICTED";
    case ObjectIssueKind::kJumped:
      return "JUMPED";
    case ObjectIssueKind::kStartsTooEarly:
      return "STARTS_TOO_EARLY";
    case ObjectIssueKind::kRestarted:
      return "RESTARTED";
    case ObjectIssueKind::kBridgedTooLong:
      return "BRIDGED_TOO_LONG";
  }
  return "UNSPECIFIED";
}

// What happened at `when`, and why.
std::string Describe(const ObjectIssue& issue, const std::string& when) {
  std::string value, limit;
  for (int digits = 2; value == limit && digits <= 8; digits += 2) {
    value = Fixed(issue.value, digits);
    limit = Fixed(issue.limit, digits);
  }
  switch (issue.kind) {
    case ObjectIssueKind::kTurnTooLarge:
      return absl::StrCat("motion or pose left out at ", when, ": turns by ", value, " rad (limit ",
                          limit, " rad)");
    case ObjectIssueKind::kMotionTooFar:
      return absl::StrCat("motion or pose left out at ", when, ": leads to a coordinate of ", value,
                          " m (limit ", limit, " m)");
    case ObjectIssueKind::kMotionConflict:
      return absl::StrCat("motion left out at ", when,
                          ": the object has another one under another id");
    case ObjectIssueKind::kMotionTooFast:
      return absl::StrCat("motion or pose left out at ", when, ": moves at ", value, " m/s (limit ",
                          limit, " m/s)");
    case ObjectIssueKind::kContradicted:
      return absl::StrCat("motion, pose or given place not used at ", when, ": it is ", value,
                          " m from the object's points (limit ", limit, " m)");
    case ObjectIssueKind::kJumped:
      return absl::StrCat("motion or pose left out at ", when, ": puts the object ", value,
                          " m from where it was predicted (limit ", limit, " m)");
    case ObjectIssueKind::kStartsTooEarly:
      return absl::StrCat("motion left out at ", when, ": starts ", value,
                          " s before the object was first seen (limit ", limit, " s)");
    case ObjectIssueKind::kRestarted:
      return absl::StrCat("model restarted at ", when, ": points ", value,
                          " m from where it should be (limit ", limit, " m)");
    case ObjectIssueKind::kBridgedTooLong:
      return absl::StrCat("model restarted at ", when, ": no motion or pose for ", value,
                          " s (horizon ", limit, " s)");
  }
  return "";
}

}  // namespace

void ObjectNotes::Add(const FrameReport& report, Time stamp) {
  implausible_ += report.motions_implausible;
  conflicting_ += report.motions_conflicting;
  bridged_ += report.objects_bridged;
  estimated_ += report.objects_estimated;
  restarted_ += report.objects_restarted;
  const std::size_t counted =
      report.motions_implausible + report.motions_conflicting + report.objects_restarted;
  unlisted_ += counted - std::min(counted, report.issues.size());
  for (const ObjectIssue& issue : report.issues) {
    const std::pair key{issue.id, issue.kind};
    if (issues_.size() >= kMaxObjects && !issues_.contains(key)) {
      ++unlisted_;
      continue;
    }
    Seen& seen = issues_[key];
    if (seen.count++ == 0) seen = {issue, stamp, 1};
  }
}

std::vector<std::string> ObjectNotes::Lines() const {
  std::vector<std::string> lines;
  for (const auto& [key, seen] : issues_) {
    std::string line =
        absl::StrCat("object ", key.first, ": ", Describe(seen.first, Seconds(seen.stamp)));
    if (seen.count > 1) absl::StrAppend(&line, "; ", Plural(seen.count, "time"), " in all");
    lines.push_back(std::move(line));
  }
  if (unlisted_ > 0) lines.push_back(absl::StrCat("and ", unlisted_, " more of these"));
  if (bridged_ + estimated_ > 0) {
    lines.push_back(absl::StrCat("objects came without a motion or pose ",
                                 Plural(bridged_ + estimated_, "time"), ": ", estimated_,
                                 " estimated from their points, ", bridged_,
                                 " placed by prediction and their points"));
  }
  if (std::string line = ids_.Line(); !line.empty()) lines.push_back(std::move(line));
  return lines;
}

Json ObjectNotes::AsJson() const {
  Json json = {{"motions_implausible", implausible_},
               {"motions_conflicting", conflicting_},
               {"objects_bridged", bridged_},
               {"objects_estimated", estimated_},
               {"objects_restarted", restarted_},
               {"objects_without_points", ids_.WithoutPoints()},
               {"issues", Json::array()}};
  for (const auto& [key, seen] : issues_) {
    json["issues"].push_back({{"object_id", key.first},
                              {"kind", NameOf(key.second)},
                              {"first_stamp_ns", ToNanoseconds(seen.stamp)},
                              {"value", seen.first.value},
                              {"limit", seen.first.limit},
                              {"count", seen.count}});
  }
  return json;
}

}  // namespace clearway::cli
