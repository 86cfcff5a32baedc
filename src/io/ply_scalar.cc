#include "io/ply_scalar.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

namespace clearway {
namespace {

static_assert(std::endian::native == std::endian::little);

template <class T>
double As(const std::array<char, 8>& bytes) {
  T value;
  std::memcpy(&value, bytes.data(), sizeof value);
  return static_cast<double>(value);
}

}  // namespace

std::optional<PlyScalar> PlyScalarNamed(std::string_view name) {
  constexpr struct {
    std::string_view old_name, name;
    PlyScalar scalar;
  } kScalars[] = {{"char", "int8", {'i', 1}},     {"uchar", "uint8", {'u', 1}},
                  {"short", "int16", {'i', 2}},   {"ushort", "uint16", {'u', 2}},
                  {"int", "int32", {'i', 4}},     {"uint", "uint32", {'u', 4}},
                  {"float", "float32", {'f', 4}}, {"double", "float64", {'f', 8}}};
  for (const auto& known : kScalars) {
    if (name == known.old_name || name == known.name) return known.scalar;
  }
  return std::nullopt;
}

double PlyNumberAt(const char* bytes, PlyScalar scalar, bool big_endian) {
  std::array<char, 8> little{};
  std::copy_n(bytes, scalar.bytes, little.begin());
  if (big_endian) std::reverse(little.begin(), little.begin() + scalar.bytes);
  if (scalar.kind == 'f') return scalar.bytes == 4 ? As<float>(little) : As<double>(little);
  if (scalar.kind == 'i') {
    return scalar.bytes == 1   ? As<std::int8_t>(little)
           : scalar.bytes == 2 ? As<std::int16_t>(little)
                               : As<std::int32_t>(little);
  }
  return scalar.bytes == 1   ? As<std::uint8_t>(little)
         : scalar.bytes == 2 ? As<std::uint16_t>(little)
                             : As<std::uint32_t>(little);
}

}  // namespace clearway
