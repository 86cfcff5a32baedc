// Cases for people to read.
#pragma once

#include <ostream>
#include <string>

#include "demo/case.h"

namespace clearway::demo {

// A few lines, the last of which names the picture.
void Print(const CaseResult& result, const std::string& picture, std::ostream& out);

}  // namespace clearway::demo
