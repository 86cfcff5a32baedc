// An evaluation as a page that needs no other file.
#pragma once

#include <string>

#include "absl/status/status.h"
#include "cli/evaluation.h"

namespace clearway::cli {

// Before an evaluation, which may take minutes: whether the file can be a page. A page that is
// there is written anew; nothing else is: FAILED_PRECONDITION.
absl::Status CheckPage(const std::string& html_file);

// The tables, plots of how predictions miss and how the objects' maps grow, pictures of the objects
// and of the scene. INTERNAL if the file cannot be written.
absl::Status WriteHtml(const std::string& html_file, const TrueSource& source,
                       const Evaluation& found);

}  // namespace clearway::cli
