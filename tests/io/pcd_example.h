// PCD files for tests.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"

namespace clearway {

struct PcdPoint {
  float x, y, z, intensity;
  std::uint32_t label;
};

// With a field of another type, and one of three numbers that is to be skipped.
inline std::string PcdHeaderOf(std::size_t points, const std::string& data,
                               const std::string& viewpoint = "0 0 0 1 0 0 0") {
  return absl::StrCat("# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n",
                      "FIELDS intensity x y normal z label\nSIZE 4 8 8 2 8 4\nTYPE F F F I F U\n",
                      "COUNT 1 1 1 3 1 1\nWIDTH ", points, "\nHEIGHT 1\nVIEWPOINT ", viewpoint,
                      "\nPOINTS ", points, "\nDATA ", data, "\n");
}

template <class T>
void PutBytes(std::string& out, T value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

inline std::string AsciiPcd(const std::vector<PcdPoint>& points) {
  std::string text = PcdHeaderOf(points.size(), "ascii");
  for (const PcdPoint& p : points) {
    absl::StrAppend(&text, p.intensity, " ", p.x, " ", p.y, " 1 2 3 ", p.z, " ", p.label, "\n");
  }
  return text;
}

inline std::string BinaryPcd(const std::vector<PcdPoint>& points) {
  std::string bytes = PcdHeaderOf(points.size(), "binary");
  for (const PcdPoint& p : points) {
    PutBytes(bytes, p.intensity);
    PutBytes(bytes, static_cast<double>(p.x));
    PutBytes(bytes, static_cast<double>(p.y));
    for (const std::int16_t n : {1, 2, 3}) PutBytes(bytes, n);
    PutBytes(bytes, static_cast<double>(p.z));
    PutBytes(bytes, p.label);
  }
  return bytes;
}

// LZF without repetitions: up to 32 literal bytes behind each control byte.
inline std::string LiteralLzf(const std::string& bytes) {
  std::string packed;
  for (std::size_t at = 0; at < bytes.size(); at += 32) {
    const std::string part = bytes.substr(at, 32);
    packed += static_cast<char>(part.size() - 1);
    packed += part;
  }
  return packed;
}

// Field after field.
inline std::string CompressedPcd(const std::vector<PcdPoint>& points) {
  std::string fields;
  for (const PcdPoint& p : points) PutBytes(fields, p.intensity);
  for (const PcdPoint& p : points) PutBytes(fields, static_cast<double>(p.x));
  for (const PcdPoint& p : points) PutBytes(fields, static_cast<double>(p.y));
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (const std::int16_t n : {1, 2, 3}) PutBytes(fields, n);
  }
  for (const PcdPoint& p : points) PutBytes(fields, static_cast<double>(p.z));
  for (const PcdPoint& p : points) PutBytes(fields, p.label);
  const std::string packed = LiteralLzf(fields);
  std::string bytes = PcdHeaderOf(points.size(), "binary_compressed");
  PutBytes(bytes, static_cast<std::uint32_t>(packed.size()));
  PutBytes(bytes, static_cast<std::uint32_t>(fields.size()));
  return bytes + packed;
}

}  // namespace clearway
