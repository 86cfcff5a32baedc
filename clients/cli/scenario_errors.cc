#include "cli/scenario_errors.h"

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "clearway/client/error_details.h"

namespace clearway::cli {
namespace {

// Of a request's field, the file's.
std::string InFile(const std::string& field) {
  return absl::StrReplaceAll(field, {{"world_from_object.translation_m", "pose.position_m"},
                                     {"world_from_object", "pose"},
                                     {"velocity_object.linear_mps", "velocity_mps"},
                                     {"arm.", "space."},
                                     {"plane.", "space."}});
}

}  // namespace

absl::Status InScenario(const std::string& file, const absl::Status& status) {
  const std::string field = DetailsOf(status).field;
  const std::string message(status.message());
  if (field.empty() || !absl::StartsWith(message, field)) return status;
  return {status.code(), absl::StrCat(file, ": ", InFile(field), message.substr(field.size()))};
}

}  // namespace clearway::cli
