#include "cli/left_out_text.h"

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "cli/text.h"

namespace clearway::cli {

std::string LeftOutText(const LeftOut& left_out, const std::string& indent) {
  if (left_out.Empty()) return "";
  std::vector<std::string> counts;
  if (left_out.rows > 0) counts.push_back(Plural(left_out.rows, "row"));
  if (left_out.frames > 0) counts.push_back(Plural(left_out.frames, "frame"));
  const std::uint64_t total = left_out.rows + left_out.frames;
  std::string text = absl::StrCat(absl::StrJoin(counts, " and "), " of the input ",
                                  total == 1 ? "is" : "are", " left out:\n");
  for (const std::string& reason : left_out.reasons) {
    absl::StrAppend(&text, indent, reason, "\n");
  }
  const std::uint64_t more = total - left_out.reasons.size();
  if (more > 0) absl::StrAppend(&text, indent, "and ", Grouped(more), " more\n");
  return text;
}

Json ToJson(const LeftOut& left_out) {
  return {{"rows", left_out.rows}, {"frames", left_out.frames}, {"reasons", left_out.reasons}};
}

}  // namespace clearway::cli
