// Numbers of binary PLY files.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace clearway {

// How a property's number is stored.
struct PlyScalar {
  char kind = 'f';  // f: floating point, i: integer, u: integer without sign
  std::size_t bytes = 4;
};

// "float", "uint8" and so on; none for other words, lists among them.
std::optional<PlyScalar> PlyScalarNamed(std::string_view name);

// The number that is stored at `bytes`, of which there are scalar.bytes.
double PlyNumberAt(const char* bytes, PlyScalar scalar, bool big_endian);

}  // namespace clearway
