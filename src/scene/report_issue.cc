#include "scene/report_issue.h"

namespace clearway {

void AddIssue(const ObjectIssue& issue, FrameReport& report) {
  switch (issue.kind) {
    case ObjectIssueKind::kTurnTooLarge:
    case ObjectIssueKind::kMotionTooFar:
    case ObjectIssueKind::kMotionTooFast:
    case ObjectIssueKind::kContradicted:
    case ObjectIssueKind::kJumped:
    case ObjectIssueKind::kStartsTooEarly:
      ++report.motions_implausible;
      break;
    case ObjectIssueKind::kMotionConflict:
      ++report.motions_conflicting;
      break;
    case ObjectIssueKind::kRestarted:
    case ObjectIssueKind::kBridgedTooLong:
      ++report.objects_restarted;
      break;
  }
  if (report.issues.size() < kMaxObjectIssues) report.issues.push_back(issue);
}

}  // namespace clearway
