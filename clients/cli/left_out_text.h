// What a source left out, as it is shown.
#pragma once

#include <string>

#include "clearway/io/left_out.h"
#include "cli/json.h"

namespace clearway::cli {

// "2 rows and 1 frame of the input are left out:" and the first reasons, a line each behind
// `indent`; empty if nothing is.
std::string LeftOutText(const LeftOut& left_out, const std::string& indent = "  ");

Json ToJson(const LeftOut& left_out);

}  // namespace clearway::cli
