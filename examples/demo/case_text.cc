#include "demo/case_text.h"

#include "absl/strings/str_format.h"

namespace clearway::demo {

void Print(const CaseResult& result, const std::string& picture, std::ostream& out) {
  out << "\n" << result.name << "\n";
  if (!result.void_places.empty()) {
    out << "  void at " << result.void_places.size()
        << " places, first: " << result.void_places.front() << "\n";
  }
  if (result.crossing) {
    const Crossing& crossing = *result.crossing;
    if (crossing.shift_m != 0) {
      out << absl::StrFormat("  crossing shifted by %+.1f m along the object's path\n",
                             crossing.shift_m);
    }
    if (result.straight.touched != crossing.blocker) {
      out << absl::StrFormat("  no place before object %d itself: this one is before object %d\n",
                             crossing.blocker, result.straight.touched);
    }
    out << absl::StrFormat("  straight at %g m/s: touches object %d after %.2f s\n",
                           crossing.max_speed_mps, result.straight.touched,
                           ToSeconds(*result.straight.contact - crossing.now));
  }
  if (result.drive) {
    const DriveLog& drive = *result.drive;
    out << absl::StrFormat(
        "  drive (%s): %d decisions, %d new ways, %d evasions, the slowest %.1f s, margin %g m, "
        "closest %.2f m\n",
        result.plan->planner, drive.decisions, drive.plans, drive.evasions,
        drive.slowest_decision_s, result.margin_m, result.verdict.closest_m);
  } else if (result.plan) {
    out << absl::StrFormat(
        "  plan (%s, %.1f s): version %d, margin %g m, inflation %g m/s, %d states checked, "
        "%.1f %% unknown space, closest %.2f m\n",
        result.plan->planner, result.planning_s, result.plan->version, result.margin_m,
        result.plan->inflation_mps, result.plan->states_checked,
        100 * result.plan->unknown_fraction.value_or(1), result.verdict.closest_m);
  }
  const char* const passed =
      result.KnownToTheEnd() ? "PASSED: " : "PASSED as far as it is recorded: ";
  out << "  " << (result.Passed() ? passed : "FAILED: ") << result.Conclusion() << "  [" << picture
      << "]\n";
}

}  // namespace clearway::demo
