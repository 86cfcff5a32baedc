#include "cli/replay_summary.h"

#include "absl/strings/str_cat.h"
#include "cli/left_out_text.h"
#include "cli/text.h"

namespace clearway::cli {

Json SummaryJson(const AckTally::Counts& counts, const FrameSource& source,
                 std::uint64_t reconnects, double seconds) {
  Json json = {{"frames", counts.answered},
               {"applied", counts.answered - counts.refused},
               {"refused", counts.refused},
               {"repeated", counts.repeated},
               {"reconnects", reconnects},
               {"lost", counts.lost},
               {"late", counts.late},
               {"points", counts.points},
               {"version", counts.last.version},
               {"stamp_ns", ToNanoseconds(counts.last.stamp)},
               {"origin_m", ToJson(source.origin_m)},
               {"elapsed_s", seconds},
               {"left_out", ToJson(*source.left_out)}};
  json["reports"] = counts.objects.AsJson();
  json["reports"]["points"] = counts.of_points.AsJson();
  if (counts.refused > 0) {
    json["first_refusal"] = absl::StrCat(absl::StatusCodeToString(counts.first_refusal.code()),
                                         ": ", counts.first_refusal.message());
  }
  return json;
}

void PrintSummary(std::ostream& out, const AckTally::Counts& counts) {
  out << "sent " << Plural(counts.answered, "frame");
  if (counts.refused > 0) out << " (" << counts.refused << " refused)";
  out << ", " << Plural(counts.points, "point");
  if (counts.last.version > 0) {
    out << "; scene version " << counts.last.version << ", newest stamp "
        << Seconds(counts.last.stamp);
  }
  out << "\n";
  if (counts.late > 0) {
    out << Plural(counts.late, "frame")
        << " of a sensor arrived after newer ones of another, by up to "
        << ToSeconds(counts.max_late_by) << " s, and " << (counts.late == 1 ? "was" : "were")
        << " applied\n";
  }
  if (counts.repeated > 0) {
    out << Plural(counts.repeated, "frame")
        << " had been sent before and changed nothing ('clearway reset' starts over)\n";
  }
  for (const std::string& line : counts.of_points.Lines()) out << line << "\n";
  for (const std::string& line : counts.objects.Lines()) out << line << "\n";
}

}  // namespace clearway::cli
