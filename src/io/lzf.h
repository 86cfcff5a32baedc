// LZF, the compression of binary_compressed PCD files.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace clearway {

// The `size` bytes that were packed; none if the packed bytes are damaged or hold another number of
// them. The format is liblzf's (http://oldhome.schmorp.de/marc/liblzf.html): a control byte c < 32
// precedes c + 1 literal bytes; else its upper 3 bits + 2 (if they are 7, plus the next byte) are
// the length of a repetition, which begins (lower 5 bits, next byte) + 1 bytes back.
std::optional<std::string> UnpackLzf(std::string_view packed, std::size_t size);

}  // namespace clearway
