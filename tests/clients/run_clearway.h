// The command line's program, run by its tests. CLEARWAY_BINARY is its path.
#pragma once

#include <string>
#include <vector>

#include "clients/subprocess.h"

namespace clearway {

inline Finished RunClearway(std::vector<std::string> arguments, const std::string& input = "") {
  arguments.insert(arguments.begin(), CLEARWAY_BINARY);
  return RunProgram(arguments, input);
}

}  // namespace clearway
