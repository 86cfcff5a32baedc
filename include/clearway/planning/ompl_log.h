// What OMPL has to say, in a program's own log.
#pragma once

#include <functional>
#include <string>

namespace clearway {

enum class OmplLevel { kDebug, kInfo, kWarning, kError };

// From now on OMPL's messages go to `write`, on any thread, and not to stdout and stderr. Of the
// whole process: for programs, not for libraries. Call it once, before the first plan.
void WriteOmplLog(std::function<void(OmplLevel level, const std::string& text)> write);

}  // namespace clearway
