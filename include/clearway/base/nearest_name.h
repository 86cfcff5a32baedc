// Suggestions for misspelt names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace clearway {

// The candidate with the fewest inserted, deleted or replaced characters, if they are at most a
// third of the name's; empty if there is none.
std::string NearestName(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace clearway
