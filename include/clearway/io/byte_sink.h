// Files that are made piece by piece.
#pragma once

#include <functional>
#include <string_view>

namespace clearway {

// Takes a file's next bytes. False: no more are wanted.
using ByteSink = std::function<bool(std::string_view bytes)>;

}  // namespace clearway
