// Case results for summary.json.
#pragma once

#include <nlohmann/json.hpp>

#include "demo/case.h"

namespace clearway::demo {

nlohmann::ordered_json JsonOf(const CaseResult& result);

}  // namespace clearway::demo
